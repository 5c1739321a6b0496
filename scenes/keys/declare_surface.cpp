// Declarations of the sample under an AFM's tip, and of what is done with it.
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
        .choices = {{"plane", "flat, level or inclined"},
                    {"bump", "a ridge with flat flanks and a flat top"},
                    {"step", "a plateau behind one flank"},
                    {"sinusoid", "a wave"},
                    {"map", "heights from a file"}},
        .required = true,
        .doc = "Of the surface."},
       [](TargetSpec& s, const Decoded& value) {
         s.shape = static_cast<TargetSpec::Shape>(value.index);
       }},
      {{.name = "direction",
        .kind = Kind::choice,
        .choices = {{"lateral", "along y, across the lever"}, {"along", "along x"}},
        .fallback = value_of("lateral"),
        .only_for = {"plane", "bump", "step", "sinusoid"},
        .doc = "In which the surface rises."},
       [](TargetSpec& s, const Decoded& value) {
         s.direction = static_cast<TargetSpec::Direction>(value.index);
       }},
      {{.name = "incline",
        .kind = Kind::quantity,
        .unit = "rad",
        .range = within(-1.2, 1.2),
        .fallback = value_of("0 deg"),
        .only_for = "plane",
        .doc = "Angle by which it rises."},
       to(&TargetSpec::incline)},
      surface_length_key("height", {"bump", "step", "sinusoid"},
                         "Of the bump or step; of a wave from valley to crest.",
                         &TargetSpec::height),
      {{.name = "slope",
        .kind = Kind::number,
        .range = within(0.01, 100),
        .required = true,
        .only_for = {"bump", "step"},
        .doc = "Of the flanks: rise over run."},
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
        .doc = "Where the first flank begins (a wave rises through its mean height), from the "
               "place under the tip at the start."},
       to(&TargetSpec::position)},
      surface_length_key("wavelength", "sinusoid", "Of the wave.", &TargetSpec::wavelength),
      {{.name = "file",
        .kind = Kind::file,
        .required = true,
        .only_for = "map",
        .doc = "Heights in m, as a path from the scene's folder: a text file, comma-separated, a "
               "line for every y, rising, a number for every x, rising; or an HDF5 file (.h5, "
               ".hdf5). Its middle lies under the tip at the start."},
       to(&TargetSpec::file)},
      {{.name = "dataset",
        .kind = Kind::text,
        .fallback = value_of("heights"),
        .only_for = "map",
        .doc = "Of an HDF5 file: where the heights are in it, [y, x]."},
       to(&TargetSpec::dataset)},
      surface_length_key("spacing", "map", "Of the points along x and y.", &TargetSpec::spacing),
  };
}

std::vector<Key<TargetSpec>> law_keys() {
  return {
      {{.name = "friction",
        .kind = Kind::number,
        .range = within(0, 10),
        .fallback = value_of(0.0),
        .doc = "Coulomb coefficient between the tip and the surface."},
       to(&TargetSpec::friction)},
      {{.name = "pull_off",
        .kind = Kind::quantity,
        .unit = "N",
        .range = within(0, 1),
        .fallback = value_of("0 N"),
        .doc =
            "Adhesion (DMT): attraction in contact, which adds to the force that friction sees."},
       to(&TargetSpec::pull_off)},
      {{.name = "adhesion",
        .kind = Kind::choice,
        .choices = {{"dmt", "a force `pull_off`, whatever touches"},
                    {"jkr",
                     "Johnson, Kendall & Roberts: an elastic ball on a plane, "
                     "`work_of_adhesion`"}},
        .fallback = value_of("dmt"),
        .doc = "Law of attraction. With JKR the ball touches by its own law of approach, neck and "
               "contact radius, not by its mesh; it pulls off with 3/2 pi w R, which adds to the "
               "force that friction sees."},
       [](TargetSpec& s, const Decoded& value) {
         s.adhesion = static_cast<TargetSpec::Adhesion>(value.index);
       }},
      {{.name = "work_of_adhesion",
        .kind = Kind::quantity,
        .unit = "J/m^2",
        .range = within(1e-6, 1e3),
        .doc = "w of JKR: what it costs to part an area of the ball and the surface.",
        .fallback_doc = "must be given with `adhesion = \"jkr\"`"},
       to(&TargetSpec::work)},
      {{.name = "adhesion_range",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(1e-12, 1e-3),
        .doc = "Gap r over which attraction fades as 1/(1 + gap/r)^2; only with DMT.",
        .fallback_doc = "1 nm"},
       to(&TargetSpec::range)},
  };
}

}  // namespace

