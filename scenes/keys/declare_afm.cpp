// Declarations of the atomic force microscope: lever, tip, laser, detector.
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
        .choices = {{"beam", "a rectangular strip"},
                    {"v", "two arms that meet in an apex plate"},
                    {"mesh", "hexahedra or tetrahedra of a Gmsh file"}},
        .required = true,
        .doc = "Outline of the lever seen from above."},
       [](LeverSpec& lever, const Decoded& value) {
         lever.shape = static_cast<LeverSpec::Shape>(value.index);
       }},
      {{.name = "material",
        .kind = Kind::reference,
        .refers_to = "material",
        .required = true,
        .doc = "Its material."},
       index_to(&LeverSpec::material)},
      {length_of("length", true, {"beam", "v"},
                 "From the clamp to the end (of a pointed V: to its point)."),
       to(&LeverSpec::length)},
      {length_of("thickness", true, {"beam", "v"}, "Without the coating."),
       to(&LeverSpec::thickness)},
      {length_of("width", true, "beam", "Of the strip."), to(&LeverSpec::width)},
      {length_of("arm_width", true, "v", "Square across an arm."), to(&LeverSpec::arm_width)},
      {{.name = "half_angle",
        .kind = Kind::quantity,
        .unit = "rad",
        .range = within(0.05, 1.4),
        .only_for = "v",
        .doc = "Between the axis and the outer edge of an arm.",
        .fallback_doc = "`base_width` must be given"},
       to(&LeverSpec::half_angle)},
      {{.name = "base_width",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(smallest_size, largest_size),
        .only_for = "v",
        .doc = "Over both arms at the clamp.",
        .fallback_doc = "`half_angle` must be given"},
       to(&LeverSpec::base_width)},
      {{.name = "apex_width",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(0, largest_size),
        .fallback = value_of("0 m"),
        .only_for = "v",
        .doc = "Of the blunt end; 0: the lever ends in a point."},
       to(&LeverSpec::apex_width)},
      {{.name = "file",
        .kind = Kind::file,
        .required = true,
        .only_for = "mesh",
        .doc =
            "MSH file of Gmsh (2.2 or 4.1, ASCII), as a path from the scene's folder: hexahedra of "
            "eight nodes or tetrahedra of ten in the physical volumes `lever` and, if there are "
            "such, `coating`, `tip` and `glue`; physical surfaces `clamp` (held), `face` (towards "
            "the sample, what is under a tip included), `back` (where the laser shines) and, with "
            "a "
            "tip, `end`. The clamp is at x = 0, the lever runs along +x, its middle lies in z = 0, "
            "the sample is below."},
       to(&LeverSpec::file)},
      {{.name = "unit",
        .kind = Kind::quantity,
        .unit = "m",
        .range = above(0, 1),
        .required = true,
        .only_for = "mesh",
        .doc = "What a length of 1 in the file means."},
       to(&LeverSpec::unit)},
  };
}

Key<LeverSpec> elements_of(const char* name, int LeverSpec::*count, const char* doc) {
  return {{.name = name,
           .kind = Kind::integer,
           .range = within(1, 5000),
           .only_for = "beam",
           .doc = doc,
           .fallback_doc = "as `aspect` says"},
          integer_to(count)};
}

