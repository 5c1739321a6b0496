// Declaration of the tools: planes and polylines that particles touch, constraints that hold nodes.
#include "scenes/keys/declare_profile.hpp"

namespace pulvis::schema {
namespace {

Key<ToolSpec> points_key() {
  return {{.name = "points",
           .kind = Kind::points,
           .unit = "m",
           .range = within(-largest_size, largest_size),
           .only_for = "polyline",
           .doc = "Corners of the surface, in order, the powder to the left: a floor is walked "
                  "towards +x. Beyond the first and the last it goes on straight.",
           .fallback_doc = "required, unless there is a `file`"},
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
  return {
      {.name = "rounding",
       .kind = Kind::quantity,
       .unit = "m",
       .range = within(0, largest_size),
       .fallback = value_of("0 mm"),
       .only_for = {"polyline", "profile"},
       .doc = "Radius of the corners that point into the powder; valleys stay sharp, flat parts "
              "stay where the points say. Take at least half a boundary edge of the powder's mesh: "
              "a sharper corner can press in between the points where an edge is sampled "
              "(docs/accuracy.md)."},
      to(&ToolSpec::rounding)};
}

Key<ToolSpec> holds_key() {
  return {{.name = "holds",
           .kind = Kind::choice,
           .choices = {{"x", "nodes move with the constraint in x, freely in y"},
                       {"y", "nodes move with the constraint in y, freely in x"},
                       {"both", "nodes move with the constraint"},
                       {"radial",
                        "nodes move away from `point` by the first component of the "
                        "displacement, freely across; the constraint's force_x is the sum of the "
                        "radial forces"}},
           .required = true,
           .only_for = "constraint",
           .doc = "The direction in which nodes are held."},
          [](ToolSpec& spec, const Decoded& value) {
            spec.holds = static_cast<ToolSpec::Holds>(value.index);
          }};
}

Key<ToolSpec> corner_key(const char* name, Vec2 ToolSpec::*member, const char* doc) {
  return {{.name = name,
           .kind = Kind::vector,
           .unit = "m",
           .range = within(-largest_size, largest_size),
           .only_for = "constraint",
           .doc = doc,
           .fallback_doc = "required, unless there is a `radius`"},
          to(member)};
}

Key<ToolSpec> radius_key() {
  return {{.name = "radius",
           .kind = Kind::quantity,
           .unit = "m",
           .range = within(smallest_size, largest_size),
           .only_for = "constraint",
           .doc = "Instead of the box: nodes no farther from `point` than this, before the run. "
                  "The nodes of a hole lie a little outside of its circle, as their polygon has "
                  "its area.",
           .fallback_doc = "the box"},
          to(&ToolSpec::radius)};
}

Key<ToolSpec> body_key() {
  return {{.name = "body",
           .kind = Kind::integer,
           .range = within(0, 1e6),
           .fallback = value_of(0),
           .only_for = "constraint",
           .doc = "Number of the particle whose nodes are held, in the order of the file, from 0."},
          integer_to(&ToolSpec::body)};
}

std::vector<Key<ToolSpec>> place_keys() {
  return {
      {{.name = "name",
        .kind = Kind::name,
        .required = true,
        .doc = "Moves, friction pairs and the results refer to it."},
       to(&ToolSpec::name)},
      {{.name = "shape",
        .kind = Kind::choice,
        .choices =
            {{"plane", "fills the half-plane behind its surface"},
             {"polyline", "fills what lies to the right of a chain of points"},
             {"constraint",
              "prescribes the displacement of the nodes of one particle in a box or a circle; "
              "nothing touches it",
              "grip"},
             {"profile", "a target surface: fills what lies below a relief along x"}},
        .required = true,
        .doc = "What it is."},
       [](ToolSpec& spec, const Decoded& value) {
         spec.shape = static_cast<ToolSpec::Shape>(value.index);
       }},
      {{.name = "point",
        .kind = Kind::vector,
        .unit = "m",
        .range = within(-largest_size, largest_size),
        .choices = {{"packing top",
                     "the height at which a punch rests on the packing; of several the highest"}},
        .doc = "A point of a plane's surface, a crest of a profile, or the centre of a constraint "
               "with "
               "holds = \"radial\" or a `radius`. Of a drawn polyline: where the drawing is moved "
               "to, so that the place furthest along `normal` is level with it, and the middle "
               "between the line's ends beside it.",
        .fallback_doc = "required of those, of a drawn polyline its place in the drawing; refused "
                        "elsewhere"},
       [](ToolSpec& spec, const Decoded& value) {
         spec.point = value.vector;
         spec.on_packing = value.is_word;
       }},
      {{.name = "normal",
        .kind = Kind::direction,
        .only_for = {"plane", "polyline"},
        .doc = "Direction from the tool into the powder, of any length.",
        .fallback_doc = "required of planes, and of polylines with a `file`"},
       to(&ToolSpec::normal)}};
}

std::vector<Key<ToolSpec>> keys() {
  std::vector<Key<ToolSpec>> all = place_keys();
  for (Key<ToolSpec> key :
       {points_key(),
        drawing_key("unit", &ToolSpec::unit, "Unit of a drawing that names none: \"um\".",
                    "the drawing names it"),
        drawing_key("layer", &ToolSpec::layer,
                    "What of a drawing is meant: a layer of a DXF file; a group or shape of an SVG "
                    "file, by its id or Inkscape's label.",
                    "the whole drawing"),
        rounding_key(), body_key(),
        corner_key("low", &ToolSpec::low,
                   "Lower left corner of the box; nodes on its border count, where they lie before "
                   "the run."),
        corner_key("high", &ToolSpec::high, "Upper right corner of the box."), radius_key(),
        holds_key()})
    all.push_back(std::move(key));
  for (Key<ToolSpec>& key : profile_keys()) all.push_back(std::move(key));
  return all;
}

// Member by member: g++ 12 takes the parts of one long initialiser for uninitialised.
TableDeclaration<ToolSpec> declared() {
  TableDeclaration<ToolSpec> table;
  table.info.path = "tool";
  table.info.repeated = true;
  table.info.selector = "shape";
  table.info.doc =
      "A rigid punch, wall or surface, or a constraint: supports, planes of symmetry and "
      "prescribed "
      "displacements are constraints. Without a move a tool stands still.";
  table.keys = keys();
  return table;
}

}  // namespace

const TableDeclaration<ToolSpec>& tool() {
  static const TableDeclaration<ToolSpec> declaration = declared();
  return declaration;
}

}  // namespace pulvis::schema
