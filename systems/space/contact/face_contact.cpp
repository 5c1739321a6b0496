// face_contact: narrow phase between particles in three dimensions: the Gauss points of every candidate face against the
// smooth surface of the other particle, with pressure, damping and friction; and what they do to that surface.
//
// Stages   pair_points.hpp -> projection.hpp -> contact_law.hpp -> other_loads.hpp, eight points at a time
// Runs     after bin_faces, before contact_force
// Active   when the scene has more than one particle
#include <bit>
#include <cmath>

#include "engine/deal.hpp"
#include "systems/space/contact/contact_law.hpp"
#include "systems/space/contact/gauss_points.hpp"
#include "systems/space/contact/other_loads.hpp"
#include "systems/space/contact/pair_points.hpp"
#include "systems/space/contact/projection.hpp"
#include "systems/space/contact/systems.hpp"

namespace pulvis::space {
namespace {

// Reciprocal slopes of the other surface.
struct Reciprocal {
  VectorLanes u, v;
  static Reciprocal of(const kernels::PatchSlopes<Lane>& s) {
    const Lane a = dot(s.u, s.u), b = dot(s.u, s.v), c = dot(s.v, s.v);
    const Lane inv_det = 1.0 / fma(a, c, -(b * b));
    return {inv_det * (c * s.u - b * s.v), inv_det * (a * s.v - b * s.u)};
  }
};

// How the points move against the other surface, whose velocity and its slopes are given.
void set_rates(const VectorLanes& velocity, const kernels::PatchSlopes<Lane>& other,
               const Reciprocal& to, PointMotion& m) {
  const VectorLanes relative = velocity - other.x;
  const Lane closing = dot(relative, m.normal);
  const VectorLanes normal_rate = -(dot(other.u, m.normal) * to.u + dot(other.v, m.normal) * to.v);
  m.gap_rate = -closing;
  m.slip = fma(m.gap, normal_rate, fma(-closing, m.normal, relative));
  const Lane drill = 0.5 * dot(m.normal, cross(to.u, other.u) + cross(to.v, other.v));
  m.spin = cross(m.normal, normal_rate) + drill * m.normal;
}

// The points of one pair.
class PairPass {
 public:
  PairPass(const face_contact& system, int pair, FaceSums& sums)
      : s_(system), sums_(sums), faces_(entry(system.loads->pairs, pair)) {
    const FacePairs& pairs = *s_.pairs;
    first_ = entry(pairs.begin, pair);
    end_ = entry(pairs.begin, pair + 1);
    const Row<FaceContact> row(first_);
    const int slot = s_.columns.pair(row, 0), other = s_.columns.pair(row, 2);
    own_ = &s_.bodies.shape_of(slot);
    its_ = &s_.bodies.shape_of(other);
    own_face_ = s_.bodies.first_face(slot) * std::ptrdiff_t{face_numbers};
    its_face_ = s_.bodies.first_face(other) * std::ptrdiff_t{face_numbers};
  }

  void run() {
    for (std::int32_t r = first_; r < end_; ++r) {
      const unsigned active = active_points(Row<FaceContact>(r));
      if (active == 0) continue;
      if (points_.is_full()) work();
      take(Row<FaceContact>(r), active);
    }
    work();
    faces_.finish();
  }

 private:
  static constexpr double share = 0.5;  // of the stiffness: the other particle samples back

  unsigned active_points(Row<FaceContact> row) const {
    const Lane travel(s_.clock->travel);
    const double* activation = &s_.columns.activation(row);
    return (Lane::load(activation) <= travel).bits() |
           (Lane::load(activation + lane_count) <= travel).bits() << lane_count;
  }

  void take(Row<FaceContact> row, unsigned active) {
    using Law = ContactLaw<FaceContact>;
    const int number = s_.columns.pair(row, 1);
    const std::ptrdiff_t own = own_face_ + std::ptrdiff_t{number} * face_numbers;
    const Shape::Face& face = entry(own_->faces, number);
    alignas(64) std::array<double, 3 * face_points> x, velocity{};
    for (int half = 0; half < 2; ++half) {
      if ((active >> lane_count * half & 0xffU) == 0) continue;
      store_half(sampled_points(positions_ + own, half), x.data(), half);
      if (rates_ != nullptr) store_half(sampled_points(rates_ + own, half), velocity.data(), half);
    }
    const double* spring = s_.columns.slip ? &(*s_.columns.slip)(row) : no_spring.data();
    const double kappa = share * s_.columns.law(row, Law::stiffness),
                 friction = s_.columns.law(row, Law::friction),
                 damping = share * s_.columns.law(row, Law::damping),
                 inv_size = s_.columns.law(row, Law::inv_size);
    for (unsigned left = active; left != 0; left &= left - 1) {
      const auto g = static_cast<std::size_t>(std::countr_zero(left));
      PairPoint& p = points_.add();
      p.motion = {x[g], x[16 + g], x[32 + g], velocity[g], velocity[16 + g], velocity[32 + g],
                  0,    0};
      p.law = {kappa,          friction,  damping,        inv_size,
               face.weight[g], spring[g], spring[16 + g], spring[32 + g]};
      p.row = static_cast<std::int32_t>(row.value);
      p.number = static_cast<std::int32_t>(g);
      PackedSpot::unpack(&s_.closest(row), p.number, p);
    }
    s_.columns.touches(row) = 0;
  }

  void work() {
    points_.for_eights([this](PointLanes& eight) { act(eight); });
  }

