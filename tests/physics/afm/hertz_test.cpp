// An elastic ball, meshed finely where it touches, on a rigid plane: Hertz's force, radius and pressure.
#include <cmath>
#include <numbers>
#include <set>

#include "engine/workers.hpp"
#include "scenes/lever/mesh/ball_mesh.hpp"
#include "systems/lever/solid_equations.hpp"
#include "systems/lever/static_solver.hpp"
#include "tests/helpers/afm_run.hpp"

namespace pulvis {
namespace {

constexpr double modulus = 115e9 / (1 - 0.35 * 0.35), ball = 8e-6;  // E*, R of hertz-ball.toml

struct Errors {
  double force = 0, radius = 0, pressure = 0;  // -, over Hertz's
};

template <class History>
Errors errors_at(const History& h, std::size_t i) {
  const double f = h.value(i, "probe/force_z"), approach = h.value(i, "scanner/z");
  const double a = std::cbrt(0.75 * f * ball / modulus);
  return {f / (4.0 / 3 * modulus * std::sqrt(ball) * std::pow(approach, 1.5)) - 1,
          h.value(i, "contact/radius") / a - 1,
          h.value(i, "contact/pressure") / (1.5 * f / (std::numbers::pi * a * a)) - 1};
}

// The radius of contact is five elements long at last, of the coarser mesh two and a half. The plane's way is the
// approach: what lever and neck give is 0.2% of it.
TEST(HertzBall, TakesHertzsForceRadiusAndPressureWhereItsMeshResolvesThem) {
  const FiledHistory fine = run_shipped_afm("hertz-ball");
  ASSERT_EQ(fine.samples(), 4u);
  const AfmHistory coarse =
      history_of(shipped_afm("hertz-ball.toml", {"tip.contact_edge=0.08 um"}));
  for (std::size_t i = 1; i < fine.samples(); ++i)
    EXPECT_LT(std::abs(errors_at(fine, i).force), 0.03) << i;
  const std::size_t end = fine.samples() - 1;
  const Errors few = errors_at(coarse, end), many = errors_at(fine, end);
  EXPECT_LT(std::abs(many.radius), 0.03);
  EXPECT_LT(std::abs(many.pressure), 0.03);
  EXPECT_LT(std::abs(many.force), 0.5 * std::abs(few.force));
  EXPECT_LT(std::abs(many.radius), 0.67 * std::abs(few.radius));
  EXPECT_LT(std::abs(many.pressure), 0.67 * std::abs(few.pressure));
}

// Nodes in the middle of larger faces and edges hang: an even strain passes through all the same, and leaves
// no force on any node inside.
TEST(HertzBall, ADividedMeshPassesThePatchTest) {
  SolidDraft draft;
  const BallMesh mesh = add_ball(draft, {{1e-6, 2e-6, 3e-6}, 8e-6, 4, 0.2e-6, 1e-6});
  const SolidMaterial material{100e9, 50e9, 0, 0};
  const auto world = finish_solid(draft, {material, material, material, material});
  Eigen::Matrix3d gradient;
  gradient << 1, 2, -1, 0.5, -2, 3, 1.5, 0, 1;
  gradient *= 1e-3;
  double* u = world->column<Displacement>().values();
  for (std::size_t n = 0; n < draft.nodes.size(); ++n)
    Eigen::Map<Eigen::Vector3d>(u + 3 * n) = gradient * draft.nodes[n];
  Workers(1).run([&] { StaticSolver(*world).look(); });
  std::set<int> outside;
  for (const auto& face : mesh.faces) outside.insert(face.begin(), face.end());
  const auto& solid = world->resource<SolidMesh>();
  const auto& residual = world->resource<SolidEquations>().residual;
  int inside = 0, hanging = 0;
  for (std::size_t n = 0; n < draft.nodes.size(); ++n) {
    hanging += solid.unknown[n] < 0 ? 1 : 0;
    if (solid.unknown[n] < 0 || outside.contains(static_cast<int>(n))) continue;
    ++inside;
    EXPECT_LT(residual.segment<3>(3 * solid.unknown[n]).norm(), 1e-10 * residual.norm()) << n;
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(hanging, 100);
}

}  // namespace
}  // namespace pulvis
