// Assembly of point forces: momentum, moment and virtual work, whatever edges the points stand against.
#include "systems/contact/assembly.hpp"

#include <gtest/gtest.h>

#include "systems/contact/contact_outlines.hpp"
#include "tests/helpers/random_values.hpp"
#include "tests/systems/contact/closed_curve.hpp"

namespace pulvis {
namespace {

constexpr int ring_edges = 12;

struct Sum {
  double x = 0, y = 0, moment = 0, size = 0;
  void add(double px, double py, double fx, double fy) {
    x += fx, y += fy;
    moment += px * fy - py * fx;
    size += std::abs(fx) + std::abs(fy);
  }
};

struct Edges {
  ClosedCurve curve = ClosedCurve::circle(1, ring_edges);
  std::vector<double> force = std::vector<double>(CurveForce::count * (ring_edges + 3));
  LoadedEdges loaded = LoadedEdges(ring_edges + 3);
  EdgeForces all() { return {force.data(), loaded}; }

  Sum sum() const {
    Sum s;
    for (int e = 0; e < ring_edges; ++e)
      for (int a = 0; a < 4; ++a) {
        const double* y = curve.control.data() + 2 * (e + a);
        const double* f = force.data() + CurveForce::count * e + 2 * a;
        s.add(y[0], y[1], f[0], f[1]);
      }
    return s;
  }
  Point at(const CurvePoint& p) const {
    return Curve(curve.control.data() + 2 * p.edge).value(p.u);
  }
  Point slope(const CurvePoint& p) const {
    return Curve(curve.control.data() + 2 * p.edge).slope(p.u);
  }
};

std::array<double, 8> random_forces(kernels::Random& random) {
  std::array<double, 8> f;
  for (double& v : f) v = random.in(-1, 1);
  return f;
}

TEST(Assembly, OfASampledEdgeKeepsForceAndMoment) {
  kernels::Random random(1);
  for (int edge = 0; edge < ring_edges; ++edge) {
    Edges body;
    const std::array<double, 8> f = random_forces(random);
    add_sampled(basis_by_point(), f.data(), body.all().on(edge));
    EXPECT_EQ(body.loaded[static_cast<std::size_t>(edge)], 1);
    Sum put;
    for (std::size_t g = 0; g < 4; ++g) {
      const Point p = body.at({edge, kernels::edge_u[g]});
      put.add(p[0], p[1], f[2 * g], f[2 * g + 1]);
    }
    const Sum got = body.sum();
    EXPECT_NEAR(got.x, put.x, 1e-15 * put.size);
    EXPECT_NEAR(got.y, put.y, 1e-15 * put.size);
    EXPECT_NEAR(got.moment, put.moment, 2e-15 * put.size);
  }
}

// The points of an edge may stand against one edge, two, or more: the shortcut for the first two, and the rest.
TEST(Assembly, OfTheOtherBodyIsTheOppositeOnWhateverEdges) {
  kernels::Random random(2);
  const std::array<std::array<int, 4>, 6> stands{
      {{3, 3, 3, 3}, {3, 3, 4, 4}, {4, 3, 4, 3}, {2, 3, 4, 5}, {5, 6, 5, 5}, {4, 4, 4, 5}}};
  for (const auto& edge : stands)
    for (const bool sliding : {false, true}) {
      Edges body;
      const std::array<double, 8> f = random_forces(random), couple = random_forces(random);
      std::array<PackedCurvePoint, 4> closest;
      Sum put;
      for (std::size_t g = 0; g < 4; ++g) {
        closest[g] = CurvePoint{edge[g], random.in(0, 1)}.packed();
        const Point p = body.at(closest[g].unpacked()), s = body.slope(closest[g].unpacked());
        put.add(p[0], p[1], -f[2 * g], -f[2 * g + 1]);
        // A couple acts on the slope: moment without a force.
        if (sliding) put.moment -= s[0] * couple[2 * g + 1] - s[1] * couple[2 * g];
      }
      add_other(edge_basis(), closest.data(), f.data(), sliding ? couple.data() : nullptr,
                body.all());
      const Sum got = body.sum();
      EXPECT_NEAR(got.x, put.x, 4e-15 * put.size);
      EXPECT_NEAR(got.y, put.y, 4e-15 * put.size);
      EXPECT_NEAR(got.moment, put.moment, 8e-15 * put.size);
      for (int e = 0; e < ring_edges; ++e)
        EXPECT_EQ(body.loaded[static_cast<std::size_t>(e)],
                  std::ranges::count(edge, e) > 0 ? 1 : 0);
    }
}

// y = S x, so that f_x = S^T f_y: both do the same work in any motion. Edges that bear nothing are left alone, the
// others cleared for the next step.
TEST(Assembly, ToNodesDoesTheWorkOfTheControlPoints) {
  ClosedCurve curve = ClosedCurve::circle(1, ring_edges);
  Shape& shape = curve.shape();
  shape.boundary_nodes = ring_edges;
  shape.curve_begin = {0};
  for (int c = 0; c < ring_edges + 3; ++c) {
    for (const int k : {-1, 0, 1})
      shape.curve_terms.push_back(
          {Row<BoundaryNode>((c + k + ring_edges) % ring_edges), k == 0 ? 7.0 / 6 : -1.0 / 12});
    shape.curve_begin.push_back(static_cast<std::int32_t>(shape.curve_terms.size()));
  }
  constexpr std::ptrdiff_t numbers = CurveForce::count * (ring_edges + 3);
  std::vector<double> force(numbers * lane_count);
  LoadedEdges loaded(ring_edges + 3);
  kernels::Random random(3);
  std::vector<Lane> moved(2 * ring_edges), nodes(2 * ring_edges);
  for (Lane& v : moved) v = random.lane(-1, 1);
  Lane work{};
  for (const int e : {0, 1, 5, ring_edges - 1}) {
    entry(loaded, e) = 1;
    for (int l = 0; l < lane_count; ++l)
      for (int a = 0; a < 4; ++a)
        for (int k = 0; k < 2; ++k) {
          const double f = random.in(-1, 1);
          entry(force, l * numbers + CurveForce::count * e + 2 * a + k) = f;
          for (const Shape::CurveTerm& term : shape.terms_of(e + a))
            work[l] += f * term.weight * entry(moved, 2 * term.node.value + k)[l];
        }
  }
  to_nodes(shape, force.data(), numbers, loaded, [&](Row<BoundaryNode> node, int k) -> Lane& {
    return entry(nodes, 2 * node.value + k);
  });
  Lane done{};
  for (std::size_t i = 0; i < nodes.size(); ++i) done += nodes[i] * moved[i];
  for (int l = 0; l < lane_count; ++l) EXPECT_NEAR(done[l], work[l], 1e-13);
  for (const double f : force) EXPECT_EQ(f, 0);
}

}  // namespace
}  // namespace pulvis
