// Declaration of the tools: planes and polylines that touch particles, constraints that hold nodes.
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

Key<ToolSpec> rounding_key() {
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
  return {{.name = "holds",
           .kind = Kind::choice,
           .choices = words_of<ToolSpec::Holds>(
               {{"x", "nodes follow the constraint in x and are free in y"},
                {"y", "nodes follow the constraint in y and are free in x"},
                {"both", "nodes follow the constraint"},
                {"radial",
                 "nodes move radially away from `point` by the first component of the "
                 "displacement and are free in the tangential direction; force_x of the "
                 "constraint is the sum of the radial forces"}}),
           .required = true,
           .only_for = "constraint",
           .doc = "Constrained direction."},
          word_to(&ToolSpec::holds)};
}

Key<ToolSpec> corner_key(const char* name, Vec2 ToolSpec::*member, const char* doc) {
  return {{.name = name,
           .kind = Kind::vector,
           .unit = "m",
           .range = within(-largest_size, largest_size),
           .only_for = "constraint",
           .doc = doc,
           .fallback_doc = "required unless `radius` is given"},
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
           .fallback_doc = "the box"},
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

std::vector<Key<ToolSpec>> place_keys() {
  return {
      {{.name = "name",
        .kind = Kind::name,
        .required = true,
        .doc = "Name used in moves, friction pairs and results."},
       to(&ToolSpec::name)},
      {{.name = "shape",
        .kind = Kind::choice,
        .choices = words_of<ToolSpec::Shape>(
            {{"plane", "fills the half-plane behind its surface"},
             {"polyline", "fills the region to the right of a chain of points"},
             {"constraint",
              "prescribes the displacement of the nodes of one particle in a box or a "
              "circle; has no contact",
              "grip"},
             {"profile", "a target surface: fills the region below a relief along x"}}),
        .required = true,
        .doc = "Type of tool."},
       word_to(&ToolSpec::shape)},
      {{.name = "point",
        .kind = Kind::vector,
        .unit = "m",
        .range = within(-largest_size, largest_size),
        .choices = {{"packing top",
                     "the height at which a punch rests on the packing; with several packings, the "
                     "highest"}},
        .doc = "A point on the surface of a plane, a crest of a profile, or the centre of a "
               "constraint with holds = \"radial\" or a `radius`. A polyline from a drawing "
               "is moved so that its furthest part along `normal` is level with this point, "
               "and the midpoint between its ends is beside it.",
        .fallback_doc = "required for these; for a polyline from a drawing: its position in the "
                        "drawing; not allowed elsewhere"},
       [](ToolSpec& spec, const Decoded& value) {
         spec.point = value.vector;
         spec.on_packing = value.is_word;
       }},
      {{.name = "normal",
        .kind = Kind::direction,
        .only_for = {"plane", "polyline"},
        .doc = "Direction from the tool into the powder, of any length.",
        .fallback_doc = "required for planes and for polylines with a `file`"},
       to(&ToolSpec::normal)}};
}

std::vector<Key<ToolSpec>> keys() {
  std::vector<Key<ToolSpec>> all = place_keys();
  for (Key<ToolSpec> key :
       {points_key(),
        drawing_key("unit", &ToolSpec::unit, "Unit of a drawing that does not specify one: \"um\".",
                    "specified in the drawing"),
        drawing_key("layer", &ToolSpec::layer,
                    "Part of a drawing to use: a layer of a DXF file; a group or shape of an SVG "
                    "file, by its id or Inkscape label.",
                    "the whole drawing"),
        rounding_key(), body_key(),
        corner_key("low", &ToolSpec::low,
                   "Lower left corner of the box. Nodes on the boundary are included; positions "
                   "are those of the initial state."),
        corner_key("high", &ToolSpec::high, "Upper right corner of the box."), radius_key(),
        holds_key()})
    all.push_back(std::move(key));
  for (Key<ToolSpec>& key : profile_keys()) all.push_back(std::move(key));
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
  table.keys = keys();
  return table;
}

}  // namespace

const TableDeclaration<ToolSpec>& tool() {
  static const TableDeclaration<ToolSpec> declaration = declared();
  return declaration;
}

}  // namespace pulvis::schema
