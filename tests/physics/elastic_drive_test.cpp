// Tools behind a spring, and friction that depends on speed: the plate of shear/stick-slip against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

struct Drawn {
  std::vector<double> time, place, force, normal;  // s, m, N, N; while the plate is drawn
  double speed(std::size_t i) const { return (place[i] - place[i - 1]) / (time[i] - time[i - 1]); }
  // Mean over the part of the time from `low` to `high`.
  std::pair<double, double> speeds(double low, double high) const {
    double least = 1e300, largest = -1e300;
    for (std::size_t i = 1; i < time.size(); ++i) {
      const double share = (time[i] - time[0]) / (time.back() - time[0]);
      if (share < low || share > high) continue;
      least = std::min(least, speed(i));
      largest = std::max(largest, speed(i));
    }
    return {least, largest};
  }
};

Drawn drawn(const std::vector<std::string>& overrides) {
  Experiment e("shear/stick-slip.toml", overrides);
  Drawn found;
  e.run(1700, [&] {
    if (e.simulation.clock().time < 0.5e-3) return;
    found.time.push_back(e.simulation.clock().time);
    found.place.push_back(e.value("tool/target/position_x"));
    found.force.push_back(e.value("tool/target/drive_force"));
    found.normal.push_back(std::abs(e.value("tool/target/force_y")));
  });
  return found;
}

std::string drive(const char* key, const std::string& value) {
  return fmt::format("stage.draw.move[0].{}={}", key, value);
}
const std::string without_friction = "friction[0].coefficient=0";
const std::string without_rate = "friction[0].rate=0";

// Without friction the plate swings about its drive with 2 pi sqrt(M/k), and the dashpot takes exp(-2 pi zeta/sqrt(1 -
// zeta^2)) a period.
TEST(ElasticDrive, SwingsAsAMassOnASpring) {
  for (const double damping : {0.0, 0.1}) {
    const Drawn d =
        drawn({without_friction, without_rate, drive("damping", fmt::format("{}", damping))});
    std::vector<double> crossings, peaks;
    double peak = 0;
    for (std::size_t i = 1; i < d.time.size(); ++i) {
      const double share = (d.time[i] - d.time[0]) / (d.time.back() - d.time[0]);
      if (share < 0.05 || share > 0.9) continue;
      peak = std::max(peak, d.force[i]);
      if (d.force[i - 1] > 0 || d.force[i] <= 0) continue;
      crossings.push_back(d.time[i - 1] + (d.time[i] - d.time[i - 1]) * d.force[i - 1] /
                                              (d.force[i - 1] - d.force[i]));
      peaks.push_back(peak);
      peak = 0;
    }
    ASSERT_GE(crossings.size(), 6u);
    const double period = (crossings[5] - crossings[0]) / 5;
    const double free = 2 * std::numbers::pi * std::sqrt(0.01 / 1e6);
    EXPECT_NEAR(period, free / std::sqrt(1 - damping * damping), 0.002 * free) << damping;
    const double decay =
        std::exp(-2 * std::numbers::pi * damping / std::sqrt(1 - damping * damping));
    EXPECT_NEAR(peaks[4] / peaks[3], decay, 0.02) << damping;
  }
}

// In steady sliding the spring bears the friction; at a constant drive speed the plate is behind by mu N/k.
TEST(ElasticDrive, BearsTheFrictionOfSteadySliding) {
  const Drawn d = drawn({"friction[0].coefficient=0.3", without_rate, drive("damping", "0.5")});
  for (std::size_t i = 0; i < d.time.size(); ++i) {
    const double share = (d.time[i] - d.time[0]) / (d.time.back() - d.time[0]);
    if (share < 0.7 || share > 0.95) continue;
    EXPECT_NEAR(d.force[i], 0.3 * d.normal[i], 0.5) << share;
  }
  EXPECT_NEAR(d.normal.back(), 217, 3);
}

// Friction that weakens over a distance l lets a plate jump where the spring is softer than k_c = N (mu_s - mu_d)/l
// (Rice & Ruina 1983, of quasi-static slip): a stiffer one follows its drive, at first 1/(1 - k_c/k) as fast.
TEST(ElasticDrive, JumpsWhereTheSpringIsSofterThanTheWeakening) {
  const auto fastest = [](double share) {
    const double normal = 217, stiffness = share * normal * 0.2 / 20e-6;
    const double way = 2 * 0.4 * normal / stiffness;  // it starts to slide half way
    const Drawn d =
        drawn({"friction[0].coefficient=0.2", without_rate, "friction[0].static_coefficient=0.4",
               "friction[0].decay_length=20 um", drive("damping", "1"),
               drive("displacement", fmt::format("[\"{} m\", \"0 mm\"]", way)),
               drive("stiffness", fmt::format("{} N/m", stiffness))});
    return d.speeds(0.1, 0.9).second / (way / 8e-3 / 0.97);
  };
  EXPECT_GT(fastest(0.3), 3);
  const double stable = fastest(4);
  EXPECT_GT(stable, 1.15);
  EXPECT_LT(stable, 1.5);  // 4/3
}

// Steady sliding is stable where c > N a/(v_0 + V): above V_c, or with a stiffer spring of the same damping ratio.
TEST(ElasticDrive, SticksAndSlipsBelowTheCriticalSpeedAlone) {
  const double normal = 216, dashpot = 2 * 0.25 * std::sqrt(1e6 * 0.01);
  const double critical = normal * 0.05 / dashpot - 0.01;
  EXPECT_NEAR(critical, 0.206, 0.001);
  const auto swing = [](double speed, double stiffness) {
    const Drawn d =
        drawn({drive("displacement", fmt::format("[\"{} mm\", \"0 mm\"]", speed * 8 * 0.97)),
               drive("stiffness", fmt::format("{} N/m", stiffness))});
    const auto [least, largest] = d.speeds(0.7, 0.95);
    return std::pair{least / speed, largest / speed};
  };
  const auto slow = swing(0.5 * critical, 1e6);
  EXPECT_LT(slow.first, 0.1);  // it sticks
  EXPECT_GT(slow.second, 1.6);
  const auto fast = swing(2 * critical, 1e6);
  EXPECT_GT(fast.first, 0.95);
  EXPECT_LT(fast.second, 1.05);
  const auto stiff = swing(0.5 * critical, 16e6);  // V_c is 0.044 m/s there
  EXPECT_GT(stiff.first, 0.95);
  EXPECT_LT(stiff.second, 1.05);
}

// mu(V) = mu_0 + a ln(1 + V/v_0), rising as copper's and falling as sugar's (thesis, 3.3.5.4), with a stiff drive.
TEST(RateFriction, IsTheLogarithmOfTheSpeed) {
  for (const double rate : {0.03, -0.03})
    for (const double speed : {0.1, 0.4}) {
      const Drawn d =
          drawn({"friction[0].coefficient=0.3", fmt::format("friction[0].rate={}", rate),
                 "friction[0].reference_speed=50 mm/s", drive("damping", "1"),
                 drive("displacement", fmt::format("[\"{} mm\", \"0 mm\"]", speed * 8 * 0.97))});
      const std::size_t i = d.time.size() * 9 / 10;
      EXPECT_NEAR(d.force[i] / d.normal[i], 0.3 + rate * std::log(1 + speed / 0.05), 0.003)
          << rate << " at " << speed;
    }
}

}  // namespace
}  // namespace pulvis