std::vector<Key<LeverSpec>> further_lever_keys() {
  return {
      {{.name = "tilt",
        .kind = Kind::quantity,
        .unit = "rad",
        .range = within(-0.8, 0.8),
        .fallback = value_of("0 deg"),
        .doc = "Of the chip: the lever's end is lower than its clamp. Forces and displacements are "
               "told in the frame of the sample."},
       to(&LeverSpec::tilt)},
      {{.name = "coating",
        .kind = Kind::reference,
        .refers_to = "material",
        .doc = "Material of a layer on the back.",
        .fallback_doc = "no coating"},
       [](LeverSpec& lever, const Decoded& value) { lever.coating = value.index; }},
      {{.name = "coating_thickness",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(smallest_size, largest_size),
        .only_for = {"beam", "v"},
        .needs = "coating",
        .doc = "Of that layer.",
        .fallback_doc = "must be given with `coating`"},
       to(&LeverSpec::coating_thickness)},
      {{.name = "aspect",
        .kind = Kind::number,
        .range = within(0.5, 100),
        .only_for = {"beam", "v"},
        .doc =
            "Largest edge of the elements in the plane over the thickness; 20 to 150 of that "
            "length lie along the lever and at least 4 across it (an arm). A value beyond that is "
            "refused.",
        .fallback_doc = "`6.0`"},
       to(&LeverSpec::aspect)},
      {{.name = "side_aspect",
        .kind = Kind::number,
        .range = within(0.05, 100),
        .only_for = {"beam", "v"},
        .doc =
            "Edge of the elements at the free sides, square to them, over the thickness: a layer "
            "as wide as the lever is thick carries its torsion. A hundredth of the width at least; "
            "further in they grow up to `aspect`.",
        .fallback_doc = "`0.5`"},
       to(&LeverSpec::side_aspect)},
      {{.name = "foot_edge",
        .kind = Kind::number,
        .range = within(0.005, 0.5),
        .only_for = {"beam", "v"},
        .doc =
            "Edge of the elements at the rim of the tip's foot over the foot's width, in the lever "
            "and in the tip. At least `tip.elements` lie across the foot.",
        .fallback_doc = "`0.03`"},
       to(&LeverSpec::foot_edge)},
      {{.name = "foot_layers",
        .kind = Kind::integer,
        .range = within(0, 16),
        .only_for = {"beam", "v"},
        .doc = "Of solid elements through the thickness, from the foot to one and a half "
               "thicknesses around it; 0: none, plates go on under the foot.",
        .fallback_doc = "as `foot_edge` says"},
       [](LeverSpec& lever, const Decoded& value) {
         lever.foot_layers = static_cast<int>(value.integer);
       }},
      {{.name = "layers",
        .kind = Kind::integer,
        .range = within(1, 16),
        .fallback = value_of(1),
        .only_for = {"beam", "v"},
        .doc = "Of elements through the thickness, elsewhere."},
       integer_to(&LeverSpec::layers)},
      elements_of("elements_along", &LeverSpec::along,
                  "Elements along it, all as long, instead of `aspect`."),
      elements_of("elements_across", &LeverSpec::across, "The same across it."),
      {{.name = "element",
        .kind = Kind::choice,
        .choices = {{"plate", "a thin layer: incompatible modes, transverse shear from its edges"},
                    {"solid", "incompatible modes alone"},
                    {"standard", "trilinear displacements: it locks, for comparison only"}},
        .fallback = value_of("plate"),
        .doc =
            "How the lever's hexahedra take their strains. Those of a file that are no thin layers "
            "want `solid`; tetrahedra have no choice."},
       [](LeverSpec& lever, const Decoded& value) {
         static constexpr HexFormulation order[] = {HexFormulation::plate, HexFormulation::solid,
                                                    HexFormulation::standard};
         lever.element = order[value.index];
       }},
  };
}