const TableDeclaration<TargetSpec>& surface() {
  static const TableDeclaration<TargetSpec> declaration = [] {
    TableDeclaration<TargetSpec> made{
        {"surface", false, "shape",
         "The sample under the tip: rigid, moved by the scanner. At the start it just touches.",
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
       "A part of what the scanner does; actions follow each other in the order of the file. "
       "Without any the lever is calibrated.",
       afm_only},
      {{{.name = "kind",
         .kind = Kind::choice,
         .choices = {{"press", "the surface moves up"},
                     {"scan", "the probe is drawn over the surface"},
                     {"retract", "the surface moves down"},
                     {"hold", "nothing moves"},
                     {"raster", "line by line, trace and retrace, over an area"}},
         .required = true,
         .doc = "What is done."},
        [](ActionSpec& a, const Decoded& value) {
          a.kind = static_cast<ActionSpec::Kind>(value.index);
        }},
       {{.name = "distance",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(-largest_size, largest_size),
         .fallback = value_of("0 m"),
         .only_for = {"press", "scan", "retract", "raster"},
         .doc = "How far the scanner goes; press: or give `force`. Of a raster: length of a line, "
                "which begins where the probe is."},
        to(&ActionSpec::distance)},
       {{.name = "force",
         .kind = Kind::quantity,
         .unit = "N",
         .range = within(-1, 1),
         .only_for = "press",
         .doc = "Vertical force of the surface on the tip at the end of the press.",
         .fallback_doc = "the surface moves by `distance`"},
        to(&ActionSpec::force)},
       {{.name = "direction",
         .kind = Kind::choice,
         .choices = {{"lateral", "along y, across the lever"}, {"along", "along x"}},
         .fallback = value_of("lateral"),
         .only_for = {"scan", "raster"},
         .doc = "Of the probe's path over the surface; of a raster: of its lines."},
        [](ActionSpec& a, const Decoded& value) {
          a.direction = static_cast<TargetSpec::Direction>(value.index);
        }},
       {{.name = "retrace",
         .formerly = "back",
         .kind = Kind::choice,
         .choices = {{"yes", "trace and retrace"}, {"no", "trace alone"}},
         .fallback = value_of("yes"),
         .only_for = "scan",
         .doc = "Whether the scan returns."},
        [](ActionSpec& a, const Decoded& value) { a.retrace = value.index == 0; }},
       {{.name = "set_point",
         .kind = Kind::choice,
         .choices = {{"height", "the scanner keeps its height"},
                     {"force", "its height follows so that the vertical force stays"}},
         .fallback = value_of("height"),
         .only_for = {"scan", "hold", "raster"},
         .doc = "What stays the same."},
        [](ActionSpec& a, const Decoded& value) { a.servo = value.index == 1; }},
       {{.name = "increments",
         .kind = Kind::integer,
         .range = within(1, 100000),
         .fallback = value_of(20),
         .doc = "Steps of the scan (of each direction of one that returns); pixels of a raster's "
                "line."},
        integer_to(&ActionSpec::increments)},
       surface_length_key("width", "raster", "Of the area, square to its lines.",
                          &ActionSpec::width),
       {{.name = "lines",
         .kind = Kind::integer,
         .range = within(1, 10000),
         .fallback = value_of(16),
         .only_for = "raster",
         .doc = "Of the area: one at its near edge, the others evenly up to its far one."},
        integer_to(&ActionSpec::lines)}}};
  return declaration;
}

}  // namespace pulvis::schema
