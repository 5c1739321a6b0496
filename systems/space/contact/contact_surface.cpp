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

using VectorLanes = kernels::Vector<Lane>;

// Of any number of fields at once, since reading the terms takes as long as adding them up.
template <class... Fields>
std::array<VectorLanes, sizeof...(Fields)> combined(std::span<const Shape::Term> terms,
                                                    const Fields&... fields) {
  std::array<VectorLanes, sizeof...(Fields)> sum{};
  for (const Shape::Term& term : terms) {
    const Lane weight(term.weight);
    std::size_t i = 0;
    ((sum[i] = {fma(weight, fields(term.row, 0), sum[i].x),
                fma(weight, fields(term.row, 1), sum[i].y),
                fma(weight, fields(term.row, 2), sum[i].z)},
      ++i),
     ...);
  }
  return sum;
}

template <class View>
void store(const VectorLanes& x, Row<BoundaryNode> row, const View& to) {
  to(row, 0) = x.x;
  to(row, 1) = x.y;
  to(row, 2) = x.z;
}

template <class View>
void store(const VectorLanes& mean, const Lane& difference, const View& motion) {
  for (int l = 0; l < lane_count; ++l) {
    const Row<WholeSurface> row(l);
    motion(row, SurfaceMotion::mean) = mean.x[l];
    motion(row, SurfaceMotion::mean + 1) = mean.y[l];
    motion(row, SurfaceMotion::mean + 2) = mean.z[l];
    motion(row, SurfaceMotion::difference) = difference[l];
  }
}

// Eight points of eight particles. From there to the plain list, particle by particle.
struct EightPoints {
  alignas(64) std::array<std::array<Lane, 3>, lane_count> x;

  void set(int i, const VectorLanes& of) { entry(x, i) = {of.x, of.y, of.z}; }
  // `first`: of the first particle; `numbers` of a particle.
  void put(double* first, std::ptrdiff_t numbers) const {
    const double* lanes = reinterpret_cast<const double*>(x.data());
    for (int k = 0; k < 3; ++k, lanes += lane_count * lane_count) {
      std::array<const double*, lane_count> rows;
      for (int i = 0; i < lane_count; ++i) entry(rows, i) = lanes + lane_count * i;
      const std::array<Lane, lane_count> of_particle = columns_of(rows);
      for (int l = 0; l < lane_count; ++l)
        entry(of_particle, l).store(first + l * numbers + lane_count * k);
    }
  }
};

// See Roughness. `at`: of its point.
template <class Nodes>
Lane roughness_at(const Shape& shape, int number, const Nodes& nodes, const VectorLanes& at) {
  const double slack = entry(shape.surface_node, number).slack;
  const Row<Node> n(number);
  const VectorLanes away = VectorLanes{nodes(n, 0), nodes(n, 1), nodes(n, 2)} - at;
  return dot(away, away) - slack * slack;
}

}  // namespace

// Points are in eights (Shape::complete_points).
[[gnu::flatten]] void contact_surface::operator()(Chunk chunk) const {
  const Shape& shape = bodies.shape_of(chunk);
  const auto x = motion.position.chunk(chunk);
  const auto v = motion.velocity.chunk(chunk);
  const auto net = nets.position.chunk(chunk);
  const auto net_rate = nets.velocity.chunk(chunk);
  // Surface nodes come first.
  const auto at_node = [](const auto& of) {
    return [&of](auto row, int k) -> const Lane& { return of(Row<Node>(row.value), k); };
  };
  VectorLanes mean{Lane{}, Lane{}, Lane{}};
  for (int i = 0; i < shape.boundary_nodes; ++i) {
    const auto [at, rate] = combined(shape.net.of(i), at_node(x), at_node(v));
    store(at, Row<BoundaryNode>(i), net);
    store(rate, Row<BoundaryNode>(i), net_rate);
    mean = mean + rate;
  }
  mean = Lane(1.0 / shape.boundary_nodes) * mean;
  const std::ptrdiff_t numbers = 3 * std::ptrdiff_t{shape.surface_points()};
  double* positions = &position.chunk(chunk)(Row<ParticleSurface>(0));
  double* rates = velocity ? &velocity->chunk(chunk)(Row<ParticleSurface>(0)) : nullptr;
  Lane fastest{}, difference{}, roughest = -1e300;
  EightPoints points, their_rates;
  for (int first = 0; first < shape.surface_points(); first += lane_count) {
    for (int i = 0; i < lane_count; ++i) {
      const auto [at, rate] = combined(shape.points.of(first + i), net, net_rate);
      points.set(i, at);
      their_rates.set(i, rate);
      fastest = max(fastest, dot(rate, rate));
      const VectorLanes relative = rate - mean;
      difference = max(difference, dot(relative, relative));
      if (const int node = entry(shape.node_at, first + i); node >= 0)
        roughest = max(roughest, roughness_at(shape, node, x, at));
    }
    points.put(positions + 3 * std::ptrdiff_t{first}, numbers);
    if (rates != nullptr) their_rates.put(rates + 3 * std::ptrdiff_t{first}, numbers);
  }
  speed.chunk(chunk)(Row<Particle>()) = sqrt(fastest);
  store(mean, sqrt(difference), surface_motion.chunk(chunk));
  roughness.chunk(chunk)(Row<Particle>()) = roughest;
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
