// Declarations of the sample under an AFM's tip, and of the actions on it.
#include "scenes/keys/declare.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis::schema {
namespace {

template <class Spec>
Key<Spec> surface_length_key(const char* name, Words only_for, const char* doc,
                             double Spec::*member) {
  return {{.name = name,
           .kind = Kind::quantity,
           .unit = "m",
           .range = within(smallest_size, largest_size),
           .required = true,
           .only_for = std::move(only_for),
           .doc = doc},
          to(member)};
}

std::vector<Key<TargetSpec>> surface_shape_keys() {
  return {
      {{.name = "shape",
        .kind = Kind::choice,
        .choices = words_of<TargetSpec::Shape>({{"plane", "flat, level or inclined"},
                                                {"bump", "a ridge with flat flanks and a flat top"},
                                                {"step", "a plateau behind a single flank"},
                                                {"sinusoid", "a sine wave"},
                                                {"map", "a height map from a file"}}),
        .required = true,
        .doc = "Shape of the surface."},
       word_to(&TargetSpec::shape)},
      {{.name = "direction",
        .kind = Kind::choice,
        .choices = words_of<TargetSpec::Direction>(
            {{"lateral", "along y, across the lever"}, {"along", "along x"}}),
        .fallback = value_of("lateral"),
        .only_for = {"plane", "bump", "step", "sinusoid"},
        .doc = "Direction in which the surface rises."},
       word_to(&TargetSpec::direction)},
      {{.name = "incline",
        .kind = Kind::quantity,
        .unit = "rad",
        .range = within(-1.2, 1.2),
        .fallback = value_of("0 deg"),
        .only_for = "plane",
        .doc = "Inclination angle."},
       to(&TargetSpec::incline)},
      surface_length_key("height", {"bump", "step", "sinusoid"},
                         "Height of the bump or step; of a wave, from valley to crest.",
                         &TargetSpec::height),
      {{.name = "slope",
        .kind = Kind::number,
        .range = within(0.01, 100),
        .required = true,
        .only_for = {"bump", "step"},
        .doc = "Slope of the flanks: rise over run."},
       to(&TargetSpec::slope)},
      {{.name = "plateau",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(0, largest_size),
        .fallback = value_of("0 m"),
        .only_for = "bump",
        .doc = "Length of the flat top."},
       to(&TargetSpec::plateau)},
      {{.name = "position",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(-largest_size, largest_size),
        .fallback = value_of("0 m"),
        .only_for = {"bump", "step", "sinusoid"},
        .doc = "Start of the first flank (for a wave: where it rises through its mean "
               "height), measured from the point under the tip at the start."},
       to(&TargetSpec::position)},
      surface_length_key("wavelength", "sinusoid", "Wavelength.", &TargetSpec::wavelength),
      {{.name = "file",
        .kind = Kind::file,
        .required = true,
        .only_for = "map",
        .doc = "Heights in m, as a path relative to the folder of the scene: a "
               "comma-separated text file with one line per y and one number per x, both "
               "increasing; or an HDF5 file (.h5, .hdf5). The centre of the map is under the "
               "tip at the start."},
       to(&TargetSpec::file)},
      {{.name = "dataset",
        .kind = Kind::text,
        .fallback = value_of("heights"),
        .only_for = "map",
        .doc = "Dataset of the heights in an HDF5 file, [y, x]."},
       to(&TargetSpec::dataset)},
      surface_length_key("spacing", "map", "Grid spacing along x and y.", &TargetSpec::spacing),
  };
}

std::vector<Key<TargetSpec>> law_keys() {
  return {
      {{.name = "friction",
        .kind = Kind::number,
        .range = within(0, 10),
        .fallback = value_of(0.0),
        .doc = "Coulomb friction coefficient between tip and surface."},
       to(&TargetSpec::friction)},
      {{.name = "pull_off",
        .kind = Kind::quantity,
        .unit = "N",
        .range = within(0, 1),
        .fallback = value_of("0 N"),
        .doc = "Adhesion force (DMT): attraction in contact, which adds to the normal force "
               "in the friction law."},
       to(&TargetSpec::pull_off)},
      {{.name = "adhesion",
        .kind = Kind::choice,
        .choices = words_of<TargetSpec::Adhesion>(
            {{"dmt", "an adhesion force `pull_off`, for any shape in contact"},
             {"jkr",
              "Johnson, Kendall & Roberts: an elastic ball on a plane, with "
              "`work_of_adhesion`"}}),
        .fallback = value_of("dmt"),
        .doc = "Adhesion law. With JKR, approach, neck and contact radius of the ball follow "
               "the law, not the mesh. The ball pulls off at 3/2 pi w R, which adds to the "
               "normal force in the friction law."},
       word_to(&TargetSpec::adhesion)},
      {{.name = "work_of_adhesion",
        .kind = Kind::quantity,
        .unit = "J/m^2",
        .range = within(1e-6, 1e3),
        .doc = "w of JKR: energy per area needed to separate ball and surface.",
        .fallback_doc = "required with `adhesion = \"jkr\"`"},
       to(&TargetSpec::work)},
      {{.name = "adhesion_range",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(1e-12, 1e-3),
        .doc = "Range r of the attraction, which decays with the gap as 1/(1 + gap/r)^2; DMT "
               "only.",
        .fallback_doc = "1 nm"},
       to(&TargetSpec::range)},
  };
}

}  // namespace

