// Hardening laws against their formulas, and each against itself: slope and work by finite differences and sums.
#include "systems/laws/hardening.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "systems/laws/rate.hpp"
#include "tests/helpers/random_values.hpp"

namespace pulvis::kernels {
namespace {

const VoceHardening voce{240e6, 180e6, 25};
const SwiftHardening swift{240e6, 0.01, 0.25};
const LudwikHardening ludwik{240e6, 500e6, 0.4};
const TabulatedHardening table{{0, 0.02, 0.1, 0.5}, {240e6, 280e6, 320e6, 320e6}};
const LinearHardening<double> linear{240e6, 440e6};

template <class Look>
void each_law(const Look& look) {
  look(linear);
  look(voce);
  look(swift);
  look(ludwik);
  look(table);
}

TEST(Hardening, BeginsAtTheYieldStress) {
  each_law([](const auto& law) { EXPECT_DOUBLE_EQ(law.flow_stress(0.0), 240e6) << law.name; });
}

TEST(Hardening, IsTheFormulaOfItsSource) {
  for (const double e : {1e-6, 0.003, 0.05, 0.7}) {
    EXPECT_DOUBLE_EQ(voce.flow_stress(e), 240e6 + 180e6 * (1 - std::exp(-25 * e)));
    EXPECT_NEAR(swift.flow_stress(e), 240e6 / std::pow(0.01, 0.25) * std::pow(0.01 + e, 0.25),
                1e-14 * 1e9);
    EXPECT_DOUBLE_EQ(ludwik.flow_stress(e), 240e6 + 500e6 * std::pow(e, 0.4));
  }
  EXPECT_DOUBLE_EQ(table.flow_stress(0.06), 300e6);
  EXPECT_DOUBLE_EQ(table.flow_stress(0.1), 320e6);
  EXPECT_DOUBLE_EQ(table.flow_stress(7.0), 320e6);  // beyond the last point
}

TEST(Hardening, VoceSaturates) {
  EXPECT_NEAR(voce.flow_stress(2.0), 420e6, 1e-12 * 420e6);
  EXPECT_EQ(voce.modulus(40.0), 0);
}

TEST(Hardening, SlopeIsThatOfTheCurve) {
  each_law([](const auto& law) {
    for (const double e : {0.004, 0.05, 0.3}) {  // no point of the table
      const double h = 1e-6;
      const double slope = (law.flow_stress(e + h) - law.flow_stress(e - h)) / (2 * h);
      EXPECT_NEAR(law.modulus(e), slope, 1e-5 * 240e6) << law.name << " " << e;
    }
  });
}

TEST(Hardening, WorkIsTheIntegral) {
  each_law([](const auto& law) {
    double sum = 0;
    constexpr int parts = 100000;
    constexpr double far = 0.6, step = far / parts;
    for (int i = 0; i < parts; ++i) sum += law.flow_stress((i + 0.5) * step) * step;
    EXPECT_NEAR(law.plastic_work(far), sum, 1e-6 * sum) << law.name;
    EXPECT_NEAR(law.plastic_work(0.0), 0, 1e-7) << law.name;
  });
}

TEST(Hardening, LanesGiveTheBitsOfTheScalar) {
  Random random(3);
  each_law([&](const auto& law) {
    for (int i = 0; i < 100; ++i) {
      const Lane e = Lane::from([&](int) { return random.in(0, 0.6); });
      using Law = std::remove_cvref_t<decltype(law)>;
      if constexpr (!std::is_same_v<Law, LinearHardening<double>>)
        for (int l = 0; l < lane_count; ++l) {
          ASSERT_EQ(bits(law.flow_stress(e)[l]), bits(law.flow_stress(e[l])));
          ASSERT_EQ(bits(law.modulus(e)[l]), bits(law.modulus(e[l])));
          ASSERT_EQ(bits(law.plastic_work(e)[l]), bits(law.plastic_work(e[l])));
        }
    }
  });
}

TEST(CowperSymonds, IsTheFormulaOfItsSource) {
  const CowperSymonds law{40, 5};
  EXPECT_EQ(law.factor(0.0), 1);
  EXPECT_DOUBLE_EQ(law.factor(40.0), 2);
  EXPECT_DOUBLE_EQ(law.factor(1e4), 1 + std::pow(1e4 / 40, 0.2));
  for (const double rate : {0.01, 3.0, 1e4}) {
    const double h = 1e-5 * rate;
    EXPECT_NEAR(law.slope(rate), (law.factor(rate + h) - law.factor(rate - h)) / (2 * h),
                1e-8 * law.slope(rate));
  }
}

}  // namespace
}  // namespace pulvis::kernels
