#include "scenes/meshes/hexahedra/surface_net.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace pulvis::space {
namespace {

// Corners of an element's six sides, counter-clockwise as seen from outside.
constexpr int sides_of_hexahedron[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                           {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

void collect_quads(const Shape& shape, SurfaceNet& net) {
  for (int e = 0; e < shape.elements(); ++e)
    for (const auto& side : sides_of_hexahedron) {
      std::array<int, 4> quad{};
      for (int c = 0; c < 4; ++c)
        entry(quad, c) = entry(entry(shape.hexahedra, e), entry(side, c)).value;
      if (*std::ranges::max_element(quad) >= shape.boundary_nodes) continue;
      net.quads.push_back(quad);
      net.element.push_back(e);
    }
}

void find_neighbours(SurfaceNet& net) {
  std::map<std::pair<int, int>, Shape::Neighbour> sides;  // by the nodes that it runs from and to
  for (int f = 0; f < net.faces(); ++f)
    for (int s = 0; s < 4; ++s)
      if (!sides.insert({{net.node({f, s}), net.node({f, s}, 1)}, {f, s}}).second)
        throw std::logic_error("a side of two faces that are turned against each other");
  net.neighbour.resize(net.quads.size());
  for (int f = 0; f < net.faces(); ++f)
    for (int s = 0; s < 4; ++s)
      entry(entry(net.neighbour, f), s) = sides.at({net.node({f, s}, 1), net.node({f, s})});
}

void find_fans(SurfaceNet& net, int nodes) {
  net.fan.resize(static_cast<std::size_t>(nodes));
  for (int f = 0; f < net.faces(); ++f)
    for (int k = 0; k < 4; ++k) {
      std::vector<SurfaceNet::Corner>& fan = entry(net.fan, net.node({f, k}));
      if (!fan.empty()) continue;
      SurfaceNet::Corner at{f, k};
      do {
        fan.push_back(at);
        at = net.beyond({at.face, (at.corner + 3) % 4});
      } while (at.face != f);
    }
}

}  // namespace

SurfaceNet surface_net(const Shape& shape) {
  SurfaceNet net;
  collect_quads(shape, net);
  find_neighbours(net);
  find_fans(net, shape.boundary_nodes);
  return net;
}

}  // namespace pulvis::space
