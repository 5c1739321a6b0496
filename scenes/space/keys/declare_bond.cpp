// Declaration of bonds in three dimensions: as in two dimensions, where particles can also consist of grains.
#include "scenes/space/keys/declare.hpp"

namespace pulvis::space::language {

const TableDeclaration<BondSpec>& bond() {
  static const TableDeclaration<BondSpec> declaration = without(schema::bond(), {"inside"});
  return declaration;
}

}  // namespace pulvis::space::language
