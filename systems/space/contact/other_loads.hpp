// Loads from the points of a pair on the faces of the other particle, at the closest points.
//
// Law      Bezier point p of the other face receives -N_p(u, v) f, and if friction acts across a gap g
//          -(N_p,u C_u + N_p,v C_v) n with C_a = g (T . a^a): see contact_law.hpp. If the forces act at a place of that
//          surface that is not opposite, d_t beside it (bonds), N_p,u G_u + N_p,v G_v with
//          G_a = (M . a^a) n + M_n/2 n x a^a,   M = -g T - P d_t,   M_n = -(d_t x T) . n   [P: force along n]
//          by which angular momentum is conserved
#pragma once

#include <algorithm>
#include <array>

#include "components/space/contact.hpp"
#include "engine/lane_memory.hpp"
#include "systems/space/contact/face_load.hpp"
#include "systems/space/contact/patch_kernel.hpp"
#include "systems/space/contact/vector.hpp"

namespace pulvis::space {

// Eight points: closest-point coordinates and forces.
struct OtherForces {
  Lane u, v;
  kernels::Vector<Lane> force, normal;
  Lane couple_u, couple_v;  // C_u, C_v
};

// Eight numbers for each of eight points, the numbers of a point contiguous.
using ByPoint = std::array<std::array<double, 8>, 8>;
[[gnu::always_inline]] inline void by_point(const std::array<Lane, 8>& numbers, ByPoint& out) {
  std::array<const double*, 8> row;
  for (std::size_t i = 0; i < 8; ++i) row[i] = reinterpret_cast<const double*>(&numbers[i]);
  const auto column = columns_of(row);
  for (std::size_t i = 0; i < 8; ++i) column[i].store(out[i].data());
}

// Reserves a few entries at a time: there are many lists, and they hardly grow from step to step.
template <class T>
void make_room(std::vector<T>& list) {
  constexpr std::size_t few = 4;
  if (list.size() == list.capacity()) list.reserve(list.size() + few);
}

class OtherFaces {
 public:
  explicit OtherFaces(PairLoads::Pair& loads) : loads_(loads) { loads_.clear(); }

  // Subtracts the forces of the points whose bit is set in `bearing`. face[l]: of the other particle.
  template <bool Friction>
  void subtract(const std::array<std::int32_t, 8>& face, unsigned bearing, const OtherForces& f) {
    const auto bu = kernels::bernstein(f.u), bv = kernels::bernstein(f.v);
    alignas(64) ByPoint basis, slopes, acting;
    by_point({bu[0], bu[1], bu[2], bu[3], bv[0], bv[1], bv[2], bv[3]}, basis);
    if constexpr (Friction) {
      const auto du = kernels::bernstein_slope(f.u), dv = kernels::bernstein_slope(f.v);
      const Lane &cu = f.couple_u, &cv = f.couple_v;
      by_point({cu * du[0], cu * du[1], cu * du[2], cu * du[3], cv * dv[0], cv * dv[1], cv * dv[2],
                cv * dv[3]},
               slopes);
    }
    const Lane none{};
    by_point(
        {-f.force.x, -f.force.y, -f.force.z, -f.normal.x, -f.normal.y, -f.normal.z, none, none},
        acting);
    for (std::size_t l = 0; l < lane_count; ++l) {
      if ((bearing >> l & 1) == 0) continue;
      move_to(face[l]);
      const double *b = basis[l].data(), *c = b + 4, *a = acting[l].data();
      load_.add(outer(b, c), {a[0], a[1], a[2]});
      if constexpr (Friction) {
        const double* d = slopes[l].data();
        const OfPatch along_u = outer(d, c), along_v = outer(b, d + 4);
        load_.add({along_u[0] + along_v[0], along_u[1] + along_v[1]}, {a[3], a[4], a[5]});
      }
    }
  }
  // As above, with any load G_u, G_v on the slopes, which is added.
  struct SlopeLoads {
    kernels::Vector<Lane> u, v;
  };
  [[gnu::noinline]] void subtract(const std::array<std::int32_t, 8>& face, unsigned bearing,
                                  const OtherForces& f, const SlopeLoads& on) {
    const auto bu = kernels::bernstein(f.u), bv = kernels::bernstein(f.v);
    const auto du = kernels::bernstein_slope(f.u), dv = kernels::bernstein_slope(f.v);
    alignas(64) ByPoint basis, slopes, acting, turning;
    by_point({bu[0], bu[1], bu[2], bu[3], bv[0], bv[1], bv[2], bv[3]}, basis);
    by_point({du[0], du[1], du[2], du[3], dv[0], dv[1], dv[2], dv[3]}, slopes);
    const Lane none{};
    by_point({-f.force.x, -f.force.y, -f.force.z, none, none, none, none, none}, acting);
    by_point({on.u.x, on.u.y, on.u.z, on.v.x, on.v.y, on.v.z, none, none}, turning);
    for (std::size_t l = 0; l < lane_count; ++l) {
      if ((bearing >> l & 1) == 0) continue;
      move_to(face[l]);
      const double *b = basis[l].data(), *d = slopes[l].data(), *a = acting[l].data(),
                   *g = turning[l].data();
      load_.add(outer(b, b + 4), {a[0], a[1], a[2]});
      load_.add(outer(d, b + 4), {g[0], g[1], g[2]});
      load_.add(outer(b, d + 4), {g[3], g[4], g[5]});
    }
  }
  void finish() {
    if (at_ >= 0) load_.store(loads_.load[static_cast<std::size_t>(at_)].force.data());
  }

 private:
  void move_to(std::int32_t face) {
    if (at_ >= 0 && loads_.face[static_cast<std::size_t>(at_)] == face) return;
    finish();
    const auto last = std::find(loads_.face.rbegin(), loads_.face.rend(), face);
    at_ = static_cast<int>(loads_.face.rend() - last) - 1;
    if (at_ >= 0) return load_.fetch(loads_.load[static_cast<std::size_t>(at_)].force.data());
    at_ = static_cast<int>(loads_.face.size());
    loads_.face.push_back(face);
    make_room(loads_.load);
    loads_.load.emplace_back();
    load_.clear();
  }

  PairLoads::Pair& loads_;
  FaceLoad load_;
  int at_ = -1;  // in the list of faces
};

}  // namespace pulvis::space
