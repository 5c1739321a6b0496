// face_contact: narrow phase between particles in three dimensions: the Gauss points of every candidate face against the
// smooth surface of the other particle, with pressure, damping and friction; and the loads on that surface.
//
// Stages   pair_points.hpp -> projection.hpp -> contact_law.hpp (bond_points.hpp) -> other_loads.hpp, eight points at a time
// Runs     after bin_faces, before contact_force
// Active   if the scene has more than one particle
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/deal.hpp"
#include "engine/prefetch.hpp"
#include "systems/space/contact/ambiguous_points.hpp"
#include "systems/space/contact/bond_points.hpp"
#include "systems/space/contact/contact_law.hpp"
#include "systems/space/contact/gauss_points.hpp"
#include "systems/space/contact/other_loads.hpp"
#include "systems/space/contact/other_motion.hpp"
#include "systems/space/contact/pair_hardness.hpp"
#include "systems/space/contact/pair_points.hpp"
#include "systems/space/contact/projection.hpp"
#include "systems/space/contact/surface_motion.hpp"
#include "systems/space/contact/systems.hpp"

namespace pulvis::space {
namespace {

// Processes the points of one pair.
class PairPass {
 public:
  PairPass(const face_contact& system, int pair, FaceSums& sums)
      : s_(system),
        pair_(pair),
        sums_(sums),
        loads_(fetched(entry(system.loads->pairs, pair))),
        faces_(loads_) {
    const FacePairs& pairs = *s_.pairs;
    first_ = entry(pairs.begin, pair);
    end_ = entry(pairs.begin, pair + 1);
    const Row<FaceContact> row(first_);
    const int slot = s_.columns.pair(row, 0), other = s_.columns.pair(row, 2);
    friction_ = s_.columns.law(row, ContactLaw<FaceContact>::friction);
    rubs_ = s_.columns.law(row, ContactLaw<FaceContact>::friction) > 0;
    find_rules(slot, other);
    if (s_.columns.bonds) find_bonds(slot, other);
    own_ = &s_.bodies.shape_of(slot);
    its_ = &s_.bodies.shape_of(other);
    own_surface_ = s_.bodies.outline_begin(slot);
    its_surface_ = s_.bodies.outline_begin(other);
    hardness_ = PairHardness(s_.faces.hardness, slot, other);
    if (s_.columns.images) image_ = OtherImage(*s_.columns.images, row);
    approached_ = s_.clock->dt_before *
                  relative_speed(s_.columns.travel.of_surfaces, slot, other, image_.velocity);
  }

  void run() {
    std::array<unsigned, rows_at_once> active;
    for (std::int32_t from = first_; from < end_; from += rows_at_once) {
      const std::int32_t rows = std::min(end_ - from, rows_at_once);
      for (int i = 0; i < rows; ++i) {
        entry(active, i) = active_points(Row<FaceContact>(from + i));
        fetch(Row<FaceContact>(from + i), entry(active, i));
      }
      int next = next_active(active, 0, rows);
      while (next < rows) {
        const int i = next;
        next = next_active(active, i + 1, rows);
        if (next < rows)
          fetch_face(*own_, own_surface_, s_.columns.pair(Row<FaceContact>(from + next), 1));
        if (points_.is_full()) work();
        take(Row<FaceContact>(from + i), entry(active, i));
      }
    }
    work();
    faces_.finish();
    if (bonds_) entry(s_.columns.bonds->sums->blocks, pair_) = bond_sums_.added_up();
  }

 private:
  // Prefetches as many forces as there were in the previous step, before they are written.
  static PairLoads::Pair& fetched(PairLoads::Pair& loads) {
    constexpr std::size_t in_a_line = 2;
    for (std::size_t i = 0; i < loads.own.size(); i += in_a_line) prefetch(&loads.own[i]);
    return loads;
  }
  void find_rules(int slot, int other) {
    const auto& slots = s_.bodies.bodies->slots;
    const int a = entry(slots, slot).material, b = entry(slots, other).material;
    const SurfaceLaws& laws = s_.rules->between(a, b);
    adhesion_ = laws.adhesion;
    if (!s_.columns.points.lost) return;
    const FrictionParameters& friction = laws.friction;
    rubs_ = friction.acts();
    if (rubs_ && !friction.only_coulomb()) weakening_ = &friction;
  }
  void find_bonds(int slot, int other) {
    const auto& slots = s_.bodies.bodies->slots;
    const face_contact::Columns::Bonds& bonds = *s_.columns.bonds;
    const BondRules& rules = *bonds.columns.rules;
    const auto &a = entry(slots, slot), &b = entry(slots, other);
    bonds_.emplace(bonds.columns, s_.clock->time,
                   PointBonds<FaceContact>::Between{rules.initial_between(a, b),
                                                    rules.pressed_between(a, b), slot, other},
                   share, bond_sums_);
  }

