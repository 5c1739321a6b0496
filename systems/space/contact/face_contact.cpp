// face_contact: narrow phase between particles in three dimensions: the Gauss points of every candidate face against the
// smooth surface of the other particle, with pressure, damping and friction.
//
// Stages   projection.hpp -> contact_law.hpp, eight points at a time
// Runs     after bin_faces, before contact_force
// Active   when the scene has more than one particle
#include <bit>
#include <cmath>

#include "engine/prefetch.hpp"
#include "systems/space/contact/blocks.hpp"
#include "systems/space/contact/contact_law.hpp"
#include "systems/space/contact/gauss_points.hpp"
#include "systems/space/contact/projection.hpp"
#include "systems/space/contact/systems.hpp"

namespace pulvis::space {
namespace {

// The closest points that a candidate keeps of a half.
struct PackedSpots {
  static constexpr double last = 1 - 1e-12;  // an end belongs to its own face
  double* first;                             // face + u of all sixteen, then v

  [[gnu::always_inline]] void unpack(int half, Projection& p) const {
    const Lane number = Lane::load(first + lane_count * half), whole_number = whole(number);
    std::array<double, lane_count> faces;
    whole_number.store(faces.data());
    for (std::size_t l = 0; l < lane_count; ++l) p.face[l] = static_cast<std::int32_t>(faces[l]);
    p.u = number - whole_number;
    p.v = Lane::load(first + face_points + lane_count * half);
  }
  [[gnu::always_inline]] void pack(int half, const Projection& p) const {
    const Lane faces = Lane::from([&](int l) { return static_cast<double>(entry(p.face, l)); });
    (faces + min(max(p.u, Lane{}), last)).store(first + lane_count * half);
    min(max(p.v, Lane{}), 1.0).store(first + face_points + lane_count * half);
  }
};

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

struct FacePass {
  static constexpr double share = 0.5;  // of the stiffness: the other particle samples back
  const face_contact& s;
  const double* points = s.faces.position.values().data();
  const double* rates = s.faces.velocity ? s.faces.velocity->values().data() : nullptr;

  bool active(Row<FaceContact> row) const {
    return s.clock->travel >= std::min(s.columns.activation(row, 0), s.columns.activation(row, 1));
  }
  // The row's numbers, and both surfaces, the other where it was met last.
  void fetch(Row<FaceContact> row) const {
    const double* closest = &s.closest(row);
    fetch_lines<4>(closest);
    fetch_lines<6>(&s.columns.force(row));
    if (s.columns.slip) fetch_lines<6>(&(*s.columns.slip)(row));
    const int other = s.columns.pair(row, 2);
    for (const double* list : {points, rates}) {
      if (list == nullptr) continue;
      fetch_lines<6>(list + own_face(row) * face_numbers);
      fetch_lines<6>(list + (s.bodies.first_face(other) + static_cast<std::ptrdiff_t>(*closest)) *
                                face_numbers);
    }
  }
  void operator()(Row<FaceContact> row, FaceSums& sums) const {
    const std::ptrdiff_t own = own_face(row) * face_numbers;
    const int other = s.columns.pair(row, 2);
    const std::ptrdiff_t its = s.bodies.first_face(other) * std::ptrdiff_t{face_numbers};
    const Shape& shape = s.bodies.shape_of(other);
    Projection low(shape, points + its), high(shape, points + its);
    RowMotion motion;
    project(row, 0, points + own, low, motion, sums);
    project(row, 1, points + own, high, motion, sums);
    if (motion.touching == 0) {
      s.columns.touches(row) = 0;
      return;
    }
    const Shape::Face& face =
        entry(s.bodies.shape_of(s.columns.pair(row, 0)).faces, s.columns.pair(row, 1));
    std::array<VectorLanes, 2> along;
    std::array<Reciprocal, 2> reciprocal;
    if (rates != nullptr)
      for (int half = 0; half < 2; ++half) {
        if (!motion.touches(half)) continue;
        Projection& p = half == 0 ? low : high;
        entry(reciprocal, half) = Reciprocal::of(p.slopes);
        set_rates(sampled_points(rates + own, half), p.carried(rates + its),
                  entry(reciprocal, half), entry(motion.half, half));
      }
    act(s.columns, row, face, motion, share, s.clock->dt_before, sums, along);
    if (!s.couple) return;
    for (int half = 0; half < 2; ++half)
      if (motion.touches(half))
        keep_couple(row, half, entry(motion.half, half), entry(along, half),
                    entry(reciprocal, half));
  }

 private:
  template <int Lines>
  static void fetch_lines(const double* first) {
    for (int line = 0; line < Lines; ++line) prefetch(first + 8 * line);
  }
  std::ptrdiff_t own_face(Row<FaceContact> row) const {
    return s.bodies.first_face(s.columns.pair(row, 0)) + s.columns.pair(row, 1);
  }
  // A half that is apart rests until it can touch.
  [[gnu::always_inline]] void project(Row<FaceContact> row, int half, const double* face,
                                      Projection& p, RowMotion& motion, FaceSums& sums) const {
    if (s.clock->travel < s.columns.activation(row, half)) return;
    const PackedSpots spots{&s.closest(row)};
    p.point = sampled_points(face, half);
    spots.unpack(half, p);
    p.find();
    spots.pack(half, p);
    const Standing standing = p.standing();
    book(row, p.unconverged(), sums.block);
    double& activation = s.columns.activation(row, half);
    if (any(standing.gap > 0.0)) {
      entry(motion.half, half) = {standing.gap, standing.normal};
      motion.touching |= 1U << half;
      activation = 0;
    } else {
      activation = s.clock->travel - FaceSums::greatest(standing.gap);
    }
  }
  static void book(Row<FaceContact> row, unsigned unconverged, BlockSums& block) {
    block.projections += lane_count;
    if (unconverged == 0) return;
    if (block.unconverged == 0) block.first_unconverged = row.value;
    block.unconverged += std::popcount(unconverged);
  }
  // -g (T . a^u) n acts on the other surface's slope along u; the same along v.
  void keep_couple(Row<FaceContact> row, int half, const PointMotion& m, const VectorLanes& along,
                   const Reciprocal& to) const {
    double* couple = &(*s.couple)(row);
    const Lane gap = max(m.gap, Lane{});
    store_half((gap * dot(along, to.u)) * m.normal, couple, half);
    store_half((gap * dot(along, to.v)) * m.normal, couple + 3 * face_points, half);
  }
};

}  // namespace

void face_contact::operator()(SmallTasks) const {
  for_active_rows<FaceContact>(columns.pair.rows(), sums->blocks, FacePass{*this});
}

}  // namespace pulvis::space
