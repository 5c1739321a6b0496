// O-grid of a disc: a core of (boundary_edges/4)^2 quads, a rounded square of circumradius `core` R,
// inside rings that end on the outline. Rectangles: a plain grid.
#include "scenes/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "scenes/contact_curve.hpp"
#include "systems/hourglass_kernel.hpp"

namespace pulvis {
namespace {

using Quad = std::array<Row<Node>, 4>;

using std::numbers::pi;

Point turned(Point p, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * p[0] - s * p[1], s * p[0] + c * p[1]};
}
Point between(Point a, Point b, double share) {
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
}

// Where the nodes of one side of the core stand, as t in [-1, 1]: even, or finer by `refinement` in the
// middle (geometric).
std::vector<double> side_stations(int edges, double refinement) {
  std::vector<double> size(static_cast<std::size_t>(edges));
  for (int e = 0; e < edges; ++e) {
    const double from_middle = std::abs(2 * e + 1 - edges) / (edges > 1 ? edges - 1.0 : 1.0);
    size[static_cast<std::size_t>(e)] = std::pow(refinement, from_middle);
  }
  const double total = std::accumulate(size.begin(), size.end(), 0.0);
  std::vector<double> t{-1};
  for (const double s : size) t.push_back(t.back() + 2 * s / total);
  t.back() = 1;
  for (std::size_t i = 0; i < t.size() / 2; ++i) t[t.size() - 1 - i] = -t[i];  // exact symmetry
  if (edges % 2 == 0) t[t.size() / 2] = 0;
  return t;
}

struct DiscPlan {
  double radius;
  int side;  // edges of a side of the core
  int rings;
  double refinement;
  double core;   // circumradius of the core / radius
  double bulge;  // 0: straight sides, 1: a circle
  std::vector<double> poles,
      flanks;  // stations of the sides that face the poles, and of the others
};

const std::vector<double>& stations(const DiscPlan& plan, int side) {
  return side % 2 == 0 ? plan.poles : plan.flanks;
}

// Side 0 looks down, 1 right, 2 up, 3 left; each runs counter-clockwise.
Point core_side(const DiscPlan& plan, int side, double t) {
  const double phi = t * pi / 4;
  const Point arc{std::sin(phi), -std::cos(phi)};
  const Point straight{t * std::numbers::sqrt2 / 2, -std::numbers::sqrt2 / 2};
  const Point p = between(straight, arc, plan.bulge);
  return turned({plan.core * plan.radius * p[0], plan.core * plan.radius * p[1]}, side * pi / 2);
}

// Transfinite interpolation of the core's four sides; u, v in [0, 1].
Point core_point(const DiscPlan& plan, double tx, double ty) {
  const double u = 0.5 * (tx + 1), v = 0.5 * (ty + 1);
  const Point bottom = core_side(plan, 0, tx), right = core_side(plan, 1, ty);
  const Point top = core_side(plan, 2, -tx), left = core_side(plan, 3, -ty);
  const Point sw = core_side(plan, 0, -1), se = core_side(plan, 0, 1);
  const Point ne = core_side(plan, 2, -1), nw = core_side(plan, 2, 1);
  Point p;
  for (std::size_t k = 0; k < 2; ++k)
    p[k] = (1 - v) * bottom[k] + v * top[k] + (1 - u) * left[k] + u * right[k] -
           ((1 - u) * (1 - v) * sw[k] + u * (1 - v) * se[k] + u * v * ne[k] + (1 - u) * v * nw[k]);
  return p;
}

// Node numbers of the O-grid: ring 0 is the outline, ring `rings` the rim of the core, then its inside.
struct DiscNodes {
  int side, rings;
  int rim(int ring, int i) const { return ring * 4 * side + (i + 4 * side) % (4 * side); }
  int core(int column, int row) const {
    if (row == 0) return rim(rings, column);
    if (column == side) return rim(rings, side + row);
    if (row == side) return rim(rings, 3 * side - column);
    if (column == 0) return rim(rings, 4 * side - row);
    return (rings + 1) * 4 * side + (row - 1) * (side - 1) + column - 1;
  }
};

// Nodes on the outline stand outside the circle by so much that the polygon has the circle's area: an
// inscribed one lacks 0.4% at 40 edges, which is 5% of the force at 10% compression.
struct DiscOutlineNodes {
  std::vector<Point> nodes;
  Smoothing smoothing;  // of the contact curve, so that it is the circle
};

// With the angle theta to both neighbours, a curve with knots at the nodes passes at radius
// r ((4 + 2 cos theta)/6) (1 + 2 c (1 - cos theta) + 4 d (1 - cos theta)^2), which is to be the circle's.
// A graded outline takes theta as the mean of both sides; its fourth differences are large without being
// waves, so that there d = 0.
DiscOutlineNodes outline_nodes(const DiscPlan& plan) {
  const auto edges = static_cast<std::size_t>(4 * plan.side);
  std::vector<double> angle;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < plan.side; ++i)
      angle.push_back(-pi / 2 + side * pi / 2 +
                      stations(plan, side)[static_cast<std::size_t>(i)] * pi / 4);
  DiscOutlineNodes outline;
  outline.smoothing.d = plan.refinement > 1 ? 0 : short_wave_filter;
  for (std::size_t i = 0; i < edges; ++i) {
    const double after = i + 1 < edges ? angle[i + 1] : angle[0] + 2 * pi;
    const double before = i > 0 ? angle[i - 1] : angle[edges - 1] - 2 * pi;
    const double theta = 0.5 * (after - before);
    const double r = std::sqrt(theta / std::sin(theta));
    outline.nodes.push_back(
        {plan.radius * r * std::cos(angle[i]), plan.radius * r * std::sin(angle[i])});
    const double w = 1 - std::cos(theta);
    outline.smoothing.c.push_back(
        (6 / (r * (4 + 2 * std::cos(theta))) - 1 - 4 * outline.smoothing.d * w * w) / (2 * w));
  }
  return outline;
}