  static constexpr double share = 0.5;  // of the stiffness: the other particle samples back
  static constexpr std::int32_t rows_at_once = 32;

  // Both have moved since the last step.
  unsigned active_points(Row<FaceContact> row) const {
    double& travel = s_.columns.travel.of_row(row);
    travel += approached_;
    return at_most(&s_.columns.activation(row), static_cast<float>(travel));
  }
  // The touching points are scattered among many: their cache lines are prefetched.
  void fetch(Row<FaceContact> row, unsigned active) const {
    for (unsigned left = active; left != 0; left &= left - 1)
      prefetch(&s_.columns.points.numbers(row, ContactPoint::numbers * std::countr_zero(left)));
    if (!hardness_ || active == 0) return;
    const int first = std::countr_zero(active), last = std::bit_width(active) - 1;
    prefetch(&(*s_.columns.points.indentation)(row, first));
    prefetch(&(*s_.columns.points.indentation)(row, last));
    hardness_.fetch_own(s_.columns.pair(row, 1));
  }
  static int next_active(const std::array<unsigned, rows_at_once>& active, int from, int rows) {
    while (from < rows && entry(active, from) == 0) ++from;
    return from;
  }
  void fetch_face(const Shape& shape, std::ptrdiff_t surface, int face) const {
    const Shape::Face& of = entry(shape.faces, face);
    for (const std::size_t p : {0, 2, 5, 7, 8, 10, 13, 15}) {  // the others are adjacent to them
      const std::ptrdiff_t at = surface + of.number[p];
      prefetch(positions_ + at);
      if (rates_ != nullptr) prefetch(rates_ + at);
    }
  }

  // At the points of the active halves.
  [[gnu::always_inline]] void sample(const double* column, const Shape::Face& face, unsigned active,
                                     double* out) const {
    const PatchNumbers own{column + own_surface_, face.number.data()};
    const bool first = (active & 0xffU) != 0, second = (active >> lane_count) != 0;
    if (first && second) {
      const auto both = sampled_points(own);
      store_half(both[0], out, 0);
      store_half(both[1], out, 1);
    } else {
      const int half = second ? 1 : 0;
      store_half(sampled_points(own, half), out, half);
    }
  }

  void take(Row<FaceContact> row, unsigned active) {
    using Law = ContactLaw<FaceContact>;
    const int number = s_.columns.pair(row, 1);
    const Shape::Face& face = entry(own_->faces, number);
    alignas(64) std::array<double, 3 * face_points> x, velocity;
    sample(positions_, face, active, x.data());
    if (rates_ != nullptr)
      sample(rates_, face, active, velocity.data());
    else
      velocity.fill(0);
    if (image_.is_there) image_.move(x, velocity);
    const pulvis::kernels::Hardness<double> hardness = hardness_.of_own(number);
    const double kappa = share * s_.columns.law(row, Law::stiffness),
                 damping = share * s_.columns.law(row, Law::damping),
                 inv_size = s_.columns.law(row, Law::inv_size),
                 travel = s_.columns.travel.of_row(row);
    // Of the row, whose points come one after the other.
    const face_contact::Columns::Points& columns = s_.columns.points;
    double* const numbers = &columns.numbers(row);
    float* const activation = &s_.columns.activation(row);
    double* const indentation = columns.indentation ? &(*columns.indentation)(row) : nullptr;
    double* const lost = weakening_ != nullptr ? &(*columns.lost)(row) : nullptr;
    double* const force = columns.force ? &(*columns.force)(row) : nullptr;
    const unsigned bonded = bonds_ ? bonds_->bonded(row) : 0;
    for (unsigned left = active; left != 0; left &= left - 1) {
      const auto g = static_cast<std::size_t>(std::countr_zero(left));
      double* kept = numbers + ContactPoint::numbers * g;
      const int its = static_cast<int>(kept[ContactPoint::face_u]);
      if (its != fetched_) {
        fetch_face(*its_, its_surface_, its);
        hardness_.fetch_other(its);
      }
      fetched_ = its;
      PairPoint& p = points_.add(its, (bonded >> g & 1) != 0);
      p.motion = {x[g],
                  x[face_points + g],
                  x[2 * face_points + g],
                  velocity[g],
                  velocity[face_points + g],
                  velocity[2 * face_points + g],
                  face.weight[g],
                  inv_size};
      p.state = {kappa,
                 damping,
                 travel,
                 hardness.pressure,
                 hardness.left,
                 indentation != nullptr ? indentation[g] : 0,
                 kept[ContactPoint::spring + 2],
                 0};
      p.indentation = indentation != nullptr ? indentation + g : nullptr;
      p.kept = kept;
      p.activation = activation + g;
      p.lost = lost != nullptr ? lost + g : nullptr;
      p.force = force != nullptr ? force + 3 * g : nullptr;
      p.row = static_cast<std::int32_t>(row.value);
      p.place = static_cast<std::int16_t>(g);
    }
    s_.columns.touches(row) = 0;
  }

