// Declaration of the tools of both dimensions.
#include "scenes/keys/declare_profile.hpp"

namespace pulvis::schema {
namespace {

Key<ToolSpec> points_key() {
  return {{.name = "points",
           .kind = Kind::points,
           .unit = "m",
           .range = within(-largest_size, largest_size),
           .only_for = "polyline",
           .doc = "Corners of the surface in order, with the powder on the left: a floor runs "
                  "towards +x. The surface continues straight beyond the first and last point.",
           .fallback_doc = "required unless `file` is given"},
          to(&ToolSpec::points)};
}

Key<ToolSpec> drawing_key(const char* name, std::string ToolSpec::*member, const char* doc,
                          const char* fallback_doc) {
  return {{.name = name,
           .kind = Kind::text,
           .only_for = "polyline",
           .needs = "file",
           .doc = doc,
           .fallback_doc = fallback_doc},
          to(member)};
}

Key<ToolSpec> corners_rounding_key() {
  return {{.name = "rounding",
           .kind = Kind::quantity,
           .unit = "m",
           .range = within(0, largest_size),
           .fallback = value_of("0 mm"),
           .only_for = {"polyline", "profile"},
           .doc = "Radius of the corners that point into the powder; valleys stay sharp, and "
                  "flat parts stay where the points put them. It should be at least half a "
                  "boundary edge of the powder mesh: sharper corners can penetrate between the "
                  "contact points of an edge (docs/accuracy.md)."},
          to(&ToolSpec::rounding)};
}

Key<ToolSpec> holds_key() {
  return {
      {.name = "holds",
       .kind = Kind::choice,
       .choices = words_of<ToolSpec::Holds>(
           {{"x", "nodes follow the constraint in x and are free otherwise"},
            {"y", "nodes follow the constraint in y and are free otherwise"},
            {"both", "nodes follow the constraint", "", Dimension::two},
            {"radial",
             "nodes move radially away from `point` by the first component of the "
             "displacement and are free across it; force_x of the constraint is the sum of "
             "the radial forces"},
            {"z", "nodes follow the constraint in z and are free otherwise", "", Dimension::three},
            {"all", "nodes follow the constraint", "", Dimension::three}}),
       .required = true,
       .only_for = "constraint",
       .doc = "Constrained direction.",
       .in_3d = {.doc = "Constrained direction. Two constraints with the same box constrain "
                        "two of them."}},
      word_to(&ToolSpec::holds)};
}

Key<ToolSpec> box_corner_key(const char* name, Vec3 ToolSpec::*member, const char* doc,
                             const char* doc_3d) {
  return {{.name = name,
           .kind = Kind::vector,
           .unit = "m",
           .range = within(-largest_size, largest_size),
           .only_for = "constraint",
           .doc = doc,
           .fallback_doc = "required unless `radius` is given",
           .in_3d = {.doc = doc_3d}},
          to(member)};
}

Key<ToolSpec> radius_key() {
  return {{.name = "radius",
           .kind = Kind::quantity,
           .unit = "m",
           .range = within(smallest_size, largest_size),
           .only_for = "constraint",
           .doc = "Instead of the box: constrains nodes within this distance of `point` in the "
                  "initial state. The nodes of a hole lie slightly outside its circle, because "
                  "the polygon has the same area.",
           .fallback_doc = "the box",
           .in_3d = {.doc = "Instead of the box: constrains nodes within this distance of `point` "
                            "in the initial state."}},
          to(&ToolSpec::radius)};
}

Key<ToolSpec> body_key() {
  return {{.name = "body",
           .kind = Kind::integer,
           .range = within(0, 1e6),
           .fallback = value_of(0),
           .only_for = "constraint",
           .doc = "Number of the particle whose nodes are constrained, in file order, from 0."},
          integer_to(&ToolSpec::body)};
}

Key<ToolSpec> shape_key() {
  constexpr Dimension two = Dimension::two, three = Dimension::three;
  return {
      {.name = "shape",
       .kind = Kind::choice,
       .choices = words_of<ToolSpec::Shape>(
           {{"plane", "fills the half-plane or half-space behind its surface"},
            {"polyline", "fills the region to the right of a chain of points", "", two},
            {"constraint",
             "prescribes the displacement of the nodes of one particle in a box, a circle or a "
             "sphere; has no contact",
             "grip"},
            {"profile", "a target surface: fills the region below a relief along x", "", two},
            {"die",
             "a round hole: fills everything outside a cylinder, up to `height` if it is given", "",
             three},
            {"punch", "a body of revolution about its axis, whose face has a profile", "", three},
            {"stl", "a closed surface from a file", "", three}}),
       .required = true,
       .doc = "Type of tool."},
      [](ToolSpec& spec, const Decoded& value) {
        spec.shape = value_for<ToolSpec::Shape>(value);
        if (spec.shape >= ToolSpec::Shape::die) spec.normal = Vec3::UnitZ();
      }};
}

Key<ToolSpec> point_key() {
  return {{.name = "point",
           .kind = Kind::vector,
           .unit = "m",
           .range = within(-largest_size, largest_size),
           .choices = {{"packing top",
                        "the height at which the foremost part of a punch or plane, or the lowest "
                        "part of an STL surface, rests on the packing; with several packings, the "
                        "highest"}},
           .optional_for = "constraint",
           .doc = "A point on the surface of a plane, a crest of a profile, or the centre of a "
                  "constraint with holds = \"radial\" or a `radius`. A polyline from a drawing "
                  "is moved so that its furthest part along `normal` is level with this point, "
                  "and the midpoint between its ends is beside it.",
           .fallback_doc = "required for these; for a polyline from a drawing: its position in the "
                           "drawing; not allowed elsewhere",
           .in_3d = {.doc = "A point on the surface of a plane or on the axis of a die, the centre "
                            "of a punch face, the position of the origin of an STL file, or the "
                            "centre of a constraint with holds = \"radial\" or a `radius`; other "
                            "constraints have none.",
                     .required = true}},
          [](ToolSpec& spec, const Decoded& value) {
            spec.point = value.vector3;
            spec.on_packing = value.is_word;
          }};
}

Key<ToolSpec> normal_key() {
  return {{.name = "normal",
           .kind = Kind::direction,
           .only_for = {"plane", "polyline", "punch", "die"},
           .optional_for = "die",
           .doc = "Direction from the tool into the powder, of any length.",
           .fallback_doc = "required for planes and for polylines with a `file`",
           .in_3d = {.doc = "Direction from the tool into the powder, of any length; for a punch "
                            "or die, its axis.",
                     .fallback_doc = "for a die `[0, 0, 1]`",
                     .required = true}},
          to(&ToolSpec::normal)};
}

std::vector<Key<ToolSpec>> place_keys() {
  return {{{.name = "name",
            .kind = Kind::name,
            .required = true,
            .doc = "Name used in moves, friction pairs and results."},
           to(&ToolSpec::name)},
          shape_key(),
          point_key(),
          normal_key()};
}

std::vector<Key<ToolSpec>> keys_of_plane_shapes() {
  std::vector<Key<ToolSpec>> all{
      points_key(),
      drawing_key("unit", &ToolSpec::unit, "Unit of a drawing that does not specify one: \"um\".",
                  "specified in the drawing"),
      drawing_key("layer", &ToolSpec::layer,
                  "Part of a drawing to use: a layer of a DXF file; a group or shape of an SVG "
                  "file, by its id or Inkscape label.",
                  "the whole drawing"),
      corners_rounding_key(),
  };
  for (Key<ToolSpec>& key : profile_keys()) all.push_back(std::move(key));
  for (Key<ToolSpec>& key : all) key.info.dimension = Dimension::two;
  return all;
}

std::vector<Key<ToolSpec>> keys_of_constraints() {
  return {body_key(),
          box_corner_key("low", &ToolSpec::low,
                         "Lower left corner of the box. Nodes on the boundary are included; "
                         "positions are those of the initial state.",
                         "Corner of the box with the smallest coordinates. Nodes on the boundary "
                         "are included; positions are those of the initial state."),
          box_corner_key("high", &ToolSpec::high, "Upper right corner of the box.",
                         "Corner of the box with the largest coordinates."),
          radius_key(), holds_key()};
}

std::vector<Key<ToolSpec>> keys_of_dies_and_punches() {
  return {{{.name = "diameter",
            .kind = Kind::quantity,
            .unit = "m",
            .range = within(smallest_size, largest_size),
            .required = true,
            .only_for = {"die", "punch"},
            .doc = "Diameter of the hole or punch."},
           to(&ToolSpec::diameter)},
          {{.name = "height",
            .kind = Kind::quantity,
            .unit = "m",
            .range = within(smallest_size, largest_size),
            .only_for = "die",
            .doc = "Height of the mouth of the hole above `point`, along the normal. There the die "
                   "ends in a flat face, and an ejected compact is free.",
            .fallback_doc = "none: the hole has no end"},
           to(&ToolSpec::height)},
          {{.name = "rounding",
            .kind = Kind::quantity,
            .unit = "m",
            .range = within(0, largest_size),
            .only_for = "die",
            .needs = "height",
            .doc = "Radius of the edge of the mouth. It should be at least half the width of a "
                   "face of the particles: sharper edges catch between their Gauss points.",
            .fallback_doc = "`\"0 m\"`: a sharp edge"},
           to(&ToolSpec::rounding)},
          {{.name = "profile",
            .kind = Kind::points,
            .unit = "m",
            .range = within(-largest_size, largest_size),
            .components = 2,
            .only_for = "punch",
            .doc = "Profile of the face: distance from the axis and height along the normal, from "
                   "[0, ..] outwards, linearly interpolated.",
            .fallback_doc = "a flat face"},
           to(&ToolSpec::profile)}};
}

std::vector<Key<ToolSpec>> stl_keys() {
  return {{{.name = "file",
            .kind = Kind::file,
            .required = true,
            .only_for = "stl",
            .doc = "STL file (ASCII or binary) of a closed surface, as a path relative to the "
                   "folder of the scene. Triangles must be counter-clockwise as seen from the "
                   "powder. Several bodies need gaps between them: parts that touch or overlap "
                   "must be one body, without faces inside. Cavities are allowed. Walls must be "
                   "thicker than twice the penetration of the particles, which pass through a "
                   "thinner plate: `pulvis check` warns of walls below a fifth of the smallest "
                   "face."},
           to(&ToolSpec::file)},
          {{.name = "unit",
            .kind = Kind::text,
            .required = true,
            .only_for = "stl",
            .doc = "Length unit of the file: \"mm\"."},
           to(&ToolSpec::unit)}};
}

std::vector<Key<ToolSpec>> keys() {
  std::vector<Key<ToolSpec>> all = place_keys();
  for (auto keys : {keys_of_plane_shapes(), keys_of_constraints()})
    for (Key<ToolSpec>& key : keys) all.push_back(std::move(key));
  for (auto keys : {keys_of_dies_and_punches(), stl_keys()})
    for (Key<ToolSpec>& key : keys) {
      key.info.dimension = Dimension::three;
      all.push_back(std::move(key));
    }
  return all;
}

// Member by member: g++ 12 reports parts of one long initialiser as uninitialised.
TableDeclaration<ToolSpec> declared() {
  TableDeclaration<ToolSpec> table;
  table.info.path = "tool";
  table.info.repeated = true;
  table.info.selector = "shape";
  table.info.doc =
      "A rigid punch, wall or surface, or a constraint: support, symmetry plane or "
      "prescribed displacement. A tool without a move stays fixed.";
  table.info.doc_3d =
      "A rigid punch, die or wall, or a constraint: support, symmetry plane or prescribed "
      "displacement. A tool without a move stays fixed.";
  table.keys = keys();
  return table;
}

}  // namespace

const TableDeclaration<ToolSpec>& tool() {
  static const TableDeclaration<ToolSpec> declaration = declared();
  return declaration;
}

}  // namespace pulvis::schema
