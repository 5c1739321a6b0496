#include "scenes/lever/afm_size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/files/output_error.hpp"
#include "engine/machine_memory.hpp"
#include "engine/portable_math.hpp"
#include "scenes/lever/mesh/meshed_lever.hpp"
#include "scenes/lever/mesh/meshed_tip.hpp"
#include "scenes/lever/mesh/tip_mesh.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis {
namespace {

using TipShape = TipSpec::Shape;

constexpr double program_bytes = 64e6;
constexpr double factor_bytes = 12;  // a double and its row
constexpr double matrix_bytes = 44;  // as blocks, as a matrix, permuted, and kept for a checkpoint
constexpr double element_bytes = 7000;  // tangent, forces, geometry, data of the mesher

// Fill-in of a grid of a x b x c cells with three unknowns per node. A band as wide as the smallest cross-section
// is an upper bound; in a cube approximate minimum degree leaves half of that, in a plate 4 log2 of its nodes per
// layer. Measured for 16 grids of 729 to 400,000 nodes (tests/scenes/lever/memory_test.cpp has some of them):
// the estimate is 0.9 to 2.3 times the actual fill-in.
SolidSize grid_size(double a, double b, double c) {
  std::array<double, 3> n{a + 1, b + 1, c + 1};
  std::ranges::sort(n);
  const double nodes = n[0] * n[1] * n[2], section = n[0] * n[1];
  const double band = (n[2] > 1.5 * std::sqrt(section) ? 1.2 : 0.65) * section;
  const double plate = 4 * n[0] * portable::log(n[1] * n[2]) / std::numbers::ln2;
  const double blocks = n[0] > 2 ? 14 : 9;  // per node, of 27 or 18 the lower half
  return {a * b * c, nodes, 9 * nodes * blocks, 9 * nodes * std::min(band, plate)};
}

SolidSize sum(const SolidSize& a, const SolidSize& b) {
  return {a.elements + b.elements, a.nodes + b.nodes, a.matrix + b.matrix, a.factors + b.factors};
}

// A mesh of any shape: treated as a cube with the same number of cells.
SolidSize as_cube(double elements) {
  const double edge = portable::cbrt(elements);
  return grid_size(edge, edge, edge);
}

// Number of edges along the radius of the region where a ball may touch.
double contact_edges(const TipSpec& tip) {
  if (!tip.contact_edge) return tip.elements;
  return std::clamp(tip.contact_reach.value_or(8 * *tip.contact_edge) / *tip.contact_edge, 1.0,
                    24.0);
}

// Cells of the core and of its six shells, and those split into eight around the pole: as small as the
// contact edge h to n h from it, larger by half the distance outside (scenes/lever/mesh/ball_mesh.cpp), which
// is the integral of 2 pi r^2/size^3. Cells are halved until the longest edge is small enough, and their neighbours
// are split with them: six balls with n from 3 to 15 have 6.4 to 7.6 times as many cells.
double ball_cells(const TipSpec& tip) {
  constexpr double halves = 6.8;
  const double across = tip.elements, layers = std::max(1.0, across / 2);
  const double all = across * across * (across + 6 * layers);
  if (!tip.contact_edge) return all;
  const double n = contact_edges(tip);
  const double out = portable::log(std::max(1.0, tip.radius / (n * *tip.contact_edge)));
  return all + halves * 2 * std::numbers::pi * (n * n * n / 3 + n * n + 4 * n + 8 * out);
}

// Graded towards the pole, a ball has a third of the fill-in of a cube with as many cells (0.31 in hertz-ball.toml).
SolidSize ball_size(const TipSpec& tip) {
  SolidSize ball = as_cube(ball_cells(tip));
  if (tip.contact_edge) ball.factors /= 3;
  return ball;
}

double stacked(const TipSpec& tip, const FootPlan& foot) {
  return static_cast<double>(tip_levels(tip, foot.edge, 1).size()) - 1;
}

// Entries of the solid's responses to forces at every contact point: three fields each.
double answers_of(const AfmScene& afm, const SolidSize& solid) {
  if (afm.actions.empty()) return 0;
  const double edges = afm.tip.shape == TipShape::sphere ? contact_edges(afm.tip) : 1;
  return 9 * solid.nodes * std::numbers::pi * edges * edges;
}

}  // namespace

double SolidSize::bytes() const {
  return program_bytes + element_bytes * elements + matrix_bytes * matrix + factor_bytes * factors +
         sizeof(double) * answers;
}

SolidSize lever_size(const AfmScene& afm) {
  const LeverSpec& lever = afm.lever;
  if (lever.solid)
    return as_cube(static_cast<double>(lever.solid->solid.hexahedra.size() +
                                       lever.solid->solid.tetrahedra.size()));
  const std::optional<FootPlan> foot = foot_plan(lever, afm.tip);
  const PlanCount plan = plan_count(lever, foot);
  const SolidSize plates =
      grid_size(plan.along, plan.across, lever.layers + (lever.coating ? 1 : 0));
  if (plan.solid_along == 0) return plates;
  return sum(plates, grid_size(plan.solid_along, plan.solid_across,
                               foot_layers(lever, foot->edge) - lever.layers));
}

SolidSize tip_size(const AfmScene& afm) {
  const TipSpec& tip = afm.tip;
  const double n = tip.elements;
  switch (tip.shape) {
    case TipShape::none:
      return {};
    case TipShape::block:
    case TipShape::pyramid: {
      const FootPlan foot = *foot_plan(afm.lever, tip);
      const double across = foot.across();
      return grid_size(across, across, stacked(tip, foot));
    }
    case TipShape::cone:  // a disc is a square core in a ring with half as many layers: 3 n^2 quads
      return grid_size(std::sqrt(3.0) * n, std::sqrt(3.0) * n,
                       stacked(tip, *foot_plan(afm.lever, tip)));
    case TipShape::sphere:
      return ball_size(tip);
    case TipShape::mesh:
      return tip.solid ? as_cube(static_cast<double>(tip.solid->solid.hexahedra.size() +
                                                     tip.solid->solid.tetrahedra.size()))
                       : SolidSize{};
  }
  return {};
}

SolidSize afm_size(const AfmScene& afm) {
  SolidSize size = sum(lever_size(afm), tip_size(afm));
  size.answers = answers_of(afm, size);
  return size;
}

void require_afm_memory(const Scene& scene) {
  const auto need = static_cast<std::uint64_t>(afm_size(*scene.afm).bytes());
  const std::uint64_t there = available_memory();
  if (need > there)
    throw OutputError(scene.file, "run it",
                      fmt::format("it needs about {} of memory, but only {} are available",
                                  bytes_text(need), bytes_text(there)));
}

}  // namespace pulvis