  void work() {
    points_.for_eights([this](PointLanes& eight) { act(eight); });
    points_.take_out([this](const PairPoint& point) {
      if (point.touches) record_touch(point);
    });
  }

  void act(const PointLanes& eight) {
    const auto motion = numbers_of<8>(eight, [](const PairPoint& p) { return p.motion.data(); });
    const auto state = numbers_of<8>(eight, [](const PairPoint& p) { return p.state.data(); });
    const auto kept = numbers_of<4>(eight, [](const PairPoint& p) { return p.kept; });
    const VectorLanes points{motion[0], motion[1], motion[2]};
    const ProjectionStart start{eight.face,
                                kept[ContactPoint::face_u] - whole(kept[ContactPoint::face_u]),
                                kept[ContactPoint::v]};
    Projection p(*its_, positions_ + its_surface_, points, start);
    const SurfaceGap nearest = eight.bonded ? p.stay() : closest(eight, start, motion[7], p);
    const Lane overlap = bonds_ ? overlap_of(eight, nearest.gap) : Lane{};
    const Lane within = nearest.gap + overlap + adhesion_.range;
    // A NaN gap counts as touching, and so does what is bonded.
    const LaneMask real = LaneMask::of(eight.real);
    LaneMask touching = eight.bonded ? real : ~(within <= 0.0) & real;
    PointMotion m{select(touching, nearest.gap, Lane{}), nearest.normal};
    m.overlap = overlap;
    Reciprocal to;
    if (rates_ != nullptr || eight.bonded) to = Reciprocal::of(p.slopes);
    if (rates_ != nullptr)
      set_rates({motion[3], motion[4], motion[5]}, p.carried(rates_ + its_surface_), to, m);
    VectorLanes along;
    if (eight.bonded) {
      along = fma(m.gap, m.normal, p.offset);
      m = held_motion(m, along);
    }
    const PointLaw law = law_of(state, motion[7], motion[6]);
    Lane pressure, indenting{};
    if (hardness_) {
      indenting = indent(law, state[PairPoint::indented], hardness_.softer(state, eight), share, m);
      // Inside an indentation nothing acts but adhesion.
      if (!eight.bonded && adhesion_.range == 0) touching = touching & ~(m.pressing() <= 0.0);
    }
    PointForces f = normal_forces(law, m, s_.clock->dt_before, pressure);
    f.indentation_work = select(real, indenting * law.weight, Lane{});
    if (rubs_) {
      const VectorLanes spring =
          select(real, {kept[2], kept[3], state[PairPoint::spring_z]}, no_vector);
      if (weakening_ == nullptr) {
        pulvis::kernels::Coulomb<Lane> coulomb{friction_};
        add_friction(law, m, s_.clock->dt_before, pressure, spring, coulomb, f);
      } else {
        keep_lost(eight, add_weakening_friction({*weakening_, share, lost_of(eight)}, law, m,
                                                s_.clock->dt_before, pressure, spring, f));
      }
    }
    if (adhesion_.range > 0) attract(law, m, adhesion_, select(touching, Lane(share), Lane{}), f);
    if (bonds_)
      touching = touching | LaneMask::of(bond(eight, {p, points, along}, law, m, pressure, f));
    keep(eight, p, state[PairPoint::travel] - within, touching.bits(), f);
    if (hardness_) keep_indentation(eight, m.indentation);
    sums_.add(f);  // of released springs, too
    if (!any(touching)) return;
    record_depth(eight, m.pressing() * law.inv_size);
    if (eight.bonded)
      faces_.subtract(p.face, touching.bits(), {p.u, p.v, f.force, m.normal, Lane{}, Lane{}},
                      slope_loads(m, along, f.force, to));
    else
      act_back(p, m, f, to, touching.bits());
  }

