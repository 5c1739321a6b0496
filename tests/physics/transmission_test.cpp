// Force that reaches the bottom punch: a real compaction against the balance of a slice, and when nothing
// can be compared.
#include <gmock/gmock.h>

#include "scenes/results/compaction_curve.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

Transmission of_run(Experiment& e) {
  CompactionCurve curve(e.scene);
  e.run(200, [&] { curve.sample(e.results); });
  return transmission(e.scene, curve);
}

// With the lateral ratio that the run itself shows, exp(-2 mu K H / W) is the balance of forces of a compact
// that slides at both walls. What is left: walls that stick for a while, and inertia. 1% of the force.
TEST(Transmission, IsTheBalanceOfASlidingSlot) {
  Experiment e("compaction/regular-25.toml");
  const Transmission found = of_run(e);
  ASSERT_EQ(found.not_compared, "");
  ASSERT_EQ(found.shares.size(), 8U);
  EXPECT_EQ(found.wall_friction, 0.1);
  for (const TransmissionShare& share : found.shares) {
    if (share.density < 0.80) continue;  // not all discs touch the walls yet
    EXPECT_NEAR(share.measured, *share.slot_measured_ratio, 0.01) << share.density;
    EXPECT_LT(*share.round_die, *share.slot);
  }
  EXPECT_NEAR(*found.shares.back().slot,
              std::exp(-2 * 0.1 * 0.3 / 0.7 * found.shares.back().height_over_width), 1e-12);
}

TEST(Transmission, IsWholeWithoutFriction) {
  Experiment e("compaction/regular-25.toml",
               {"contact.friction=0", "stage.press.duration=1.12 ms",
                "stage.press.move[0].displacement=[\"0 mm\", \"-2 mm\"]"});
  const Transmission found = of_run(e);
  ASSERT_EQ(found.shares.size(), 8U);
  EXPECT_EQ(*found.shares[4].slot, 1);
  // Half way the punch has its full speed; where it starts and stops the powder's inertia shows.
  EXPECT_NEAR(found.shares[4].measured, 1, 0.005);
}

TEST(Transmission, SaysWhyThereIsNothing) {
  Experiment e(
      "compaction/regular-25.toml",
      {"stage.press.duration=20 us", "stage.press.move[0].displacement=[\"0 mm\", \"1 mm\"]"});
  EXPECT_THAT(of_run(e).not_measured, testing::HasSubstr("does not press"));
  Experiment both(
      "compaction/regular-25.toml",
      {"stage.press.duration=200 us", "stage.press.move[0].displacement=[\"0 mm\", \"0.4 mm\"]",
       "stage.press.move[0].tool=bottom"});
  const Transmission moved = of_run(both);
  EXPECT_EQ(moved.not_measured, "");
  EXPECT_THAT(moved.not_compared, testing::HasSubstr("bottom punch moves"));
  EXPECT_FALSE(moved.shares.front().slot.has_value());
}

}  // namespace
}  // namespace pulvis
