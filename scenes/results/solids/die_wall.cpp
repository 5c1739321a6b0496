#include "scenes/results/solids/die_wall.hpp"

#include "components/space/contact.hpp"
#include "components/space/tools.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "systems/space/contact/contact_law.hpp"
#include "systems/space/contact/gauss_points.hpp"
#include "systems/space/tools/tool_projection.hpp"

namespace pulvis::space {
namespace {

double sum_of(const Lane& lanes) {
  double sum = 0;
  for (int l = 0; l < lane_count; ++l) sum += lanes[l];
  return sum;
}

}  // namespace

double normal_force_on_die(const World& world, int die, const DieRoom::Vector& axis) {
  using At = FaceToolContact;
  if (!world.has<ContactPair<At>>()) return 0;
  const Bodies& bodies = world.resource<Bodies>();
  const auto& pairs = world.column<ContactPair<At>>();
  const double* place = world.column<ToolPosition>().values() + tool_axes * die;
  const Point centre{place[0], place[1], place[2]};
  double sum = 0;
  for (std::size_t row = 0; row < static_cast<std::size_t>(pairs.table.rows); ++row) {
    const std::int32_t* pair = pairs.values() + 3 * row;
    if (pair[2] != die || world.column<ContactTouches<At>>().values()[row] == 0) continue;
    const Bodies::Slot& slot = entry(bodies.slots, pair[0]);
    const PatchNumbers points{
        world.column<SurfacePosition>().values() + 3 * std::ptrdiff_t{slot.first_control},
        entry(entry(world.resource<Shapes>().list, slot.shape).faces, pair[1]).number.data()};
    const double* force =
        world.column<PointForce<FaceToolContact>>().values() + 3 * face_points * row;
    for (int half = 0; half < 2; ++half) {
      const VectorLanes from = sampled_points(points, half) - everywhere(centre);
      const RadiusAndHeight at(from, everywhere(axis));
      sum -= sum_of(dot(load_half(force, half), at.outward));
    }
  }
  return sum;
}

}  // namespace pulvis::space