  PointLaw law_of(const std::array<Lane, 8>& state, const Lane& inv_size,
                  const Lane& weight) const {
    const Lane& kappa = state[PairPoint::kappa];
    return {kappa,    friction_, state[PairPoint::damping],
            inv_size, weight,    s_.rules->tangential * kappa};
  }

  // At the closest points; points that did not converge carry no force.
  SurfaceGap closest(const PointLanes& eight, const ProjectionStart& start, const Lane& inv_size,
                     Projection& p) {
    p.find();
    SurfaceGap nearest = p.surface_gap();
    resolve_ambiguous(p, nearest, start, inv_size, eight.real);
    book(eight, p.unconverged());
    const Lane apart(-adhesion_.range);
    nearest.gap = select(LaneMask::of(p.unconverged()) & (nearest.gap > apart), apart, nearest.gap);
    return nearest;
  }

  // Adds the forces of bonded points to those of contact. Returns the points that are bonded from the next step on.
  struct Held {
    const Projection& p;
    const VectorLanes &point, &along;
  };
  static PlacesInRows places_of(const PointLanes& eight) {
    PlacesInRows at;
    for (int l = 0; l < lane_count; ++l) {
      entry(at.row, l) = entry(eight.point, l)->row;
      entry(at.point, l) = entry(eight.point, l)->place;
    }
    return at;
  }
  Lane overlap_of(const PointLanes& eight, const Lane& gap) const {
    return bonds_->overlap(places_of(eight), eight.real, eight.bonded ? eight.real : 0, gap);
  }
  [[gnu::noinline]] unsigned bond(const PointLanes& eight, const Held& held, const PointLaw& law,
                                  const PointMotion& m, const Lane& pressure, PointForces& f) {
    const PlacesInRows at = places_of(eight);
    std::array<std::int32_t, lane_count> face;
    for (int l = 0; l < lane_count; ++l)
      entry(face, l) = s_.columns.pair(Row<FaceContact>(entry(at.row, l)), 1);
    unsigned made = 0;
    if (bonds_->may_weld())
      made = bonds_->press(at, eight.real & (eight.bonded ? 0xffU : held.p.on_face()), pressure);
    if (eight.bonded) bonds_->hold({at, eight.real, face, held.point, held.along}, law, m, f);
    return made;
  }

  void act_back(const Projection& p, const PointMotion& m, const PointForces& f,
                const Reciprocal& to, unsigned touching) {
    const Lane u = min(max(p.u, Lane{}), 1.0), v = min(max(p.v, Lane{}), 1.0);
    if (rubs_)
      faces_.subtract<true>(
          p.face, touching,
          {u, v, f.force, m.normal, m.gap * dot(f.friction, to.u), m.gap * dot(f.friction, to.v)});
    else
      faces_.subtract<false>(p.face, touching, {u, v, f.force, m.normal, Lane{}, Lane{}});
  }

  template <std::size_t Count, class First>
  static std::array<Lane, Count> numbers_of(const PointLanes& eight, const First& first) {
    std::array<const double*, lane_count> row;
    for (int l = 0; l < lane_count; ++l) entry(row, l) = first(*entry(eight.point, l));
    return columns_of<Count>(row);
  }