std::vector<Key<TipSpec>> tip_keys() {
  const Words solid{"block", "pyramid", "cone"}, made{"block", "pyramid", "cone", "sphere"};
  const Words all{"block", "pyramid", "cone", "sphere", "mesh"};
  return {
      {{.name = "shape",
        .kind = Kind::choice,
        .choices = {{"none", "no tip: forces act on the lever's lower face"},
                    {"block", "a square prism"},
                    {"pyramid", "square"},
                    {"cone", "round"},
                    {"sphere", "a colloid probe: a ball on a neck of glue"},
                    {"mesh", "hexahedra or tetrahedra of a Gmsh file"}},
        .fallback = value_of("none"),
        .doc = "What stands under the lever."},
       [](TipSpec& tip, const Decoded& value) {
         tip.shape = static_cast<TipSpec::Shape>(value.index);
       }},
      {{.name = "material",
        .kind = Kind::reference,
        .refers_to = "material",
        .required = true,
        .only_for = all,
        .doc = "Its material."},
       index_to(&TipSpec::material)},
      {length_of("height", true, solid,
                 "From the lever's lower face to the tip's end. The arm of a lateral force about "
                 "the lever's middle plane is half the thickness longer."),
       to(&TipSpec::height)},
      {length_of("foot", true, solid,
                 "Width of the square (diameter of the circle) on which it stands. On a V its size "
                 "changes the lateral stiffness."),
       to(&TipSpec::foot)},
      {length_of("end", true, {"pyramid", "cone"}, "The same at its end."), to(&TipSpec::end)},
      {length_of("radius", true, "sphere", "Of the ball."), to(&TipSpec::radius)},
      {length_of("neck_radius", true, "sphere", "Of the glue between the lever and the ball."),
       to(&TipSpec::neck_radius)},
      {length_of("neck_height", true, "sphere", "From the lever's lower face to the ball's top."),
       to(&TipSpec::neck_height)},
      {{.name = "glue",
        .kind = Kind::reference,
        .refers_to = "material",
        .only_for = {"sphere", "mesh"},
        .doc = "Material of the neck; of a mesh: of its volume `glue`.",
        .fallback_doc = "that of the tip"},
       [](TipSpec& tip, const Decoded& value) { tip.glue = value.index; }},
      {{.name = "end_radius",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(0, largest_size),
        .fallback = value_of("0 m"),
        .only_for = {"block", "pyramid", "cone", "mesh"},
        .doc = "Rounding of the end where it touches a surface; the ball touches as meshed."},
       to(&TipSpec::end_radius)},
      {{.name = "file",
        .kind = Kind::file,
        .only_for = "mesh",
        .doc =
            "MSH file of Gmsh (2.2 or 4.1, ASCII), as a path from the scene's folder: hexahedra of "
            "eight nodes or tetrahedra of ten in the physical volumes `tip` and, if there is one, "
            "`glue`; physical surfaces `foot` (at z = 0, tied to the lever's lower face) and `end` "
            "(below it). Its axis is x = y = 0.",
        .fallback_doc = "the tip is in `lever.file`"},
       to(&TipSpec::file)},
      {{.name = "unit",
        .kind = Kind::quantity,
        .unit = "m",
        .range = above(0, 1),
        .fallback = value_of("1 um"),
        .only_for = "mesh",
        .doc = "What a length of 1 in the file means."},
       to(&TipSpec::unit)},
      {place_of("set_back", "Distance of its axis from the lever's end."), to(&TipSpec::set_back)},
      {place_of("offset", "Distance of its axis from the lever's axis, along +y."),
       to(&TipSpec::offset)},
      {{.name = "elements",
        .kind = Kind::integer,
        .range = within(2, 64),
        .multiple_of = 2,
        .fallback = value_of(4),
        .only_for = made,
        .doc = "Across it; of a ball: across the core of its mesh."},
       integer_to(&TipSpec::elements)},
      {{.name = "contact_edge",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(smallest_size, largest_size),
        .only_for = "sphere",
        .doc =
            "Edge of the ball's elements where it touches: some are divided in eight until none is "
            "larger there, ever fewer with the distance. Hertz's circle of contact wants five or "
            "more of them on its radius.",
        .fallback_doc = "all are as `elements` says"},
       to(&TipSpec::contact_edge)},
      {{.name = "contact_reach",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(smallest_size, largest_size),
        .only_for = "sphere",
        .needs = "contact_edge",
        .doc = "How far around its lowest point they are as small as that.",
        .fallback_doc = "eight times `contact_edge`, half the radius at most"},
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
      {"tip", false, "shape", "What stands under the lever and touches the sample.", afm_only},
      tip_keys()};
  return declaration;
}

const TableDeclaration<LaserSpec>& laser() {
  static const TableDeclaration<LaserSpec> declaration{
      {"laser", false, "", "The spot on the lever's back whose slope the detector sees.", afm_only},
      {{{.name = "position",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(0, largest_size),
         .doc = "Of the spot's middle, from the clamp.",
         .fallback_doc = "above the tip"},
        to(&LaserSpec::position)},
       {place_of("offset", "Of the spot's middle from the lever's axis, along +y."),
        to(&LaserSpec::offset)},
       {{.name = "radius",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(0, largest_size),
         .fallback = value_of("0 m"),
         .doc = "Of the spot, over which slopes are averaged; 0 is a point."},
        to(&LaserSpec::radius)}}};
  return declaration;
}

const TableDeclaration<DetectorSpec>& detector() {
  static const TableDeclaration<DetectorSpec> declaration{
      {"detector", false, "", "The optical lever: volts by angle.", afm_only},
      {{{.name = "normal_gain",
         .kind = Kind::quantity,
         .unit = "V/rad",
         .range = within(-1e9, 1e9),
         .fallback = value_of("1 V/rad"),
         .doc = "Of the lever's slope along itself."},
        to(&DetectorSpec::normal_gain)},
       {{.name = "lateral_gain",
         .kind = Kind::quantity,
         .unit = "V/rad",
         .range = within(-1e9, 1e9),
         .fallback = value_of("1 V/rad"),
         .doc = "Of its twist."},
        to(&DetectorSpec::lateral_gain)}}};
  return declaration;
}

}  // namespace pulvis::schema
