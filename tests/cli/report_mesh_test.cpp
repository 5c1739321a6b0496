// Particles that the report draws as fans keep their outline, their area and the means of their values.
#include "cli/report/report_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace pulvis {
namespace {

constexpr std::int32_t around = 48, rings = 4;

// Discs of radius 1 beside each other: rings of quads around a hole of a fifth of the radius.
PlaneMesh discs(std::int32_t count) {
  PlaneMesh mesh;
  for (std::int32_t disc = 0; disc < count; ++disc) {
    const std::int32_t first = disc * (rings + 1) * around;
    for (std::int32_t ring = 0; ring <= rings; ++ring)
      for (std::int32_t i = 0; i < around; ++i) {
        const double angle = 2 * std::numbers::pi * i / around, r = 0.2 + 0.8 * ring / rings;
        mesh.reference.insert(mesh.reference.end(),
                              {2.5 * disc + r * std::cos(angle), r * std::sin(angle)});
        mesh.node_particle.push_back(disc);
        if (ring == rings) continue;
        const std::int32_t a = first + ring * around + i,
                           b = first + ring * around + (i + 1) % around;
        mesh.quads.insert(mesh.quads.end(), {a, a + around, b + around, b});
        mesh.cell_particle.push_back(disc);
      }
  }
  return mesh;
}

double area(const std::vector<std::int32_t>& cells, const std::vector<double>& xy) {
  double twice = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto a = 2 * static_cast<std::size_t>(cells[i]);
    const auto b = 2 * static_cast<std::size_t>(cells[i % 4 == 3 ? i - 3 : i + 1]);
    twice += xy[a] * xy[b + 1] - xy[b] * xy[a + 1];
  }
  return twice / 2;
}

TEST(ReportMesh, WholeMeshIsDrawnAsItIs) {
  const PlaneMesh mesh = discs(2);
  const DrawnMesh drawn = DrawnMesh::whole(mesh);
  EXPECT_EQ(drawn.cells(), mesh.quads);
  EXPECT_EQ(drawn.positions(mesh.reference), mesh.reference);
}

TEST(ReportMesh, AFanIsTheRegularPolygonInTheOutline) {
  const PlaneMesh mesh = discs(3);
  const DrawnMesh drawn = DrawnMesh::fans(mesh, 12);
  EXPECT_EQ(drawn.cell_count(), 36U);
  EXPECT_EQ(drawn.node_count(), 39U);
  const auto xy = drawn.positions(mesh.reference);
  EXPECT_NEAR(area(drawn.cells(), xy), 3 * 6 * std::sin(std::numbers::pi / 6), 1e-12);
  EXPECT_NEAR(xy[2 * 13], 2.5, 1e-12);  // centre of the second
  const double stretched = 1.7;
  auto moved = mesh.reference;
  for (std::size_t i = 0; i < moved.size(); i += 2) moved[i] *= stretched;
  EXPECT_NEAR(area(drawn.cells(), drawn.positions(moved)), stretched * area(drawn.cells(), xy),
              1e-12);
}

// Sectors are of one area here: their plain mean is that of the cells, weighted with their areas.
TEST(ReportMesh, AFanKeepsTheMeanOfItsCells) {
  const PlaneMesh mesh = discs(1);
  const DrawnMesh drawn = DrawnMesh::fans(mesh, 12);
  std::vector<double> values;
  double sum = 0, whole = 0;
  for (std::int32_t ring = 0; ring < rings; ++ring)
    for (std::int32_t i = 0; i < around; ++i) {
      const double inner = 0.2 + 0.8 * ring / rings, outer = inner + 0.8 / rings;
      values.push_back(3.0 + ring + std::cos(2 * std::numbers::pi * (i + 0.5) / around));
      sum += (outer * outer - inner * inner) * values.back();
      whole += outer * outer - inner * inner;
    }
  const auto means = drawn.values(values);
  EXPECT_NEAR(std::accumulate(means.begin(), means.end(), 0.0) / 12, sum / whole, 1e-12);
  EXPECT_GT(means[0], means[6]);  // the side where the cosine is 1
}

}  // namespace
}  // namespace pulvis