  // ---- columns and sums --------------------------------------------------------------------------------
  // `resting`: m, RowTravel up to which what does not touch is inactive.
  void keep(const PointLanes& eight, const Projection& p, const Lane& resting, unsigned touching,
            const PointForces& f) const {
    static constexpr double last = 1 - 1e-12;  // an end belongs to its own face
    const Lane faces = Lane::from([&](int l) { return static_cast<double>(entry(p.face, l)); });
    alignas(64) ByPoint kept;
    by_point({faces + min(max(p.u, Lane{}), last), min(max(p.v, Lane{}), 1.0), f.elastic_slip.x,
              f.elastic_slip.y, f.elastic_slip.z, f.force.x, f.force.y, f.force.z},
             kept);
    // Zero marks a touching point.
    alignas(64) std::array<double, lane_count> activation;
    constexpr double never_zero = std::numeric_limits<float>::min(), early = 1 - 0x1p-22;
    select(LaneMask::of(touching), Lane{}, max(early * resting, never_zero))
        .store(activation.data());
    for (std::size_t l = 0; l < lane_count && (eight.real >> l & 1) != 0; ++l) {
      PairPoint& point = *eight.point[l];
      const double *numbers = kept[l].data(), *force = numbers + ContactPoint::numbers;
      std::copy_n(numbers, ContactPoint::numbers, point.kept);
      *point.activation = static_cast<float>(activation[l]);
      if (point.force != nullptr) std::copy_n(force, 3, point.force);
      std::copy_n(force, 3, point.motion.begin());
      point.touches = (touching >> l & 1) != 0;
    }
  }
  void record_touch(const PairPoint& point) {
    make_room(loads_.own);
    loads_.own.push_back({point.motion[0], point.motion[1], point.motion[2]});
    std::uint8_t& touches = s_.columns.touches(Row<FaceContact>(point.row));
    sums_.block.touching += touches == 0 ? 1 : 0;
    touches = 1;
  }
  static void keep_indentation(const PointLanes& eight, const Lane& indentation) {
    for (int l = 0; l < lane_count && (eight.real >> l & 1) != 0; ++l)
      *entry(eight.point, l)->indentation = indentation[l];
  }
  static Lane lost_of(const PointLanes& eight) {
    return Lane::from([&](int l) { return *entry(eight.point, l)->lost; });
  }
  static void keep_lost(const PointLanes& eight, const Lane& lost) {
    for (int l = 0; l < lane_count && (eight.real >> l & 1) != 0; ++l)
      *entry(eight.point, l)->lost = lost[l];
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
  void record_depth(const PointLanes& eight, const Lane& depth) const {
    if (all(depth <= Lane(sums_.block.depth))) return;
    for (int l = 0; l < lane_count; ++l) sums_.record_depth(entry(eight.point, l)->row, depth[l]);
  }

  const VectorLanes no_vector{Lane{}, Lane{}, Lane{}};
  const face_contact& s_;
  const int pair_;
  const double* positions_ = s_.faces.position.values().data();
  const double* rates_ = s_.faces.velocity ? s_.faces.velocity->values().data() : nullptr;
  FaceSums& sums_;
  Lane friction_;
  bool rubs_;
  const FrictionParameters* weakening_ = nullptr;  // if friction is not just Coulomb's
  AdhesionParameters adhesion_;
  std::optional<PointBonds<FaceContact>> bonds_;
  BondSumsOfBlock bond_sums_;
  PairLoads::Pair& loads_;
  OtherFaces faces_;  // of loads_
  PairHardness hardness_;
  PairPoints points_;
  OtherImage image_;
  double approached_;  // m, by both surfaces since the last step, at most
  std::int32_t first_, end_;
  const Shape *own_, *its_;
  std::ptrdiff_t own_surface_, its_surface_;
  int fetched_ = -1;  // face of the other particle
};

}  // namespace

void face_contact::operator()(SmallTasks) const {
  const int count = pairs->count();
  sums->blocks.resize(static_cast<std::size_t>(count));
  if (columns.bonds) columns.bonds->sums->blocks.resize(static_cast<std::size_t>(count));
  // Memory allocated for other pairs is released.
  if (std::ssize(loads->pairs) != count)
    loads->pairs = std::vector<PairLoads::Pair>(static_cast<std::size_t>(count));
  Deal tasks(count, tbb::this_task_arena::max_concurrency());
  for_pieces(tasks, [&](int pair) {
    FaceSums of_pair;
    PairPass(*this, pair, of_pair).run();
    entry(sums->blocks, pair) = of_pair.added_up();
  });
}

}  // namespace pulvis::space
