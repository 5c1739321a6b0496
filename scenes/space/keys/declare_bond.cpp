// Declaration of bonds in three dimensions: adhesion as in two dimensions. Other origins do not exist here.
#include "scenes/space/keys/declare.hpp"

namespace pulvis::space::language {

const TableDeclaration<BondSpec>& bond() {
  static const TableDeclaration<BondSpec> declaration = [] {
    TableDeclaration<BondSpec> table = schema::bond();
    table.info.doc = "Adhesion between two surfaces.";
    constexpr const char* only = "adhesion";
    std::erase_if(table.keys, [](const Key<BondSpec>& key) {
      return !key.info.only_for.empty() && !key.info.only_for.has(only);
    });
    Key<BondSpec>& origin = key_of(table, "origin");
    std::erase_if(origin.info.choices,
                  [](const schema::Choice& choice) { return choice.word != only; });
    origin.set = [](BondSpec& spec, const Decoded&) { spec.origin = BondSpec::Origin::adhesion; };
    return table;
  }();
  return declaration;
}

}  // namespace pulvis::space::language
