// Declarations of the atomic force microscope: lever, tip, laser, detector.
#include <array>

#include "scenes/keys/declare.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis::schema {
namespace {

KeyInfo length_of(const char* name, bool required, Words only_for, const char* doc) {
  return {.name = name,
          .kind = Kind::quantity,
          .unit = "m",
          .range = within(smallest_size, largest_size),
          .required = required,
          .only_for = std::move(only_for),
          .doc = doc};
}

KeyInfo place_of(const char* name, const char* doc) {
  return {.name = name,
          .kind = Kind::quantity,
          .unit = "m",
          .range = within(-largest_size, largest_size),
          .fallback = value_of("0 m"),
          .doc = doc};
}

std::vector<Key<LeverSpec>> shape_keys() {
  return {
      {{.name = "shape",
        .kind = Kind::choice,
        .choices = words_of<LeverSpec::Shape>(
            {{"beam", "a rectangular strip"},
             {"v", "two arms joined by an apex plate"},
             {"mesh", "a mesh of hexahedra or tetrahedra from a Gmsh file"}}),
        .required = true,
        .doc = "Shape of the lever in plan view."},
       word_to(&LeverSpec::shape)},
      {{.name = "material",
        .kind = Kind::reference,
        .refers_to = "material",
        .required = true,
        .doc = "Material of the lever."},
       index_to(&LeverSpec::material)},
      {length_of("length", true, {"beam", "v"},
                 "Distance from the clamp to the free end (to the apex of a pointed V)."),
       to(&LeverSpec::length)},
      {length_of("thickness", true, {"beam", "v"}, "Thickness without the coating."),
       to(&LeverSpec::thickness)},
      {length_of("width", true, "beam", "Width of the beam."), to(&LeverSpec::width)},
      {length_of("arm_width", true, "v", "Width of an arm, measured perpendicular to it."),
       to(&LeverSpec::arm_width)},
      {{.name = "half_angle",
        .kind = Kind::quantity,
        .unit = "rad",
        .range = within(0.05, 1.4),
        .only_for = "v",
        .doc = "Angle between the lever axis and the outer edge of an arm.",
        .fallback_doc = "required unless `base_width` is given"},
       to(&LeverSpec::half_angle)},
      {{.name = "base_width",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(smallest_size, largest_size),
        .only_for = "v",
        .doc = "Total width over both arms at the clamp.",
        .fallback_doc = "required unless `half_angle` is given"},
       to(&LeverSpec::base_width)},
      {{.name = "apex_width",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(0, largest_size),
        .fallback = value_of("0 m"),
        .only_for = "v",
        .doc = "Width of a blunt apex; 0: the lever ends in a point."},
       to(&LeverSpec::apex_width)},
      {{.name = "file",
        .kind = Kind::file,
        .required = true,
        .only_for = "mesh",
        .doc = "Gmsh MSH file (2.2 or 4.1, ASCII), as a path relative to the folder of the "
               "scene. Elements are 8-node hexahedra or 10-node tetrahedra in the physical "
               "volumes `lever` and, where present, `coating`, `tip` and `glue`. Physical "
               "surfaces are `clamp` (fixed), `face` (the side facing the sample, including "
               "the area under a tip), `back` (where the laser spot lies) and, with a tip, "
               "`end`. The clamp is at x = 0, the lever extends along +x, its mid-plane is z "
               "= 0, and the sample is below."},
       to(&LeverSpec::file)},
      {{.name = "unit",
        .kind = Kind::quantity,
        .unit = "m",
        .range = above(0, 1),
        .required = true,
        .only_for = "mesh",
        .doc = "Length unit of the file."},
       to(&LeverSpec::unit)},
  };
}

Key<LeverSpec> elements_of(const char* name, int LeverSpec::*count, const char* doc) {
  return {{.name = name,
           .kind = Kind::integer,
           .range = within(1, 5000),
           .only_for = "beam",
           .doc = doc,
           .fallback_doc = "set by `aspect`"},
          integer_to(count)};
}

std::vector<Key<LeverSpec>> further_lever_keys() {
  return {
      {{.name = "tilt",
        .kind = Kind::quantity,
        .unit = "rad",
        .range = within(-0.8, 0.8),
        .fallback = value_of("0 deg"),
        .doc = "Tilt of the chip: positive if the free end is lower than the clamp. Forces "
               "and displacements are reported in the frame of the sample."},
       to(&LeverSpec::tilt)},
      {{.name = "coating",
        .kind = Kind::reference,
        .refers_to = "material",
        .doc = "Material of a coating on the back.",
        .fallback_doc = "no coating"},
       [](LeverSpec& lever, const Decoded& value) { lever.coating = value.index; }},
      {{.name = "coating_thickness",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(smallest_size, largest_size),
        .only_for = {"beam", "v"},
        .needs = "coating",
        .doc = "Thickness of the coating.",
        .fallback_doc = "required with `coating`"},
       to(&LeverSpec::coating_thickness)},
      {{.name = "aspect",
        .kind = Kind::number,
        .range = within(0.5, 100),
        .only_for = {"beam", "v"},
        .doc = "Maximum in-plane element edge divided by thickness, limited so that 20 to 150 "
               "elements of this size lie along the lever and at least 4 across it (or across "
               "an arm). A value beyond this limit is refused.",
        .fallback_doc = "`6.0`"},
       to(&LeverSpec::aspect)},
      {{.name = "side_aspect",
        .kind = Kind::number,
        .range = within(0.05, 100),
        .only_for = {"beam", "v"},
        .doc = "Element edge at the free sides, perpendicular to them, divided by thickness: "
               "a strip as wide as the lever is thick carries its torsion. The edge is at "
               "least a hundredth of the width. Elements grow inwards up to `aspect`.",
        .fallback_doc = "`0.5`"},
       to(&LeverSpec::side_aspect)},
      {{.name = "foot_edge",
        .kind = Kind::number,
        .range = within(0.005, 0.5),
        .only_for = {"beam", "v"},
        .doc = "Element edge at the rim of the tip's foot divided by the width of the foot, "
               "in the lever and in the tip. At least `tip.elements` elements lie across the "
               "foot.",
        .fallback_doc = "`0.03`"},
       to(&LeverSpec::foot_edge)},
      {{.name = "foot_layers",
        .kind = Kind::integer,
        .range = within(0, 16),
        .only_for = {"beam", "v"},
        .doc = "Number of layers of solid elements through the thickness, under the foot and "
               "up to one and a half thicknesses around it; 0: plate elements continue under "
               "the foot.",
        .fallback_doc = "set by `foot_edge`"},
       [](LeverSpec& lever, const Decoded& value) {
         lever.foot_layers = static_cast<int>(value.integer);
       }},
      {{.name = "layers",
        .kind = Kind::integer,
        .range = within(1, 16),
        .fallback = value_of(1),
        .only_for = {"beam", "v"},
        .doc = "Number of element layers through the thickness elsewhere."},
       integer_to(&LeverSpec::layers)},
      elements_of("elements_along", &LeverSpec::along,
                  "Number of elements along the lever, of equal length, instead of `aspect`."),
      elements_of("elements_across", &LeverSpec::across,
                  "Number of elements across the lever, of equal width, instead of `aspect`."),
      {{.name = "element",
        .kind = Kind::choice,
        .choices =
            {{"plate",
              "for thin layers: incompatible modes, transverse shear sampled at element edges"},
             {"solid", "incompatible modes only"},
             {"standard", "trilinear displacements; locks, for comparison only"}},
        .fallback = value_of("plate"),
        .doc = "Formulation of the lever's hexahedra. Hexahedra from a file that do not form "
               "thin layers need `solid`. Tetrahedra have a single formulation."},
       [](LeverSpec& lever, const Decoded& value) {
         static constexpr std::array order{HexFormulation::plate, HexFormulation::solid,
                                           HexFormulation::standard};
         lever.element = order.at(static_cast<std::size_t>(value.index));
       }},
  };
}

std::vector<Key<TipSpec>> tip_keys() {
  const Words solid{"block", "pyramid", "cone"}, made{"block", "pyramid", "cone", "sphere"};
  const Words all{"block", "pyramid", "cone", "sphere", "mesh"};
  return {
      {{.name = "shape",
        .kind = Kind::choice,
        .choices = words_of<TipSpec::Shape>(
            {{"none", "no tip: forces act on the lower face of the lever"},
             {"block", "a square prism"},
             {"pyramid", "with a square base"},
             {"cone", "with a circular base"},
             {"sphere", "a colloid probe: a ball on a glue neck"},
             {"mesh", "a mesh of hexahedra or tetrahedra from a Gmsh file"}}),
        .fallback = value_of("none"),
        .doc = "Shape of the tip."},
       word_to(&TipSpec::shape)},
      {{.name = "material",
        .kind = Kind::reference,
        .refers_to = "material",
        .required = true,
        .only_for = all,
        .doc = "Material of the tip."},
       index_to(&TipSpec::material)},
      {length_of("height", true, solid,
                 "Distance from the lower face of the lever to the end of the tip. The moment "
                 "arm of a lateral force about the mid-plane of the lever is longer by half the "
                 "thickness."),
       to(&TipSpec::height)},
      {length_of("foot", true, solid,
                 "Side length of the square foot (diameter of a round one). On a V it affects "
                 "the lateral stiffness."),
       to(&TipSpec::foot)},
      {length_of("end", true, {"pyramid", "cone"}, "Side length (diameter) of the end."),
       to(&TipSpec::end)},
      {length_of("radius", true, "sphere", "Radius of the ball."), to(&TipSpec::radius)},
      {length_of("neck_radius", true, "sphere", "Radius of the glue neck between lever and ball."),
       to(&TipSpec::neck_radius)},
      {length_of("neck_height", true, "sphere",
                 "Distance from the lower face of the lever to the top of the ball."),
       to(&TipSpec::neck_height)},
      {{.name = "glue",
        .kind = Kind::reference,
        .refers_to = "material",
        .only_for = {"sphere", "mesh"},
        .doc = "Material of the neck; for a mesh, of its volume `glue`.",
        .fallback_doc = "that of the tip"},
       [](TipSpec& tip, const Decoded& value) { tip.glue = value.index; }},
      {{.name = "end_radius",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(0, largest_size),
        .fallback = value_of("0 m"),
        .only_for = {"block", "pyramid", "cone", "mesh"},
        .doc = "Radius of the end where it contacts a surface. A ball contacts as meshed."},
       to(&TipSpec::end_radius)},
      {{.name = "file",
        .kind = Kind::file,
        .only_for = "mesh",
        .doc = "Gmsh MSH file (2.2 or 4.1, ASCII), as a path relative to the folder of the "
               "scene. Elements are 8-node hexahedra or 10-node tetrahedra in the physical "
               "volumes `tip` and, where present, `glue`. Physical surfaces are `foot` (at z "
               "= 0, tied to the lower face of the lever) and `end` (below it). The tip axis "
               "is x = y = 0.",
        .fallback_doc = "the tip is in `lever.file`"},
       to(&TipSpec::file)},
      {{.name = "unit",
        .kind = Kind::quantity,
        .unit = "m",
        .range = above(0, 1),
        .fallback = value_of("1 um"),
        .only_for = "mesh",
        .doc = "Length unit of the file."},
       to(&TipSpec::unit)},
      {place_of("set_back", "Distance of the tip axis from the end of the lever."),
       to(&TipSpec::set_back)},
      {place_of("offset", "Distance of the tip axis from the lever axis, along +y."),
       to(&TipSpec::offset)},
      {{.name = "elements",
        .kind = Kind::integer,
        .range = within(2, 64),
        .multiple_of = 2,
        .fallback = value_of(4),
        .only_for = made,
        .doc = "Number of elements across the tip; for a ball, across the core of its mesh."},
       integer_to(&TipSpec::elements)},
      {{.name = "contact_edge",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(smallest_size, largest_size),
        .only_for = "sphere",
        .doc = "Maximum element edge in the contact zone of the ball. Elements are divided "
               "into eight until they reach this size, and coarsen with distance. The Hertz "
               "contact radius should span at least five of them.",
        .fallback_doc = "no refinement: set by `elements`"},
       to(&TipSpec::contact_edge)},
      {{.name = "contact_reach",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(smallest_size, largest_size),
        .only_for = "sphere",
        .needs = "contact_edge",
        .doc = "Distance from the lowest point of the ball within which the elements have "
               "this size.",
        .fallback_doc = "eight times `contact_edge`, at most half the radius"},
       to(&TipSpec::contact_reach)},
  };
}

}  // namespace

