#include "scenes/results/solids/bonded_faces.hpp"

#include <bit>

#include "components/space/bond.hpp"
#include "systems/space/contact/patch_kernel.hpp"

namespace pulvis::space {
namespace {

PatchNumbers patch_of(const World& world, const Bodies::Slot& slot, const Shape::Face& face) {
  return {world.column<SurfacePosition>().values() + 3 * std::ptrdiff_t{slot.first_control},
          face.number.data()};
}

// The number of a point counts along u first.
auto place_of_point(const PatchNumbers& patch, int point) {
  return kernels::patch_slopes<double>(patch, entry(kernels::gauss_at, point % 4),
                                       entry(kernels::gauss_at, point / 4))
      .x;
}

template <class At>
void add_row(const World& world, std::size_t row, unsigned bonded, BondedFaces& all) {
  constexpr bool pair_of_particles = std::is_same_v<At, FaceContact>;
  const Bodies& bodies = world.resource<Bodies>();
  const std::int32_t* pair = world.column<ContactPair<At>>().values() + 3 * row;
  const Bodies::Slot& slot = entry(bodies.slots, pair[0]);
  const Shape& shape = entry(world.resource<Shapes>().list, slot.shape);
  const Shape::Face& face = entry(shape.faces, pair[1]);
  const PatchNumbers patch = patch_of(world, slot, face);
  const double* of_point = world.column<BondDamage<At>>().values() + face_points * row;
  double sum = 0, areas = 0;
  std::array<double, 3> at{};
  for (unsigned left = bonded; left != 0; left &= left - 1) {
    const int g = std::countr_zero(left);
    const double weight = entry(face.weight, g);
    const auto x = place_of_point(patch, g);
    sum += weight * of_point[g];
    areas += weight;
    at = {at[0] + weight * x.x, at[1] + weight * x.y, at[2] + weight * x.z};
  }
  const int other = pair_of_particles ? entry(bodies.slots, pair[2]).number : -1 - pair[2];
  all.ids.insert(all.ids.end(), {1.0 * slot.number, 1.0 * other});
  all.area.push_back((pair_of_particles ? 0.5 : 1) * areas);
  all.damage.push_back(sum / areas);
  for (const double coordinate : at) all.position.push_back(coordinate / areas);
}

template <class At>
void add_rows(const World& world, BondedFaces& all) {
  if (!world.has<BondedPoints<At>>()) return;
  const auto& points = world.column<BondedPoints<At>>();
  for (std::size_t r = 0; r < points.table.rows; ++r)
    if (const auto bonded = static_cast<unsigned>(points.values()[2 * r]); bonded != 0)
      add_row<At>(world, r, bonded, all);
}

}  // namespace

BondedFaces bonded_faces(const World& world) {
  BondedFaces all;
  add_rows<FaceContact>(world, all);
  add_rows<FaceToolContact>(world, all);
  return all;
}

std::vector<double> crack_positions(const World& world) {
  std::vector<double> positions;
  const Bodies& bodies = world.resource<Bodies>();
  for (const Crack& crack : world.resource<BondTotals>().cracks) {
    const Bodies::Slot& slot = entry(bodies.slots, crack.slot);
    const Shape& shape = entry(world.resource<Shapes>().list, slot.shape);
    const PatchNumbers patch = patch_of(world, slot, entry(shape.faces, crack.edge));
    const auto at = place_of_point(patch, crack.point);
    positions.insert(positions.end(), {at.x, at.y, at.z});
  }
  return positions;
}

}  // namespace pulvis::space
