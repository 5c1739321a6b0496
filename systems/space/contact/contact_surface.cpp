// contact_surface: Bezier points of the smooth surfaces, linear in the nodes, and how fast they move.
//
// Source   scenes/space/meshes makes the terms
// Runs     after integrate; its surfaces are what the next step's contacts see
// Active   when anything can touch
#include <array>

#include "engine/lane_memory.hpp"
#include "systems/space/contact/systems.hpp"

namespace pulvis::space {
namespace {

template <class From, class To>
void combine(const Shape::Terms& terms, const From& from, const To& to) {
  const int count = terms.points();
  for (int p = 0; p < count; ++p) {
    Lane x{}, y{}, z{};
    for (const Shape::Term& term : terms.of(p)) {
      const Lane weight(term.weight);
      x = fma(weight, from(term.row, 0), x);
      y = fma(weight, from(term.row, 1), y);
      z = fma(weight, from(term.row, 2), z);
    }
    to(p, 0) = x;
    to(p, 1) = y;
    to(p, 2) = z;
  }
}

// All Bezier points of what the nodes carry. Those of the surface come first among the nodes.
template <class Nodes, class Net, class Points>
void set_points(const Shape& shape, const Nodes& nodes, const Net& net, const Points& points) {
  combine(
      shape.net, [&](auto row, int k) -> const Lane& { return nodes(Row<Node>(row.value), k); },
      [&](int p, int k) -> Lane& { return net(Row<BoundaryNode>(p), k); });
  combine(shape.points, net,
          [&](int p, int k) -> Lane& { return points(Row<SurfacePoint>(p), k); });
}

// From lanes to the plain list of faces, particle after particle.
template <class Points, class Faces>
void set_faces(const Shape& shape, const Points& points, const Faces& faces) {
  const auto count = static_cast<std::ptrdiff_t>(shape.faces.size());
  double* first = &faces(Row<SurfaceFace>(0));
  for (std::ptrdiff_t f = 0; f < count; ++f) {
    const Shape::Face& face = entry(shape.faces, f);
    for (int k = 0; k < 3; ++k)
      for (int half = 0; half < 2; ++half) {
        std::array<const double*, lane_count> rows;
        for (int i = 0; i < lane_count; ++i)
          entry(rows, i) = reinterpret_cast<const double*>(
              &points(Row<SurfacePoint>(entry(face.point, lane_count * half + i)), k));
        const std::array<Lane, lane_count> of_particle = columns_of(rows);
        for (int l = 0; l < lane_count; ++l)
          entry(of_particle, l)
              .store(first + (l * count + f) * face_numbers + 16 * k + lane_count * half);
      }
  }
}

template <class Points>
Lane fastest(const Shape& shape, const Points& velocity) {
  Lane maximum{};
  for (int p = 0; p < shape.surface_points(); ++p) {
    const Row<SurfacePoint> row(p);
    const Lane x = velocity(row, 0), y = velocity(row, 1), z = velocity(row, 2);
    maximum = max(maximum, fma(x, x, fma(y, y, z * z)));
  }
  return sqrt(maximum);
}

}  // namespace

[[gnu::flatten]] void contact_surface::operator()(Chunk chunk) const {
  const Shape& shape = bodies.shape_of(chunk);
  const auto scratch = points.chunk(chunk);
  const auto of_net = net.chunk(chunk);
  set_points(shape, motion.velocity.chunk(chunk), of_net, scratch);
  speed.chunk(chunk)(Row<Particle>()) = fastest(shape, scratch);
  if (velocity) set_faces(shape, scratch, velocity->chunk(chunk));
  set_points(shape, motion.position.chunk(chunk), of_net, scratch);
  set_faces(shape, scratch, position.chunk(chunk));
}

}  // namespace pulvis::space
