// Declaration of the tools: planes, round dies, punches, closed surfaces from a file.
#include "scenes/keys/declare_3d.hpp"

namespace pulvis::space::language {
namespace {

std::vector<Key<ToolSpec>> keys_of_place() {
  return {
      {{.name = "name",
        .kind = Kind::name,
        .required = true,
        .doc = "Name used in moves, friction pairs and results."},
       to(&ToolSpec::name)},
      {{.name = "shape",
        .kind = Kind::choice,
        .choices = words_of<ToolSpec::Shape>(
            {{"plane", "fills the half-space behind its surface"},
             {"die",
              "a round hole: fills everything outside a cylinder, up to `height` if it is given"},
             {"punch", "a body of revolution about its axis, whose face has a profile"},
             {"stl", "a closed surface from a file"}}),
        .required = true,
        .doc = "Type of tool."},
       word_to(&ToolSpec::shape)},
      {{.name = "point",
        .kind = Kind::vector,
        .unit = "m",
        .range = within(-largest_size, largest_size),
        .choices =
            {{"packing top",
              "the height at which the foremost part of a punch face, or the lowest part of an "
              "STL surface, rests on the packing; with several packings, the highest"}},
        .required = true,
        .doc = "A point on the surface of a plane or on the axis of a die, the centre of a "
               "punch face, or the position of the origin of an STL file."},
       [](ToolSpec& spec, const Decoded& value) {
         spec.point = value.vector3;
         spec.on_packing = value.is_word;
       }},
      {{.name = "normal",
        .kind = Kind::direction,
        .required = true,
        .only_for = {"plane", "punch", "die"},
        .optional_for = "die",
        .doc = "Direction from the tool into the powder, of any length; for a punch or die, "
               "its axis.",
        .fallback_doc = "for a die `[0, 0, 1]`"},
       to(&ToolSpec::normal)}};
}

std::vector<Key<ToolSpec>> keys_of_form() {
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
           [](ToolSpec& spec, const Decoded& value) { spec.profile = value.points; }},
          {{.name = "file",
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

TableDeclaration<ToolSpec> declared_tool() {
  TableDeclaration<ToolSpec> table;
  table.info.path = "tool";
  table.info.repeated = true;
  table.info.selector = "shape";
  table.info.doc = "A rigid punch, die or wall. A tool without a move stays fixed.";
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
