// Common to all outlines: Gauss points, nodal areas, edges. The meshers are in scenes/meshes/mesh_<outline>.cpp.
#include "scenes/meshes/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/portable_math.hpp"
#include "scenes/meshes/inerter_chains.hpp"
#include "scenes/meshes/contact_curve.hpp"
#include "scenes/meshes/mass_shares.hpp"
#include "scenes/meshes/mesh_outlines.hpp"
#include "scenes/outlines/outline.hpp"
#include "systems/body/hourglass_kernel.hpp"

namespace pulvis {
namespace {

// `weight`: share of the square (xi, eta) that the point represents.
Shape::GaussPoint point_at(const kernels::QuadMap<double>& map, double xi, double eta,
                           double weight) {
  const auto a = kernels::map_gradient(map, xi, eta);
  const double det = determinant(a);
  return {{a.yy / det, -a.xy / det, -a.yx / det, a.xx / det}, weight * det};
}

Shape::GaussPoint fourfold(Shape::GaussPoint point) {
  for (double& entry : point.inverse_jacobian) entry *= 0.25;
  return point;
}

Shape::Hourglass hourglass_of(const kernels::QuadMap<double>& m) {
  const auto w = kernels::natural_hourglass(m, 1 / determinant(kernels::map_gradient(m, 0.0, 0.0)));
  const double across = m.ax * m.bx + m.ay * m.by;
  auto over = kernels::corner_determinants(w);
  for (double& corner : over) corner = 1 / corner;
  return {{w.one, w.two},
          {across / (m.ax * m.ax + m.ay * m.ay), across / (m.bx * m.bx + m.by * m.by)},
          over};
}

void set_gauss_points(Shape& shape) {
  shape.nodal_area.assign(shape.nodes.size(), 0);
  for (const auto& q : shape.quads) {
    const auto at = [&](std::size_t n) {
      return shape.nodes[static_cast<std::size_t>(q[n].value)];
    };
    const auto map = kernels::quad_map(at(0)[0], at(0)[1], at(1)[0], at(1)[1], at(2)[0], at(2)[1],
                                       at(3)[0], at(3)[1]);
    std::array<Shape::GaussPoint, 4> gauss;
    double area = 0;
    for (std::size_t g = 0; g < 4; ++g) {
      gauss[g] = point_at(map, kernels::gauss_xi[g], kernels::gauss_eta[g], 1);
      area += gauss[g].determinant;
    }
    shape.gauss.push_back(gauss);
    shape.centre.push_back({fourfold(point_at(map, 0, 0, 4))});
    shape.hourglass.push_back(hourglass_of(map));
    for (const Row<Node> n : q) shape.nodal_area[static_cast<std::size_t>(n.value)] += area / 4;
  }
}

}  // namespace

Shape make_shape(const ParticleSpec& particle, double phase) {
  Shape shape;
  shape.name = particle.name;
  std::visit(
      [&](const auto& outline) {
        using Mesh = typename std::decay_t<decltype(outline)>::Mesh;
        const Mesh& mesh = std::get<Mesh>(particle.mesh);
        if constexpr (requires { curve_of(outline); }) {
          const OutlineCurve curve = curve_of(outline);
          shape.area = area_with(curve, particle.outline);
          mesh_outline(outline, curve, mesh, shape);
        } else {
          shape.area = outline_area(particle.outline);
          mesh_outline(outline, mesh, phase, shape);
        }
      },
      particle.outline);
  set_gauss_points(shape);
  measure_edges(shape);
  share_mass(shape);
  shape.chains = inerter_chains(shape);
  return shape;
}

double min_corner_sine(const Shape& shape) {
  double minimum = 1;
  for (const auto& q : shape.quads)
    for (std::size_t k = 0; k < 4; ++k) {
      const Point& p = shape.nodes[static_cast<std::size_t>(q[k].value)];
      const Point& a = shape.nodes[static_cast<std::size_t>(q[(k + 1) % 4].value)];
      const Point& b = shape.nodes[static_cast<std::size_t>(q[(k + 3) % 4].value)];
      const double ax = a[0] - p[0], ay = a[1] - p[1], bx = b[0] - p[0], by = b[1] - p[1];
      minimum = std::min(minimum,
                         (ax * by - ay * bx) / (portable::hypot(ax, ay) * portable::hypot(bx, by)));
    }
  return minimum;
}

double shortest_edge(const Shape& shape) {
  double minimum = std::numeric_limits<double>::max();
  for (const auto& q : shape.quads)
    for (std::size_t k = 0; k < 4; ++k) {
      const Point& p = shape.nodes[static_cast<std::size_t>(q[k].value)];
      const Point& r = shape.nodes[static_cast<std::size_t>(q[(k + 1) % 4].value)];
      minimum = std::min(minimum, portable::hypot(r[0] - p[0], r[1] - p[1]));
    }
  return minimum;
}

}  // namespace pulvis
