// An elastic ball, meshed finely where it touches, on a rigid plane: Hertz's force, radius and pressure.
#include <cmath>
#include <numbers>

#include "tests/afm/afm_run.hpp"

namespace pulvis {
namespace {

constexpr double modulus = 115e9 / (1 - 0.35 * 0.35), ball = 8e-6;  // E*, R of hertz-ball.toml

// The scanner's way is Hertz's approach and what lever, neck and the rest of the ball give: d = (F/K)^(2/3) + C F.
// Both constants from a press, by least squares on d/F^(2/3).
struct Approach {
  double stiffness = 0;   // N/m^(3/2), K
  double compliance = 0;  // m/N, C
  double misfit = 0;      // -, of the largest way
};

Approach approach_of(const AfmHistory& h) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t i = 1; i < h.rows.size(); ++i) {
    const double f = h.value(i, "probe/force_z"), local = std::pow(f, 2.0 / 3);
    const double a = f / local, b = h.value(i, "scanner/z") / local;
    n += 1, x += a, y += b, xx += a * a, xy += a * b;
  }
  Approach fit;
  fit.compliance = (n * xy - x * y) / (n * xx - x * x);
  fit.stiffness = std::pow((y - fit.compliance * x) / n, -1.5);
  for (std::size_t i = 1; i < h.rows.size(); ++i) {
    const double f = h.value(i, "probe/force_z"), d = h.value(i, "scanner/z");
    const double fitted = std::pow(f / fit.stiffness, 2.0 / 3) + fit.compliance * f;
    fit.misfit = std::max(fit.misfit, std::abs(fitted - d) / last(h, "scanner/z"));
  }
  return fit;
}

struct Errors {
  double radius = 0, pressure = 0, stiffness = 0;
};

Errors errors_of(const std::vector<std::string>& mesh) {
  const Scene scene = shipped_afm("hertz-ball.toml", mesh);
  const AfmHistory h = history_of(scene);
  const double f = last(h, "probe/force_z");
  EXPECT_NEAR(f, 2e-3, 1e-9);
  const double a = std::cbrt(0.75 * f * ball / modulus);
  const Approach fit = approach_of(h);
  EXPECT_LT(fit.misfit, 0.003);
  const Errors errors{last(h, "contact/radius") / a - 1,
                      last(h, "contact/pressure") / (1.5 * f / (std::numbers::pi * a * a)) - 1,
                      fit.stiffness / (4.0 / 3 * modulus * std::sqrt(ball)) - 1};
  std::cout << errors.radius << " " << errors.pressure << " " << errors.stiffness << " "
            << fit.compliance << " " << fit.misfit << " " << last(h, "contact/points") << "\n";
  return errors;
}

TEST(HertzBall, AMeshedBallTakesHertzsForceRadiusAndPressureWhereItsMeshResolvesThem) {
  const Errors fine = errors_of({});
  EXPECT_LT(std::abs(fine.radius), 0.03);
  EXPECT_LT(std::abs(fine.pressure), 0.03);
  EXPECT_LT(std::abs(fine.stiffness), 0.03);
  const Errors coarse = errors_of({"tip.contact_edge=0.16 um"});
  EXPECT_GT(std::abs(coarse.radius), std::abs(fine.radius));
  EXPECT_GT(std::abs(coarse.stiffness), std::abs(fine.stiffness));
}

}  // namespace
}  // namespace pulvis
