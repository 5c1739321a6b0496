// Assembly: from the forces on contact points to those on Bezier points, and from there to surface nodes.
//
// Law      Bezier point p of the sampled face receives N_p(u_g, v_g) f_g; the load on the other body is in
//          other_loads.hpp; the net gets the transpose of points = terms * net, the nodes that of net = terms * nodes
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "components/space/contact.hpp"
#include "engine/lane_memory.hpp"
#include "systems/space/contact/face_load.hpp"
#include "systems/space/contact/gauss_points.hpp"

namespace pulvis::space {

// Basis functions at the Gauss points: [Gauss point][Bezier point].
inline constexpr auto basis_by_point = [] {
  std::array<std::array<double, 16>, face_points> n{};
  for (std::size_t g = 0; g < face_points; ++g)
    for (std::size_t p = 0; p < 16; ++p) n[g][p] = basis_at_points[g / 8][p][g % 8];
  return n;
}();

// The faces that carry a force on any particle of the chunk. All others are skipped: their forces are zero, since
// to_nodes clears what it has read and nothing else writes them.
using LoadedFaces = std::vector<std::uint8_t>;

// The forces on the faces of one particle.
struct FaceForces {
  double* first;  // of its first face
  LoadedFaces& loaded_faces;

  double* on(int face) const {
    entry(loaded_faces, face) = 1;
    return first + static_cast<std::ptrdiff_t>(face) * face_numbers;
  }
};

[[gnu::always_inline]] inline OfPatch share_of_point(int g) {
  const double* n = entry(basis_by_point, g).data();
  return {Lane::load(n), Lane::load(n + lane_count)};
}

// Bit g: point g touches, and so is never inactive.
inline unsigned touching_points(const float* activation) { return at_most(activation, 0); }

// visit(row, Gauss point, force in N on it) for the touching points of a pair, in the order of their forces. `pairs`: of
// contact_force.
template <class Pairs, class Visit>
void for_touching_points(const Pairs& pairs, int pair, const Visit& visit) {
  const std::array<double, 3>* force = entry(pairs.loads->pairs, pair).own.data();
  for (const Row<FaceContact> row : RowRange<FaceContact>::of(pairs.of->begin, pair)) {
    if (pairs.touches(row) == 0) continue;
    for (unsigned left = touching_points(&pairs.activation(row)); left != 0; left &= left - 1)
      visit(row, std::countr_zero(left), *force++);
  }
}

// Adds the forces of the touching points, stored consecutively from `force` on, to the sampled face: usually a few.
inline void add_touching(const std::array<double, 3>* force, unsigned touching, double* face) {
  FaceLoad load;
  load.fetch(face);
  for (unsigned left = touching; left != 0; left &= left - 1)
    load.add(share_of_point(std::countr_zero(left)), *force++);
  load.store(face);
}

// Adds the forces of sixteen points (all x, y, z) to the face that they sample.
inline void add_sampled(const double* force, double* face) {
  FaceLoad load;
  load.fetch(face);
  for (int g = 0; g < face_points; ++g)
    load.add(share_of_point(g), {force[g], force[face_points + g], force[2 * face_points + g]});
  load.store(face);
}

// Adds the load of a pair to a face of its other particle.
inline void add_load(const PairLoads::Load& load, double* face) {
  for (int i = 0; i < face_numbers; i += lane_count)
    (Lane::load(face + i) + Lane::load(load.force.data() + i)).store(face + i);
}

// From the faces of eight particles, `apart` numbers per particle, to the shared Bezier points; marks these.
template <class Load>
void to_points(const Shape& shape, double* face_force, std::ptrdiff_t apart,
               const LoadedFaces& loaded_faces, const Load& load,
               std::vector<std::uint8_t>& loaded) {
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    if (loaded_faces[f] == 0) continue;
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

// The transpose of `terms`: distributes a load to the entries of its terms.
template <class To>
void spread(std::span<const Shape::Term> terms, Lane x, Lane y, Lane z, const To& to) {
  for (const Shape::Term& term : terms) {
    const Lane weight(term.weight);
    to(term.row, 0) = fma(weight, x, to(term.row, 0));
    to(term.row, 1) = fma(weight, y, to(term.row, 1));
    to(term.row, 2) = fma(weight, z, to(term.row, 2));
  }
}

template <class Load, class Net, class Nodes>
void to_nodes(const Shape& shape, const Load& load, const std::vector<std::uint8_t>& loaded,
              const Net& net, const Nodes& node_force) {
  for (int i = 0; i < shape.boundary_nodes; ++i)
    for (int k = 0; k < 3; ++k)
      net(Row<BoundaryNode>(i), k) = node_force(Row<BoundaryNode>(i), k) = Lane{};
  for (int p = 0; p < shape.surface_points(); ++p) {
    if (entry(loaded, p) == 0) continue;
    const Row<SurfacePoint> row(p);
    spread(shape.points.of(p), load(row, 0), load(row, 1), load(row, 2), net);
    for (int k = 0; k < 3; ++k) load(row, k) = Lane{};
  }
  for (int i = 0; i < shape.boundary_nodes; ++i) {
    const Row<BoundaryNode> row(i);
    spread(shape.net.of(i), net(row, 0), net(row, 1), net(row, 2), node_force);
  }
}

}  // namespace pulvis::space