const TableDeclaration<TargetSpec>& surface() {
  static const TableDeclaration<TargetSpec> declaration = [] {
    TableDeclaration<TargetSpec> made{
        {"surface", false, "shape",
         "The sample under the tip: rigid, moved by the scanner. At the start it just "
         "touches the tip.",
         afm_only, true},
        surface_shape_keys()};
    for (const auto& key : law_keys()) made.keys.push_back(key);
    return made;
  }();
  return declaration;
}

const TableDeclaration<ActionSpec>& action() {
  static const TableDeclaration<ActionSpec> declaration{
      {"action", true, "kind",
       "A step of the scanner programme; actions run in file order. Without actions "
       "the run calibrates the lever.",
       afm_only},
      {{{.name = "kind",
         .kind = Kind::choice,
         .choices = words_of<ActionSpec::Kind>(
             {{"press", "the surface moves up"},
              {"scan", "the probe moves across the surface"},
              {"retract", "the surface moves down"},
              {"hold", "nothing moves"},
              {"raster", "scan an area line by line, trace and retrace"}}),
         .required = true,
         .doc = "Kind of action."},
        word_to(&ActionSpec::kind)},
       {{.name = "distance",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(-largest_size, largest_size),
         .fallback = value_of("0 m"),
         .only_for = {"press", "scan", "retract", "raster"},
         .doc = "Travel of the scanner, not 0; for a press, `force` may be given instead. For a "
                "raster: length of a line, which begins at the current position of the probe."},
        to(&ActionSpec::distance)},
       {{.name = "force",
         .kind = Kind::quantity,
         .unit = "N",
         .range = above(0, 1),
         .only_for = "press",
         .doc = "Vertical force of the surface on the tip at the end of the press.",
         .fallback_doc = "none: the surface moves by `distance`"},
        to(&ActionSpec::force)},
       {{.name = "direction",
         .kind = Kind::choice,
         .choices = words_of<TargetSpec::Direction>(
             {{"lateral", "along y, across the lever"}, {"along", "along x"}}),
         .fallback = value_of("lateral"),
         .only_for = {"scan", "raster"},
         .doc = "Scan direction over the surface; for a raster, the direction of its lines."},
        word_to(&ActionSpec::direction)},
       {{.name = "retrace",
         .formerly = "back",
         .kind = Kind::choice,
         .choices = {{"yes", "trace and retrace"}, {"no", "trace only"}},
         .fallback = value_of("yes"),
         .only_for = "scan",
         .doc = "Whether the scan returns."},
        [](ActionSpec& a, const Decoded& value) { a.retrace = value.index == 0; }},
       {{.name = "set_point",
         .kind = Kind::choice,
         .choices = {{"height", "constant scanner height"},
                     {"force", "constant vertical force: the height is adjusted"}},
         .fallback = value_of("height"),
         .only_for = {"scan", "hold", "raster"},
         .doc = "Controlled quantity."},
        [](ActionSpec& a, const Decoded& value) { a.servo = value.index == 1; }},
       {{.name = "increments",
         .kind = Kind::integer,
         .range = within(1, 100000),
         .fallback = value_of(20),
         .doc = "Number of increments of the scan (per direction if it returns); for a raster, "
                "pixels per line."},
        integer_to(&ActionSpec::increments)},
       surface_length_key("width", "raster", "Width of the area, perpendicular to the lines.",
                          &ActionSpec::width),
       {{.name = "lines",
         .kind = Kind::integer,
         .range = within(1, 10000),
         .fallback = value_of(16),
         .only_for = "raster",
         .doc = "Number of lines, evenly spaced from the near to the far edge of the area."},
        integer_to(&ActionSpec::lines)}}};
  return declaration;
}

}  // namespace pulvis::schema
