#include "scenes/keys/tables.hpp"

#include <array>

namespace pulvis::schema {

namespace {

// Its names are defined by the user (scenes/let).
TableView variables() {
  return {{"let", false, "",
           "Variables: user-defined names for numbers and quantities, `D = \"24 mm\"`, `n "
           "= 10`, or expressions in other variables, `gap = \"D/200\"` (see above).",
           every_family, true},
          {}};
}

// A table that has keys of its own in either dimension.
TableView of_both(TableView plane, const TableView& space) {
  for (KeyInfo& key : plane.keys) key.dimension = Dimension::two;
  if (space.info.doc != plane.info.doc) plane.info.doc_3d = space.info.doc;
  plane.info.selector_3d = space.info.selector;
  for (KeyInfo key : space.keys) {
    key.dimension = Dimension::three;
    plane.keys.push_back(std::move(key));
  }
  return plane;
}

}  // namespace

const Language& scene_language() {
  namespace in_space = space::language;
  static const Language tables{view_of(top_level()),
                               variables(),
                               view_of(material()),
                               view_of(material_damping()),
                               view_of(hardening()),
                               view_of(rate()),
                               of_both(view_of(particle()), view_of(in_space::particle())),
                               of_both(view_of(mesh()), view_of(in_space::mesh())),
                               view_of(grains()),
                               view_of(body()),
                               view_of(packing()),
                               view_of(mixture_class()),
                               view_of(die()),
                               view_of(cell()),
                               view_of(tool()),
                               view_of(stage()),
                               view_of(move()),
                               view_of(servo()),
                               view_of(until()),
                               view_of(cell_drive()),
                               view_of(friction()),
                               view_of(bond()),
                               view_of(contact()),
                               view_of(element()),
                               view_of(time()),
                               view_of(output()),
                               view_of(limits()),
                               view_of(lever()),
                               view_of(tip()),
                               view_of(laser()),
                               view_of(detector()),
                               view_of(surface()),
                               view_of(action()),
                               view_of(expect())};
  return tables;
}

const Language& scene_language(int dimension) {
  static const std::array languages{in_dimension(scene_language(), 2),
                                    in_dimension(scene_language(), 3)};
  return languages.at(static_cast<std::size_t>(dimension - 2));
}

}  // namespace pulvis::schema

namespace pulvis {

int dimension_of(const document::Table& root) {
  const document::Entry* entry = document::find(root, "dimension");
  const auto* dimension = entry == nullptr ? nullptr : entry->value.as<std::int64_t>();
  return dimension != nullptr && *dimension == 3 ? 3 : 2;
}

const schema::Language& language_of(const document::Table& root) {
  return schema::scene_language(dimension_of(root));
}

}  // namespace pulvis