// Share of the way from the core to the outline at each ring, outline first; rings get thinner outwards
// by `refinement`.
std::vector<double> ring_shares(int rings, double refinement) {
  std::vector<double> share{1};
  double total = 0;
  std::vector<double> thickness;
  for (int r = 0; r < rings; ++r) {
    thickness.push_back(std::pow(refinement, rings > 1 ? r / (rings - 1.0) : 0));
    total += thickness.back();
  }
  for (const double t : thickness) share.push_back(share.back() - t / total);
  share.back() = 0;
  return share;
}

std::vector<Point> disc_nodes(const DiscPlan& plan) {
  const DiscNodes number{plan.side, plan.rings};
  const int n = plan.side;
  std::vector<Point> nodes(static_cast<std::size_t>((plan.rings + 1) * 4 * n + (n - 1) * (n - 1)));
  const std::vector<Point> outline = outline_nodes(plan).nodes;
  const std::vector<double> share = ring_shares(plan.rings, plan.refinement);
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < n; ++i) {
      const Point rim = core_side(plan, side, stations(plan, side)[static_cast<std::size_t>(i)]);
      const int at = side * n + i;
      for (int r = 0; r <= plan.rings; ++r)
        nodes[static_cast<std::size_t>(number.rim(r, at))] =
            between(rim, outline[static_cast<std::size_t>(at)], share[static_cast<std::size_t>(r)]);
    }
  for (int row = 1; row < n; ++row)
    for (int column = 1; column < n; ++column)
      nodes[static_cast<std::size_t>(number.core(column, row))] =
          core_point(plan, plan.poles[static_cast<std::size_t>(column)],
                     plan.flanks[static_cast<std::size_t>(row)]);
  return nodes;
}

Quad quad(int a, int b, int c, int d) {
  return {Row<Node>(a), Row<Node>(b), Row<Node>(c), Row<Node>(d)};
}

// Quads of the outermost ring first: element e lies behind boundary edge e.
std::vector<Quad> disc_quads(const DiscPlan& plan) {
  const DiscNodes number{plan.side, plan.rings};
  std::vector<Quad> quads;
  for (int r = 0; r < plan.rings; ++r)
    for (int i = 0; i < 4 * plan.side; ++i)
      quads.push_back(quad(number.rim(r, i), number.rim(r, i + 1), number.rim(r + 1, i + 1),
                           number.rim(r + 1, i)));
  for (int row = 0; row < plan.side; ++row)
    for (int column = 0; column < plan.side; ++column)
      quads.push_back(quad(number.core(column, row), number.core(column + 1, row),
                           number.core(column + 1, row + 1), number.core(column, row + 1)));
  return quads;
}

