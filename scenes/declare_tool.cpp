// Declaration of the tools: planes and polylines that particles touch, grips that hold nodes.
#include "scenes/declare.hpp"

namespace pulvis::schema {
namespace {

Key<ToolSpec> points_key() {
  return {{.name = "points",
           .kind = Kind::points,
           .unit = "m",
           .range = within(-largest_size, largest_size),
           .required = true,
           .only_for = "polyline",
           .doc = "Corners of the surface, in order, the powder to the left: a floor is walked "
                  "towards +x. Beyond the first and the last it goes on straight."},
          to(&ToolSpec::points)};
}

Key<ToolSpec> rounding_key() {
  return {
      {.name = "rounding",
       .kind = Kind::quantity,
       .unit = "m",
       .range = within(0, largest_size),
       .fallback = value_of("0 mm"),
       .only_for = "polyline",
       .doc = "Radius of the corners that point into the powder; valleys stay sharp, flat parts "
              "stay where the points say. Take at least half a boundary edge of the powder's mesh: "
              "a sharper corner can press in between the points where an edge is sampled "
              "(docs/accuracy.md)."},
      to(&ToolSpec::rounding)};
}

Key<ToolSpec> holds_key() {
  return {{.name = "holds",
           .kind = Kind::choice,
           .choices = {{"x", "nodes move with the grip in x, freely in y"},
                       {"y", "nodes move with the grip in y, freely in x"},
                       {"both", "nodes move with the grip"},
                       {"radial",
                        "nodes move away from `point` by the first component of the "
                        "displacement, freely across; the grip's force_x is the sum of the "
                        "radial forces"}},
           .required = true,
           .only_for = "grip",
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
           .required = true,
           .only_for = "grip",
           .doc = doc},
          to(member)};
}

Key<ToolSpec> body_key() {
  return {{.name = "body",
           .kind = Kind::integer,
           .range = within(0, 1e6),
           .fallback = value_of(0),
           .only_for = "grip",
           .doc = "Number of the particle whose nodes are held, in the order of the file, from 0."},
          integer_to(&ToolSpec::body)};
}

}  // namespace

const TableDeclaration<ToolSpec>& tool() {
  static const TableDeclaration<ToolSpec> declaration{
      {"tool", true, "shape",
       "A rigid punch, wall or surface, or a grip: supports, planes of symmetry and prescribed "
       "displacements are grips. Without a move a tool stands still."},
      {{{.name = "name",
         .kind = Kind::name,
         .required = true,
         .doc = "Moves, friction pairs and the results refer to it."},
        to(&ToolSpec::name)},
       {{.name = "shape",
         .kind = Kind::choice,
         .choices = {{"plane", "fills the half-plane behind its surface"},
                     {"polyline", "fills what lies to the right of a chain of points"},
                     {"grip", "holds the nodes of one particle in a box; nothing touches it"}},
         .required = true,
         .doc = "What it is."},
        [](ToolSpec& spec, const Decoded& value) {
          spec.shape = static_cast<ToolSpec::Shape>(value.index);
        }},
       {{.name = "point",
         .kind = Kind::vector,
         .unit = "m",
         .range = within(-largest_size, largest_size),
         .doc = "A point of a plane's surface, or the centre of a grip with holds = \"radial\".",
         .fallback_doc = "required of those two, refused elsewhere"},
        to(&ToolSpec::point)},
       {{.name = "normal",
         .kind = Kind::direction,
         .required = true,
         .only_for = "plane",
         .doc = "Direction from the tool into the powder, of any length."},
        to(&ToolSpec::normal)},
       points_key(),
       rounding_key(),
       body_key(),
       corner_key("low", &ToolSpec::low,
                  "Lower left corner of the box; nodes on its border count, where they lie before "
                  "the run."),
       corner_key("high", &ToolSpec::high, "Upper right corner of the box."),
       holds_key()}};
  return declaration;
}

}  // namespace pulvis::schema
