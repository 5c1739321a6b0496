// Assembly: from the forces of contact points to those of Bezier points, and from there to surface nodes.
//
// Law      Bezier point p of the sampled face takes N_p(u_g, v_g) f_g, that of the other body -N_p(u*, v*) f_g at the
//          closest point, and where friction acts across a gap minus its slopes times the couples; nodes take the transpose
//          of points = terms * nodes
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "components/space/contact.hpp"
#include "engine/lane_memory.hpp"
#include "systems/space/contact/gauss_points.hpp"
#include "systems/space/contact/patch_kernel.hpp"

namespace pulvis::space {

// A number of all sixteen Bezier points of a face, in their order.
using OfPatch = std::array<Lane, 2>;

// Of the Gauss points: [Gauss point][Bezier point].
inline constexpr auto basis_by_point = [] {
  std::array<std::array<double, 16>, face_points> n{};
  for (std::size_t g = 0; g < face_points; ++g)
    for (std::size_t p = 0; p < 16; ++p) n[g][p] = basis_at_points[g / 8][p][g % 8];
  return n;
}();

// b_i(u) c_j(v)
[[gnu::always_inline]] inline OfPatch outer(const std::array<double, 4>& b,
                                            const std::array<double, 4>& c) {
  const Lane along_u = load_halves(b.data(), b.data());
  return {along_u * halves(c[0], c[1]), along_u * halves(c[2], c[3])};
}

// The faces that bear a force on some particle of the chunk. The others are passed over: their forces are zero, since
// to_nodes clears what it has read and nobody else writes them.
using BorneFaces = std::vector<std::uint8_t>;

// What the faces of one particle bear.
struct FaceForces {
  double* first;  // of its first face
  BorneFaces& borne;

  double* on(int face) const {
    entry(borne, face) = 1;
    return first + static_cast<std::ptrdiff_t>(face) * face_numbers;
  }
};

// Forces of sixteen points (all x, y, z) on the face that they sample.
inline void add_sampled(const double* force, double* face) {
  for (int k = 0; k < 3; ++k) {
    Lane low = Lane::load(face + 16 * k), high = Lane::load(face + 16 * k + lane_count);
    for (int g = 0; g < face_points; ++g) {
      const double* n = entry(basis_by_point, g).data();
      const Lane f(force[face_points * k + g]);
      low = fma(f, Lane::load(n), low);
      high = fma(f, Lane::load(n + lane_count), high);
    }
    low.store(face + 16 * k);
    high.store(face + 16 * k + lane_count);
  }
}

// What a face bears, in registers while one closest point after the other stands on it.
struct FaceLoad {
  double* at = nullptr;
  std::array<OfPatch, 3> sum;

  void move_to(double* face) {
    if (face == at) return;
    put_back();
    at = face;
    for (int k = 0; k < 3; ++k)
      entry(sum, k) = {Lane::load(face + 16 * k), Lane::load(face + 16 * k + lane_count)};
  }
  void put_back() const {
    if (at == nullptr) return;
    for (int k = 0; k < 3; ++k)
      for (int half = 0; half < 2; ++half)
        entry(entry(sum, k), half).store(at + 16 * k + lane_count * half);
  }
  // Shares of Bezier points times a vector, that of point g in a list (all x, y, z).
  [[gnu::always_inline]] void subtract(const OfPatch& share, const double* list, int g) {
    for (int k = 0; k < 3; ++k) {
      const Lane f(-list[face_points * k + g]);
      OfPatch& of = entry(sum, k);
      of = {fma(share[0], f, of[0]), fma(share[1], f, of[1])};
    }
  }
};

// The opposite forces on the other body. `couple`: null without friction.
[[gnu::always_inline]] inline void add_other(const double* closest, const double* force,
                                             const double* couple, const FaceForces& other) {
  FaceLoad load;
  for (int g = 0; g < face_points; ++g) {
    if (force[g] == 0 && force[face_points + g] == 0 && force[2 * face_points + g] == 0) continue;
    const int face = static_cast<int>(closest[g]);
    const double u = closest[g] - face, v = closest[face_points + g];
    const auto bu = kernels::bernstein(u), bv = kernels::bernstein(v);
    load.move_to(other.on(face));
    load.subtract(outer(bu, bv), force, g);
    if (couple == nullptr) continue;
    load.subtract(outer(kernels::bernstein_slope(u), bv), couple, g);
    load.subtract(outer(bu, kernels::bernstein_slope(v)), couple + 3 * face_points, g);
  }
  load.put_back();
}

// From the faces of eight particles, `apart` numbers a particle, to the Bezier points that they share; marks these.
template <class Load>
void to_points(const Shape& shape, double* face_force, std::ptrdiff_t apart,
               const BorneFaces& borne, const Load& load, std::vector<std::uint8_t>& loaded) {
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    if (borne[f] == 0) continue;
    const Shape::Face& face = shape.faces[f];
    for (int block = 0; block < face_numbers; block += lane_count) {
      std::array<const double*, lane_count> rows;
      double* const first = face_force + static_cast<std::ptrdiff_t>(f) * face_numbers + block;
      for (int l = 0; l < lane_count; ++l) entry(rows, l) = first + l * apart;
      const std::array<Lane, lane_count> of_point = columns_of(rows);
      for (int i = 0; i < lane_count; ++i)
        load(Row<SurfacePoint>(entry(face.point, block % 16 + i)), block / 16) +=
            entry(of_point, i);
      for (int l = 0; l < lane_count; ++l) Lane{}.store(first + l * apart);
    }
    for (const int p : face.point) entry(loaded, p) = 1;
  }
}

template <class Load, class Nodes>
void to_nodes(const Shape& shape, const Load& load, const std::vector<std::uint8_t>& loaded,
              const Nodes& node_force) {
  for (int node = 0; node < shape.surface_nodes; ++node)
    for (int k = 0; k < 3; ++k) node_force(Row<BoundaryNode>(node), k) = Lane{};
  for (int p = 0; p < shape.surface_points(); ++p) {
    if (entry(loaded, p) == 0) continue;
    const Row<SurfacePoint> row(p);
    const Lane x = load(row, 0), y = load(row, 1), z = load(row, 2);
    for (const Shape::PointTerm& term : shape.terms_of(p)) {
      const Lane weight(term.weight);
      node_force(term.node, 0) = fma(weight, x, node_force(term.node, 0));
      node_force(term.node, 1) = fma(weight, y, node_force(term.node, 1));
      node_force(term.node, 2) = fma(weight, z, node_force(term.node, 2));
    }
    for (int k = 0; k < 3; ++k) load(row, k) = Lane{};
  }
}

}  // namespace pulvis::space
