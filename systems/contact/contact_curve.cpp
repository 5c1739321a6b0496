// contact_curve: control points of the smooth outlines, y = S x, and their velocities.
//
// Source   systems/contact/contact_kernel.hpp (cubic B-spline of smoothed boundary nodes)
// Runs     after integrate; the contacts of the next step use its curves
// Active   when contact is possible
#include <array>

#include "components/contact.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "engine/lane_memory.hpp"
#include "systems/contact/systems.hpp"

namespace pulvis {
namespace {

struct ControlLanes {
  Lane x, y;
};

// Control point c of nodal quantities: positions, velocities. Any number of lists at once, since finding the
// nodes takes as long as adding them up.
template <class... Nodes>
std::array<ControlLanes, sizeof...(Nodes)> control_points(const Shape& shape, int c,
                                                          const Nodes&... nodes) {
  std::array<ControlLanes, sizeof...(Nodes)> y{};
  for (const Shape::CurveTerm& term : shape.terms_of(c)) {
    const Row<Node> node(term.node.value);  // boundary nodes come first in the node numbering
    std::size_t list = 0;
    ((y[list].x += term.weight * nodes(node, 0), y[list].y += term.weight * nodes(node, 1), ++list),
     ...);
  }
  return y;
}

// From lanes to the plain list, particle after particle.
template <class View>
void put(const View& list, int control_points, int c, const ControlLanes& y) {
  store_pairs(y.x, y.y, &list(Row<ControlPoint>(c), 0),
              2 * static_cast<std::size_t>(control_points));
}

}  // namespace

[[gnu::flatten]] void contact_curve::operator()(Chunk chunk) const {
  const Shape& shape = bodies->shape_of_chunk(chunk);
  const auto nodes = motion.position.chunk(chunk);
  const auto rates = motion.velocity.chunk(chunk);
  Lane fastest{};
  const int count = shape.control_points();
  for (int c = 0; c < count; ++c) {
    const auto [at, rate] = control_points(shape, c, nodes, rates);
    put(position.chunk(chunk), count, c, at);
    fastest = max(fastest, rate.x * rate.x + rate.y * rate.y);
    if (velocity) put(velocity->chunk(chunk), count, c, rate);
  }
  speed.chunk(chunk)(Row<Particle>()) = sqrt(fastest);
}

}  // namespace pulvis