kernels::QuadMap<double> map_of(const std::vector<Point>& x, const Quad& q) {
  const auto at = [&](std::size_t k) { return x[static_cast<std::size_t>(q[k].value)]; };
  return kernels::quad_map(at(0)[0], at(0)[1], at(1)[0], at(1)[1], at(2)[0], at(2)[1], at(3)[0],
                           at(3)[1]);
}

// Highest squared frequency of the mesh up to a factor, as systems/time_step bounds it: elements by their
// half-width, those on the outline (the first `boundary` quads) with the contact springs on top; the 3
// stands for steel's nu and k = 2, which keeps the ring thick enough for the stiffest contact in use.
double frequency_bound(const std::vector<Point>& nodes, const std::vector<Quad>& quads,
                       std::size_t boundary) {
  double highest = 0;
  for (std::size_t e = 0; e < quads.size(); ++e) {
    const auto a = kernels::map_gradient(map_of(nodes, quads[e]), 0, 0);
    double bound = 1 / kernels::squared_half_width(a);
    if (e < boundary) {
      const Point& p = nodes[static_cast<std::size_t>(quads[e][0].value)];
      const Point& q = nodes[static_cast<std::size_t>(quads[e][1].value)];
      const double slope = std::hypot(q[0] - p[0], q[1] - p[1]) / (4 * determinant(a));
      bound += 3 * slope * slope;
    }
    highest = std::max(highest, bound);
  }
  return highest;
}

// The core is as large as gives the largest time step: its size trades the ring's thickness for the
// corner elements' width.
DiscPlan plan_disc(const DiscOutline& disc, const DiscMesh& mesh) {
  DiscPlan plan{0.5 * disc.diameter,
                mesh.boundary_edges / 4,
                mesh.rings,
                mesh.refinement,
                0.6,
                0.15,
                side_stations(mesh.boundary_edges / 4, mesh.refinement),
                side_stations(mesh.boundary_edges / 4, 1)};
  const std::vector<Quad> quads = disc_quads(plan);
  double best = 1e300, core = plan.core;
  for (int i = 0; i <= 40; ++i) {
    plan.core = 0.55 + 0.01 * i;
    const double bound =
        frequency_bound(disc_nodes(plan), quads, static_cast<std::size_t>(mesh.boundary_edges));
    if (bound < best) {
      best = bound;
      core = plan.core;
    }
  }
  plan.core = core;
  return plan;
}

void mesh_disc(const DiscOutline& disc, const DiscMesh& mesh, double phase, Shape& shape) {
  const DiscPlan plan = plan_disc(disc, mesh);
  for (const Point p : disc_nodes(plan)) shape.nodes.push_back(turned(p, phase));
  shape.quads = disc_quads(plan);
  shape.boundary_nodes = 4 * plan.side;
  close_curve(shape, outline_nodes(plan).smoothing);
}

// Nodes of the outline first, counter-clockwise from the lower left corner; then the inside by rows.
int grid_node(int columns, int rows, int column, int row) {
  if (row == 0) return column;
  if (column == columns) return columns + row;
  if (row == rows) return columns + rows + (columns - column);
  if (column == 0) return 2 * columns + rows + (rows - row);
  return 2 * (columns + rows) + (row - 1) * (columns - 1) + column - 1;
}