  void act(PointLanes& eight) {
    eight.set_motion();
    Projection p(*its_, positions_ + its_face_);
    p.point = eight.x;
    p.u = eight.u;
    p.v = eight.v;
    for (std::size_t l = 0; l < lane_count; ++l) p.face[l] = eight.point[l]->face;
    p.find();
    book(eight, p.unconverged());
    const Standing standing = p.standing();
    const LaneMask real = LaneMask::of(eight.real);
    // What is no number is not apart.
    const LaneMask touching = ~(standing.gap <= 0.0) & real;
    keep_spots(eight, p, standing.gap, touching.bits());
    PointMotion m{select(touching, standing.gap, Lane{}), standing.normal};
    bear(eight, p, m, touching.bits());
  }

  void bear(const PointLanes& eight, Projection& p, PointMotion& m, unsigned touching) {
    const auto law = eight.law();
    const VectorLanes spring =
        select(LaneMask::of(eight.real), VectorLanes{law[5], law[6], law[7]}, VectorLanes{});
    Reciprocal reciprocal;
    if (rates_ != nullptr) {
      reciprocal = Reciprocal::of(p.slopes);
      set_rates(eight.velocity, p.carried(rates_ + its_face_), reciprocal, m);
    }
    const PointLaw of{law[0], law[1], law[2], law[3], law[4]};
    Lane pressure;
    PointForces f = normal_forces(of, m, s_.clock->dt_before, pressure);
    if (s_.columns.slip) add_friction(of, m, s_.clock->dt_before, pressure, spring, f);
    keep_forces(eight, f);
    if (touching == 0) return;
    sums_.add(f);
    book_depth(eight, m.gap * of.inv_size);
    std::array<std::int32_t, 8> face = p.face;
    OtherForces back{min(max(p.u, Lane{}), 1.0), min(max(p.v, Lane{}), 1.0), f.force, m.normal, {}};
    if (!s_.columns.slip) return faces_.subtract<false>(face, touching, back);
    back.couple = {m.gap * dot(f.friction, reciprocal.u), m.gap * dot(f.friction, reciprocal.v)};
    faces_.subtract<true>(face, touching, back);
  }

  // ---- columns and books -------------------------------------------------------------------------------
  void keep_spots(const PointLanes& eight, const Projection& p, const Lane& gap,
                  unsigned touching) const {
    std::array<double, lane_count> u, v, distance;
    min(max(p.u, Lane{}), 1.0).store(u.data());
    min(max(p.v, Lane{}), 1.0).store(v.data());
    gap.store(distance.data());
    for (std::size_t l = 0; l < lane_count && (eight.real >> l & 1) != 0; ++l) {
      const PairPoint& point = *eight.point[l];
      const Row<FaceContact> row(point.row);
      PackedSpot::pack(&s_.closest(row), point.number, p.face[l], u[l], v[l]);
      const bool touches = (touching >> l & 1) != 0;
      // A point that is apart rests until it can touch.
      s_.columns.activation(row, point.number) = touches ? 0 : s_.clock->travel - distance[l];
      if (touches && s_.columns.touches(row) == 0) {
        s_.columns.touches(row) = 1;
        sums_.block.touching += 1;
      }
    }
  }
  void keep_forces(const PointLanes& eight, const PointForces& f) const {
    keep(eight, f.force, [this](Row<FaceContact> row) { return &s_.columns.force(row); });
    if (s_.columns.slip)
      keep(eight, f.elastic_slip,
           [this](Row<FaceContact> row) { return &(*s_.columns.slip)(row); });
  }
  template <class Column>
  static void keep(const PointLanes& eight, const VectorLanes& vector, const Column& column) {
    std::array<double, 3 * lane_count> all;
    vector.x.store(all.data());
    vector.y.store(all.data() + lane_count);
    vector.z.store(all.data() + 2 * lane_count);
    for (std::size_t l = 0; l < lane_count && (eight.real >> l & 1) != 0; ++l) {
      const PairPoint& point = *eight.point[l];
      double* to = column(Row<FaceContact>(point.row)) + point.number;
      for (std::size_t k = 0; k < 3; ++k) to[face_points * k] = all[lane_count * k + l];
    }
  }
  void book(const PointLanes& eight, unsigned unconverged) const {
    BlockSums& block = sums_.block;
    block.projections += std::popcount(eight.real);
    const unsigned missed = unconverged & eight.real;
    if (missed == 0) return;
    if (block.unconverged == 0)
      block.first_unconverged = entry(eight.point, std::countr_zero(missed))->row;
    block.unconverged += std::popcount(missed);
  }
  void book_depth(const PointLanes& eight, const Lane& depth) const {
    if (all(depth <= Lane(sums_.block.depth))) return;
    for (int l = 0; l < lane_count; ++l) sums_.book_depth(entry(eight.point, l)->row, depth[l]);
  }

  static constexpr std::array<double, 3 * face_points> no_spring{};
  const face_contact& s_;
  const double* positions_ = s_.faces.position.values().data();
  const double* rates_ = s_.faces.velocity ? s_.faces.velocity->values().data() : nullptr;
  FaceSums& sums_;
  OtherFaces faces_;
  PairPoints points_;
  std::int32_t first_, end_;
  const Shape *own_, *its_;
  std::ptrdiff_t own_face_, its_face_;
};

}  // namespace

void face_contact::operator()(SmallTasks) const {
  const int count = pairs->count();
  sums->blocks.resize(static_cast<std::size_t>(count));
  loads->pairs.resize(static_cast<std::size_t>(count));
  Deal tasks(count, tbb::this_task_arena::max_concurrency());
  for_pieces(tasks, [&](int pair) {
    FaceSums of_pair;
    PairPass(*this, pair, of_pair).run();
    entry(sums->blocks, pair) = of_pair.added_up();
  });
}

}  // namespace pulvis::space
