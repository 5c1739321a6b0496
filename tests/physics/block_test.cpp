// Blocks: contact patch test across a non-matching interface, Coulomb sliding.
#include <gtest/gtest.h>

#include "components/body.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

class PatchTest : public testing::TestWithParam<const char*> {};

TEST_P(PatchTest, UniformPressureCrossesANonMatchingInterface) {
  Experiment e("basic/patch-test.toml", {std::string("element.formulation=") + GetParam()});
  e.run(20);
  const std::size_t stress = 4;  // field of Results::fields
  ASSERT_EQ(e.results.fields()[stress].name, "stress");
  const std::vector<double> s = e.results.frame()[stress];
  const double force = 0.5 * (e.value("tool/top/force_y") - e.value("tool/bottom/force_y"));
  const double pressure = force / (10e-3 * e.scene.thickness);
  for (std::size_t c = 0; c < s.size() / 4; ++c) {
    EXPECT_NEAR(-s[4 * c + 1] / pressure, 1, 0.002) << "element " << c;
    EXPECT_NEAR(s[4 * c] / pressure, 0, 0.002);
    EXPECT_NEAR(s[4 * c + 3] / pressure, 0, 0.002);
  }
}
INSTANTIATE_TEST_SUITE_P(Formulations, PatchTest,
                         testing::Values("one-point", "four-point", "standard"));

TEST(SlidingBlock, StartsAndSlidesAtMuN) {
  Experiment e("basic/sliding-block.toml");
  const double mu = 0.3;
  const auto center = [&] {
    const auto& x = e.column<Position<TwoD>>();
    double sum = 0;
    for (std::size_t n = 0; n < x.table.rows; ++n) sum += x.lanes()[2 * n][0];
    return sum / static_cast<double>(x.table.rows);
  };
  const double start = center();
  double ratio_at_start = 0, sum = 0;
  int sliding = 0;
  e.run(500, [&] {
    const double normal = -e.value("tool/floor/force_y");
    if (normal <= 0 || e.simulation.clock().time < 0.5e-3) return;
    const double ratio = e.value("tool/floor/force_x") / normal;
    EXPECT_LE(ratio, mu * (1 + 1e-9));
    const double moved = center() - start;
    if (moved < 2e-6) ratio_at_start = std::max(ratio_at_start, ratio);  // 1e-4 of its width
    if (moved < 5e-6 || e.simulation.clock().time > 2.2e-3) return;  // the pusher stops at the end
    EXPECT_NEAR(ratio, mu, 0.005 * mu) << e.simulation.clock().time;
    sum += ratio;
    ++sliding;
  });
  ASSERT_GT(sliding, 50);
  EXPECT_NEAR(sum / sliding, mu, 0.005 * mu);
  EXPECT_NEAR(ratio_at_start, mu, 0.01 * mu);
}

}  // namespace
}  // namespace pulvis
