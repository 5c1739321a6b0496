// Projection: closest points of eight points on the smooth surface of another particle.
//
// Method   Newton's (patch_kernel.hpp) from the previous closest point; a step crosses at most one face, into
//          the next one. The step limit is quartered each time a step goes back across a side just crossed, since curvatures
//          jump there; it doubles again later. A point that oscillates even with small steps is closest to the side itself,
//          or to its end, where surfaces have a crease: it then moves along it
// Lanes    each point stops independently, so that no result depends on the other points
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "components/space/contact.hpp"
#include "engine/lane_memory.hpp"
#include "systems/space/contact/patch_kernel.hpp"
#include "systems/space/contact/surface_walk.hpp"

namespace pulvis::space {

using VectorLanes = kernels::Vector<Lane>;

// The Bezier points of eight faces, one face per lane.
struct PatchLanes {
  std::array<Lane, face_numbers> all;
  const Lane& operator()(int k, int p) const { return all[static_cast<std::size_t>(16 * k + p)]; }

  // `first`: the particle's Bezier points.
  [[gnu::always_inline]] void gather(const Shape& shape, const double* first,
                                     const std::array<std::int32_t, 8>& face) {
    std::array<const std::int32_t*, lane_count> number;
    for (std::size_t l = 0; l < lane_count; ++l)
      number[l] = entry(shape.faces, face[l]).number.data();
    for (std::size_t p = 0; p < patch_points; ++p) {
      std::array<const double*, lane_count> row;
      for (std::size_t l = 0; l < lane_count; ++l) row[l] = first + number[l][p];
      const auto columns = columns_of<4>(row);  // plus the first number of the next point
      for (std::size_t k = 0; k < 3; ++k) all[16 * k + p] = columns[k];
    }
  }
};

// Position of a point relative to another surface.
struct SurfaceGap {
  Lane gap;            // m, > 0 in penetration; otherwise minus the distance
  VectorLanes normal;  // outward, of the other surface
};

// Starting point of the closest-point search.
struct ProjectionStart {
  std::array<std::int32_t, 8> face;
  Lane u, v;
};

struct Projection {
  static constexpr int max_steps = 40;
  static constexpr double least_sine2 = 0.05 * 0.05;  // of the angle between the slopes of a face
  static constexpr int crossings_of_crease = 7;       // over one side, back and forth
  static constexpr int most_crossings = 16;           // around the end of a crease

  const Shape* shape;   // of the other particle
  const double* first;  // its Bezier points
  VectorLanes point;    // m
  std::array<std::int32_t, 8> face;
  Lane u, v;  // closest so far; once converged, on its face
  unsigned done = 0;

  Projection(const Shape& other, const double* first_point, const VectorLanes& points,
             const ProjectionStart& start)
      : shape(&other),
        first(first_point),
        point(points),
        face(start.face),
        u(start.u),
        v(start.v) {}

  unsigned unconverged() const { return ~done & 0xffU; }
  // Converged inside a face: the offset is normal to the surface.
  unsigned on_face() const { return done & ~(held_u_ | held_v_); }

  // Stays at the start, wherever the points are.
  [[gnu::noinline]] SurfaceGap stay() {
    gather();
    evaluate();
    slopes = {at_.x, at_.u, at_.v};
    offset = point - slopes.x;
    across_ = cross(slopes.u, slopes.v);
    done = 0xffU;
    return surface_gap();
  }

  [[gnu::always_inline]] void find() {
    gather();
    for (int step = 0;; ++step) {
      evaluate();
      r_ = point - at_.x;
      newton_ = kernels::newton(at_, r_);
      const Lane along_u = dot(r_, at_.u), along_v = dot(r_, at_.v);
      du_ = newton_.step_u(along_u, along_v);
      dv_ = newton_.step_v(along_u, along_v);
      if (held_u_ | held_v_) hold(along_u, along_v);
      const unsigned found = find_done();
      done |= found;
      if (done == 0xffU || step == max_steps) break;
      move();
    }
    settle();
  }

  SurfaceGap surface_gap() const {
    const Lane inv_area = 1.0 / sqrt(dot(across_, across_));
    SurfaceGap s;
    s.normal = inv_area * across_;
    s.gap = -dot(offset, s.normal);
    if ((held_u_ | held_v_) != 0) look_to_crease(s);
    return s;
  }

