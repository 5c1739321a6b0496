// Declaration of bonds in three dimensions: those of two dimensions without the origins that do not exist here.
#include "scenes/space/keys/declare.hpp"

namespace pulvis::space::language {
namespace {

const Words origins{"adhesion"};

// Choices are numbered as they are in two dimensions.
void keep_origins(Key<BondSpec>& origin) {
  std::vector<int> number;
  std::vector<schema::Choice> kept;
  for (const schema::Choice& choice : origin.info.choices) {
    if (!origins.has(choice.word)) continue;
    number.push_back(static_cast<int>(&choice - origin.info.choices.data()));
    kept.push_back(choice);
  }
  origin.info.choices = std::move(kept);
  origin.set = [number](BondSpec& spec, const Decoded& value) {
    spec.origin = static_cast<BondSpec::Origin>(number[static_cast<std::size_t>(value.index)]);
  };
}

}  // namespace

const TableDeclaration<BondSpec>& bond() {
  static const TableDeclaration<BondSpec> declaration = [] {
    TableDeclaration<BondSpec> table = schema::bond();
    table.info.doc = "Adhesion between two surfaces.";
    std::erase_if(table.keys, [](Key<BondSpec>& key) {
      if (key.info.only_for.empty()) return false;
      std::erase_if(key.info.only_for.list,
                    [](const std::string& origin) { return !origins.has(origin); });
      return key.info.only_for.empty();
    });
    keep_origins(key_of(table, "origin"));
    return table;
  }();
  return declaration;
}

}  // namespace pulvis::space::language
