// Columns of bonds in three dimensions: contact points that stick together until they break. A bonded point is held at a
// fixed place of the other surface instead of the closest one. Rules, sums and results: components/bond.hpp.
#pragma once

#include <cstdint>

#include "components/bond.hpp"
#include "components/space/contact.hpp"

namespace pulvis::space {

// ---- contact rows, only if the scene has bonds ------------------------------------------------------
// At: FaceContact or FaceToolContact.
template <class At>
struct BondedPoints : Component<At, std::int32_t, 2> {
  static constexpr ComponentInfo info{
      "bonded", "-", "bit g: Gauss point g is bonded; then: by pressure, not from the start"};
  enum Number { all, welds };
};
// Only if bonds exist from the start. Welds are made where the surfaces touch. An initial overlap, < 0, stays when the bond
// breaks, until the surfaces have parted: contact counts from it, since it would otherwise push them apart.
template <class At>
struct BondOffset : Component<At, double, face_points> {
  static constexpr ComponentInfo info{"bond_offset", "m", "opening when the bond was made"};
};
// Only if bonds form under pressure.
template <class At>
struct WeldPressure : Component<At, double, face_points> {
  static constexpr ComponentInfo info{"weld_pressure", "Pa", "largest contact pressure so far"};
};
// A tool does not rotate: the place and its normal move with it. (On another particle it is where ContactPoint stays.)
struct ToolAnchor : Component<FaceToolContact, double, 6 * face_points> {
  static constexpr ComponentInfo info{
      "anchor", "SI",
      "bonded point from the tool's: x of every point, y, z [m]; then its normal likewise"};
  static constexpr int normal = 3 * face_points;
};

}  // namespace pulvis::space
