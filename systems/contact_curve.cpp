// contact_curve: control points of the smooth outlines, y = S x, and how fast they move.
//
// Source   systems/contact_kernel.hpp (cubic B-spline of smoothed boundary nodes)
// Runs     after integrate; its curves are what the next step's contacts see
// Active   when anything can touch
#include "components/contact.hpp"
#include "engine/access.hpp"
#include "systems/systems.hpp"

namespace pulvis {
namespace {

struct ControlLanes {
  Lane x, y;
};

template <class Nodes>
ControlLanes control_point(const Shape& shape, const Nodes& nodes, int c) {
  ControlLanes y{};
  for (std::int32_t t = shape.curve_begin[static_cast<std::size_t>(c)];
       t < shape.curve_begin[static_cast<std::size_t>(c) + 1]; ++t) {
    const Shape::CurveTerm& term = shape.curve_terms[static_cast<std::size_t>(t)];
    const Row<Node> node(term.node.value);  // boundary nodes come first among the nodes
    y.x += term.weight * nodes(node, 0);
    y.y += term.weight * nodes(node, 1);
  }
  return y;
}

// From lanes to the plain list, particle after particle.
template <class View>
void put(const View& list, int control_points, int c, const ControlLanes& y) {
  for (int lane = 0; lane < lane_count; ++lane) {
    list(Row<ControlPoint>(lane * control_points + c), 0) = y.x[lane];
    list(Row<ControlPoint>(lane * control_points + c), 1) = y.y[lane];
  }
}

}  // namespace

[[gnu::flatten]] void contact_curve(Chunk chunk, Read<Bodies> bodies, Read<Position> x,
                                    Read<Velocity> v, Write<CurvePosition> position,
                                    Optional<Write<CurveVelocity>> velocity,
                                    Write<MaximumSpeed> speed) {
  const Shape& shape = bodies->shape_of_chunk(chunk);
  const auto nodes = x.chunk(chunk);
  const auto rates = v.chunk(chunk);
  Lane fastest{};
  for (int c = 0; c < shape.control_points(); ++c) {
    put(position.chunk(chunk), shape.control_points(), c, control_point(shape, nodes, c));
    const ControlLanes rate = control_point(shape, rates, c);
    fastest = max(fastest, rate.x * rate.x + rate.y * rate.y);
    if (velocity) put(velocity->chunk(chunk), shape.control_points(), c, rate);
  }
  speed.chunk(chunk)(Row<Particle>()) = sqrt(fastest);
}

}  // namespace pulvis