  // Interpolates a field on the faces at the closest points; `from`: its values at the particle's Bezier points.
  kernels::PatchSlopes<Lane> carried(const double* from) {
    const TwoPatches two = two_patches(from);
    if (faces_ == 1) return kernels::patch_slopes<Lane>(OnePatch{two.first}, u, v);
    if (faces_ == 2) return kernels::patch_slopes<Lane>(two, u, v);
    patch.gather(*shape, from, face);
    return kernels::patch_slopes<Lane>(patch, u, v);
  }

  PatchLanes patch;
  kernels::PatchSlopes<Lane>
      slopes;          // of the surface at the closest point (x: before the last correction)
  VectorLanes offset;  // m, from the closest point to the point

 private:
  // If the points face only one or two faces, the patches need not be gathered per lane.
  [[gnu::always_inline]] void gather() {
    faces_ = 1;
    unsigned of_second = 0;
    second_ = face[0];
    for (std::size_t l = 1; l < lane_count; ++l) {
      if (face[l] == face[0]) continue;
      if (faces_ == 1) {
        faces_ = 2;
        second_ = face[l];
      }
      if (face[l] == second_)
        of_second |= 1U << l;
      else
        faces_ = 3;
    }
    on_second_ = LaneMask::of(of_second);
    if (faces_ == 3) patch.gather(*shape, first, face);
  }
  struct OnePatch {
    PatchNumbers face;
    Lane operator()(int k, int p) const { return {face(k, p)}; }
  };
  struct TwoPatches {
    PatchNumbers first, second;
    LaneMask on_second;
    Lane operator()(int k, int p) const {
      return select(on_second, Lane(second(k, p)), Lane(first(k, p)));
    }
  };
  TwoPatches two_patches(const double* from) const {
    return {{from, entry(shape->faces, face[0]).number.data()},
            {from, entry(shape->faces, second_).number.data()},
            on_second_};
  }
  [[gnu::noinline]] void evaluate() {
    const TwoPatches two = two_patches(first);
    at_ = faces_ == 1   ? kernels::patch_point<Lane>(OnePatch{two.first}, u, v)
          : faces_ == 2 ? kernels::patch_point<Lane>(two, u, v)
                        : kernels::patch_point<Lane>(patch, u, v);
  }
  // Along a crease.
  [[gnu::noinline]] void hold(const Lane& along_u, const Lane& along_v) {
    const Lane zero{};
    const LaneMask u_held = LaneMask::of(held_u_), v_held = LaneMask::of(held_v_);
    const Lane aa = dot(at_.u, at_.u), cc = dot(at_.v, at_.v);
    const Lane only_u = along_u / max(aa - dot(r_, at_.uu), 0.25 * aa);
    const Lane only_v = along_v / max(cc - dot(r_, at_.vv), 0.25 * cc);
    du_ = select(u_held, zero, select(v_held, only_u, du_));
    dv_ = select(v_held, zero, select(u_held, only_v, dv_));
    // Not beyond the end of the side.
    const LaneMask held = u_held | v_held;
    du_ = select(held, min(max(u + du_, zero), 1.0) - u, du_);
    dv_ = select(held, min(max(v + dv_, zero), 1.0) - v, dv_);
  }
  // Lanes whose step is small and does not leave the face.
  [[gnu::always_inline]] unsigned find_done() const {
    const Lane zero{}, one(1.0), next_u = u + du_, next_v = v + dv_;
    const LaneMask small = max(abs(du_), abs(dv_)) < Lane(kernels::near_step);
    return (small & (next_u >= zero) & (next_u <= one) & (next_v >= zero) & (next_v <= one)).bits();
  }
  [[gnu::noinline]] void move() {
    const LaneMask fixed = LaneMask::of(done);
    const Lane zero{};
    u += select(fixed, zero, min(max(du_, -longest_), longest_));
    v += select(fixed, zero, min(max(dv_, -longest_), longest_));
    longest_ = min(2.0 * longest_, 1.0);
    const unsigned inside = ((u >= zero) & (u <= 1.0) & (v >= zero) & (v <= 1.0)).bits();
    if (inside == 0xffU) return;
    for (int l = 0; l < lane_count; ++l)
      if ((inside >> l & 1) == 0) cross_side(l);
    gather();
  }
  void cross_side(int l) {
    const auto lane = static_cast<std::size_t>(l);
    if (!std::isfinite(u[l]) || !std::isfinite(v[l])) {
      u[l] = v[l] = 0.5;
      return;
    }
    const int side = side_left(u[l], v[l]);
    const SurfaceSpot from{face[lane], u[l], v[l]};
    const SurfaceSpot to = across(*shape, from, side);
    const bool back = to.face == came_from_[lane] || to.face == from.face;
    crossings_[lane] = back ? crossings_[lane] + 1 : 1;
    if (back) longest_[l] *= 0.125;  // relative to the current limit
    came_from_[lane] = from.face;
    face[lane] = to.face;
    u[l] = to.u;
    v[l] = to.v;
    if (crossings_[lane] >= crossings_of_crease || ++all_crossings_[lane] > most_crossings ||
        to.face == from.face)
      stay_on_side(l, from, side);
  }
  void stay_on_side(int l, const SurfaceSpot& from, int side) {
    const auto lane = static_cast<std::size_t>(l);
    const BesideSide at = beside(side, from.u, from.v);
    const SurfaceSpot on = space::inside(from.face, side, std::clamp(at.along, 0.0, 1.0), 0);
    face[lane] = on.face;
    u[l] = on.u;
    v[l] = on.v;
    (side % 2 == 1 ? held_u_ : held_v_) |= 1U << l;
  }
  // The last, small step, and its correction.
  [[gnu::always_inline]] void settle() {
    // For points that did not converge, the next step may lead anywhere.
    if (done != 0xffU) keep_steps(done, du_, dv_);
    slopes = kernels::taylor(at_, du_, dv_);
    offset = point - slopes.x;
    const Lane along_u = dot(offset, slopes.u), along_v = dot(offset, slopes.v);
    Lane more_u = newton_.step_u(along_u, along_v), more_v = newton_.step_v(along_u, along_v);
    const unsigned free = done & ~(held_u_ | held_v_);
    if (free != 0xffU) keep_steps(free, more_u, more_v);
    offset = offset - (more_u * slopes.u + more_v * slopes.v);
    slopes.u = fma(more_u, at_.uu, fma(more_v, at_.uv, slopes.u));
    slopes.v = fma(more_u, at_.uv, fma(more_v, at_.vv, slopes.v));
    du_ += more_u;
    dv_ += more_v;
    u += du_;
    v += dv_;
    across_ = cross(slopes.u, slopes.v);
    // A point does not converge where the surface has no normal, as in the fold of a crushed face.
    done &=
        ~(dot(across_, across_) < least_sine2 * (dot(slopes.u, slopes.u) * dot(slopes.v, slopes.v)))
             .bits();
  }
  // Only in the lanes whose bits are set.
  [[gnu::noinline]] static void keep_steps(unsigned lanes, Lane& along_u, Lane& along_v) {
    const LaneMask kept = LaneMask::of(lanes);
    along_u = select(kept, along_u, Lane{});
    along_v = select(kept, along_v, Lane{});
  }
  // On a crease the normal is the direction towards the point itself.
  [[gnu::noinline]] void look_to_crease(SurfaceGap& s) const {
    const Lane distance = sqrt(dot(offset, offset));
    const LaneMask held = LaneMask::of(held_u_ | held_v_) & (distance > 0.0);
    const Lane sign = select(s.gap > 0.0, Lane(-1.0), Lane(1.0));
    s.normal = select(held, (sign / distance) * offset, s.normal);
    s.gap = select(held, -(sign * distance), s.gap);
  }

  int faces_ = 1;  // number of faces that the points project on; 3: or more
  std::int32_t second_ = 0;
  LaneMask on_second_;
  kernels::PatchPoint<Lane> at_;
  kernels::Newton<Lane> newton_;
  VectorLanes r_, across_;
  Lane du_, dv_, longest_{1.0};  // steps, and their maximum length
  unsigned held_u_ = 0, held_v_ = 0;
  std::array<std::int32_t, 8> came_from_{-1, -1, -1, -1, -1, -1, -1, -1};
  std::array<std::int32_t, 8> crossings_{}, all_crossings_{};
};

}  // namespace pulvis::space