void mesh_rectangle(const RectangleOutline& outline, const RectangleMesh& mesh, Shape& shape) {
  shape.nodes.resize(static_cast<std::size_t>((mesh.columns + 1) * (mesh.rows + 1)));
  for (int row = 0; row <= mesh.rows; ++row)
    for (int column = 0; column <= mesh.columns; ++column)
      shape.nodes[static_cast<std::size_t>(grid_node(mesh.columns, mesh.rows, column, row))] = {
          outline.width * (double(column) / mesh.columns - 0.5),
          outline.height * (double(row) / mesh.rows - 0.5)};
  const auto node = [&](int c, int r) { return grid_node(mesh.columns, mesh.rows, c, r); };
  for (int row = 0; row < mesh.rows; ++row)
    for (int column = 0; column < mesh.columns; ++column)
      shape.quads.push_back(quad(node(column, row), node(column + 1, row),
                                 node(column + 1, row + 1), node(column, row + 1)));
  shape.boundary_nodes = 2 * (mesh.columns + mesh.rows);
  cornered_curve(shape, {0, mesh.columns, mesh.columns + mesh.rows, 2 * mesh.columns + mesh.rows});
}

// `weight`: how much of the square (xi, eta) the point stands for.
Shape::GaussPoint point_at(const kernels::QuadMap<double>& map, double xi, double eta,
                           double weight) {
  const auto a = kernels::map_gradient(map, xi, eta);
  const double det = determinant(a);
  return {{a.yy / det, -a.xy / det, -a.yx / det, a.xx / det}, weight * det};
}

Shape::Hourglass hourglass_of(const kernels::QuadMap<double>& m) {
  const auto w = kernels::natural_hourglass(m, 1 / determinant(kernels::map_gradient(m, 0.0, 0.0)));
  const double across = m.ax * m.bx + m.ay * m.by;
  return {{w.one, w.two},
          {across / (m.ax * m.ax + m.ay * m.ay), across / (m.bx * m.bx + m.by * m.by)}};
}

void set_gauss_points(Shape& shape) {
  shape.nodal_area.assign(shape.nodes.size(), 0);
  for (const Quad& q : shape.quads) {
    const auto map = map_of(shape.nodes, q);
    std::array<Shape::GaussPoint, 4> gauss;
    double area = 0;
    for (std::size_t g = 0; g < 4; ++g) {
      gauss[g] = point_at(map, kernels::gauss_xi[g], kernels::gauss_eta[g], 1);
      area += gauss[g].determinant;
    }
    shape.gauss.push_back(gauss);
    shape.centre.push_back({point_at(map, 0, 0, 4)});
    shape.hourglass.push_back(hourglass_of(map));
    for (const Row<Node> n : q) shape.nodal_area[static_cast<std::size_t>(n.value)] += area / 4;
  }
}

}  // namespace

Shape make_shape(const ParticleSpec& particle, double phase) {
  Shape shape;
  shape.name = particle.name;
  shape.area = outline_area(particle.outline);
  if (const auto* disc = std::get_if<DiscOutline>(&particle.outline))
    mesh_disc(*disc, std::get<DiscMesh>(particle.mesh), phase, shape);
  else
    mesh_rectangle(std::get<RectangleOutline>(particle.outline),
                   std::get<RectangleMesh>(particle.mesh), shape);
  set_gauss_points(shape);
  measure_edges(shape);
  return shape;
}

double outline_area(const Outline& outline) {
  if (const auto* disc = std::get_if<DiscOutline>(&outline))
    return pi / 4 * disc->diameter * disc->diameter;
  const auto& r = std::get<RectangleOutline>(outline);
  return r.width * r.height;
}

double outline_radius(const Outline& outline) {
  if (const auto* disc = std::get_if<DiscOutline>(&outline)) return 0.5 * disc->diameter;
  const auto& r = std::get<RectangleOutline>(outline);
  return 0.5 * std::hypot(r.width, r.height);
}

double least_corner_sine(const Shape& shape) {
  double least = 1;
  for (const Quad& q : shape.quads)
    for (std::size_t k = 0; k < 4; ++k) {
      const Point& p = shape.nodes[static_cast<std::size_t>(q[k].value)];
      const Point& a = shape.nodes[static_cast<std::size_t>(q[(k + 1) % 4].value)];
      const Point& b = shape.nodes[static_cast<std::size_t>(q[(k + 3) % 4].value)];
      const double ax = a[0] - p[0], ay = a[1] - p[1], bx = b[0] - p[0], by = b[1] - p[1];
      least = std::min(least, (ax * by - ay * bx) / (std::hypot(ax, ay) * std::hypot(bx, by)));
    }
  return least;
}

}  // namespace pulvis
