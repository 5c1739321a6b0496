// Declaration of the tools: planes, round dies, punches, closed surfaces from a file.
#include "scenes/space/keys/declare.hpp"

namespace pulvis::space::language {
namespace {

std::vector<Key<ToolSpec>> keys_of_place() {
  return {
      {{.name = "name",
        .kind = Kind::name,
        .required = true,
        .doc = "Moves, friction pairs and the results refer to it."},
       to(&ToolSpec::name)},
      {{.name = "shape",
        .kind = Kind::choice,
        .choices = {{"plane", "fills the half-space behind its surface"},
                    {"die", "a round hole: fills all outside of a cylinder"},
                    {"punch", "a body of revolution about its axis, whose face has a profile"},
                    {"stl", "a closed surface from a file"}},
        .required = true,
        .doc = "What it is."},
       [](ToolSpec& spec, const Decoded& value) {
         spec.shape = static_cast<ToolSpec::Shape>(value.index);
       }},
      {{.name = "point",
        .kind = Kind::vector,
        .unit = "m",
        .range = within(-largest_size, largest_size),
        .dimensions = 3,
        .choices = {{"packing top",
                     "the height at which a punch rests on the packing, with the foremost place "
                     "of its face; of several packings the highest"}},
        .required = true,
        .doc = "A point of a plane's surface, of the axis of a die, the middle of a punch's "
               "face, or where the origin of an STL file lies."},
       [](ToolSpec& spec, const Decoded& value) {
         spec.point = value.vector3;
         spec.on_packing = value.is_word;
       }},
      {{.name = "normal",
        .kind = Kind::direction,
        .dimensions = 3,
        .required = true,
        .only_for = {"plane", "punch", "die"},
        .optional_for = "die",
        .doc = "Direction from the tool into the powder, of any length; of a punch and a die "
               "their axis.",
        .fallback_doc = "of a die `[0, 0, 1]`"},
       to(&ToolSpec::normal)}};
}

std::vector<Key<ToolSpec>> keys_of_form() {
  return {{{.name = "diameter",
            .kind = Kind::quantity,
            .unit = "m",
            .range = within(smallest_size, largest_size),
            .required = true,
            .only_for = {"die", "punch"},
            .doc = "Of the hole; of the punch."},
           to(&ToolSpec::diameter)},
          {{.name = "profile",
            .kind = Kind::points,
            .unit = "m",
            .range = within(-largest_size, largest_size),
            .only_for = "punch",
            .doc = "Of the face: distance from the axis and height along the normal, from [0, ..] "
                   "outward; straight in between.",
            .fallback_doc = "a flat face"},
           [](ToolSpec& spec, const Decoded& value) { spec.profile = value.points; }},
          {{.name = "file",
            .kind = Kind::file,
            .required = true,
            .only_for = "stl",
            .doc = "Relative to the scene's folder: STL, ASCII or binary, a closed surface whose "
                   "triangles are seen counter-clockwise from the powder."},
           to(&ToolSpec::file)},
          {{.name = "unit",
            .kind = Kind::text,
            .required = true,
            .only_for = "stl",
            .doc = "Unit of the file's numbers: \"mm\"."},
           to(&ToolSpec::unit)}};
}

TableDeclaration<ToolSpec> declared_tool() {
  TableDeclaration<ToolSpec> table;
  table.info.path = "tool";
  table.info.repeated = true;
  table.info.selector = "shape";
  table.info.doc = "A rigid punch, die or wall. Without a move a tool stands still.";
  for (const auto& keys : {keys_of_place(), keys_of_form()})
    table.keys.insert(table.keys.end(), keys.begin(), keys.end());
  return table;
}

}  // namespace

const TableDeclaration<ToolSpec>& tool() {
  static const TableDeclaration<ToolSpec> declaration = declared_tool();
  return declaration;
}

}  // namespace pulvis::space::language
