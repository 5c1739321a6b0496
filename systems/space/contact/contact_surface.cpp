// contact_surface: Bezier points of the smooth surfaces, linear in the nodes, and their velocities.
// node_spring_energy: energy of the springs that keep the nodes near them (node_springs.hpp).
// node_distance: how far nodes are from them. Contact does not feel the nodes: they may be beyond what the surface touches.
//
// Source   the terms are computed in scenes/meshes/hexahedra
// Runs     after integrate; the contacts of the next step use its surfaces
// Active   if there is contact
#include <array>

#include "engine/lane_memory.hpp"
#include "systems/space/contact/node_springs.hpp"
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

// Evaluates a nodal field at all Bezier points. Surface nodes come first.
template <class Nodes, class Net, class Points>
void set_points(const Shape& shape, const Nodes& nodes, const Net& net, const Points& points) {
  combine(
      shape.net, [&](auto row, int k) -> const Lane& { return nodes(Row<Node>(row.value), k); },
      [&](int p, int k) -> Lane& { return net(Row<BoundaryNode>(p), k); });
  combine(shape.points, net,
          [&](int p, int k) -> Lane& { return points(Row<SurfacePoint>(p), k); });
}

// From lanes to the plain list, particle by particle. Points are in eights (Shape::complete_points).
template <class Points, class Surface>
void set_surfaces(const Shape& shape, const Points& points, const Surface& surface) {
  const std::ptrdiff_t numbers = 3 * std::ptrdiff_t{shape.surface_points()};
  const double* lanes = reinterpret_cast<const double*>(&points(Row<SurfacePoint>(0), 0));
  double* first = &surface(Row<ParticleSurface>(0));
  for (std::ptrdiff_t n = 0; n < numbers; n += lane_count, lanes += lane_count * lane_count) {
    std::array<const double*, lane_count> rows;
    for (int i = 0; i < lane_count; ++i) entry(rows, i) = lanes + lane_count * i;
    const std::array<Lane, lane_count> of_particle = columns_of(rows);
    for (int l = 0; l < lane_count; ++l) entry(of_particle, l).store(first + l * numbers + n);
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

// See Roughness.
template <class Nodes, class Points>
Lane roughest(const Shape& shape, const Nodes& nodes, const Points& points) {
  Lane maximum = -1e300;
  for (int i = 0; i < static_cast<int>(shape.surface_node.size()); ++i) {
    const Shape::SurfaceNode& node = entry(shape.surface_node, i);
    const Row<Node> at(i);
    const Row<SurfacePoint> point(node.point);
    const Lane x = nodes(at, 0) - points(point, 0), y = nodes(at, 1) - points(point, 1),
               z = nodes(at, 2) - points(point, 2);
    maximum = max(maximum, fma(x, x, fma(y, y, z * z)) - node.slack * node.slack);
  }
  return maximum;
}

}  // namespace

[[gnu::flatten]] void contact_surface::operator()(Chunk chunk) const {
  const Shape& shape = bodies.shape_of(chunk);
  const auto scratch = points.chunk(chunk);
  const auto of_net = net.chunk(chunk);
  set_points(shape, motion.velocity.chunk(chunk), of_net, scratch);
  speed.chunk(chunk)(Row<Particle>()) = fastest(shape, scratch);
  if (velocity) set_surfaces(shape, scratch, velocity->chunk(chunk));
  set_points(shape, motion.position.chunk(chunk), of_net, scratch);
  set_surfaces(shape, scratch, position.chunk(chunk));
  roughness.chunk(chunk)(Row<Particle>()) = roughest(shape, motion.position.chunk(chunk), scratch);
}

void node_spring_energy::operator()(Chunk chunk) const {
  if (!nodes.any_rough(chunk)) return;
  const Shape& shape = bodies.shape_of(chunk);
  const Lane bulk = nodes.bulk.chunk(chunk)(Row<Particle>());
  Lane sum{};
  for (int i = 0; i < static_cast<int>(shape.surface_node.size()); ++i) {
    const Shape::SurfaceNode& node = entry(shape.surface_node, i);
    sum += node_spring(node, away_from_surface(bodies, nodes, chunk, i), bulk).energy;
  }
  energy.chunk(chunk)(Row<Particle>()) += sum;
}

void node_distance::operator()(Chunk chunk) const {
  const Shape& shape = bodies.shape_of(chunk);
  Lane largest{};
  for (int i = 0; i < static_cast<int>(shape.surface_node.size()); ++i) {
    const kernels::Vector<Lane> away = away_from_surface(bodies, nodes, chunk, i);
    const double size = entry(shape.surface_node, i).size;
    largest = max(largest, dot(away, away) / (size * size));
  }
  distance.chunk(chunk)(Row<Particle>()) = sqrt(largest);
}

}  // namespace pulvis::space