const TableDeclaration<LeverSpec>& lever() {
  static const TableDeclaration<LeverSpec> declaration = [] {
    TableDeclaration<LeverSpec> made{
        {"lever", false, "shape",
         "The cantilever: x along it from the clamp, y across it, z up, away from the sample.",
         afm_only},
        shape_keys()};
    for (const auto& key : further_lever_keys()) made.keys.push_back(key);
    return made;
  }();
  return declaration;
}

const TableDeclaration<TipSpec>& tip() {
  static const TableDeclaration<TipSpec> declaration{
      {"tip", false, "shape", "The tip under the lever, which contacts the sample.", afm_only},
      tip_keys()};
  return declaration;
}

const TableDeclaration<LaserSpec>& laser() {
  static const TableDeclaration<LaserSpec> declaration{
      {"laser", false, "",
       "The laser spot on the back of the lever, where the detector measures the "
       "slope.",
       afm_only},
      {{{.name = "position",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(0, largest_size),
         .doc = "Distance of the spot centre from the clamp.",
         .fallback_doc = "above the tip"},
        to(&LaserSpec::position)},
       {place_of("offset", "Distance of the spot centre from the lever axis, along +y."),
        to(&LaserSpec::offset)},
       {{.name = "radius",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(0, largest_size),
         .fallback = value_of("0 m"),
         .doc = "Radius of the spot over which slopes are averaged; 0: a point."},
        to(&LaserSpec::radius)}}};
  return declaration;
}

const TableDeclaration<DetectorSpec>& detector() {
  static const TableDeclaration<DetectorSpec> declaration{
      {"detector", false, "", "The optical lever detector: volts per angle.", afm_only},
      {{{.name = "normal_gain",
         .kind = Kind::quantity,
         .unit = "V/rad",
         .range = within(-1e9, 1e9),
         .fallback = value_of("1 V/rad"),
         .doc = "Volts per slope along the lever."},
        to(&DetectorSpec::normal_gain)},
       {{.name = "lateral_gain",
         .kind = Kind::quantity,
         .unit = "V/rad",
         .range = within(-1e9, 1e9),
         .fallback = value_of("1 V/rad"),
         .doc = "Volts per twist."},
        to(&DetectorSpec::lateral_gain)}}};
  return declaration;
}

}  // namespace pulvis::schema
