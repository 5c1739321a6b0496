// Caps are fitted: to points of a surface that is known, its parameters come back. Keyword blocks are read back, and
// reproduce the points.
#include "cli/campaigns/probe/cap_models.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cli/campaigns/probe/keyword_blocks.hpp"

namespace pulvis {
namespace {

using testing::HasSubstr;
using testing::Not;

using std::numbers::pi;

// A stress with this pressure and this von Mises' stress, xx = zz.
YieldPoint point_of(double p, double q) {
  YieldPoint point;
  point.stress = {-p + q / 3, -p - 2 * q / 3, 0, -p + q / 3};
  return point;
}

const FittedModel& model(const std::vector<FittedModel>& fits, const std::string& name) {
  return *std::ranges::find(fits, name, &FittedModel::name);
}

TEST(Invariants, OfTheTestsPointsAreRight) {
  EXPECT_NEAR(point_of(30e6, 12e6).pressure(), 30e6, 1e-3);
  EXPECT_NEAR(point_of(30e6, 12e6).deviatoric(), 12e6, 1e-3);
}

TEST(Caps, OfModifiedCamClayComeBack) {
  constexpr double slope = 0.8, p_c = 120e6;
  std::vector<YieldPoint> points;
  for (int i = 1; i < 20; ++i) {
    const double p = p_c * (0.2 + 0.8 * i / 20);
    points.push_back(point_of(p, slope * std::sqrt(p * (p_c - p)) * (i % 2 == 0 ? 1 : -1)));
  }
  const auto fits = fit_caps(points, 0.9, true);
  const FittedModel& fit = model(fits, "modified_cam_clay");
  EXPECT_NEAR(fit.parameter("M"), slope, 1e-4);
  EXPECT_NEAR(fit.parameter("p_c") / p_c, 1, 1e-4);
  EXPECT_LT(fit.misfit, 1e-5);
  EXPECT_GT(model(fits, "fleck_kuhn_mcmeeking").misfit, 0.05);  // and not the others
}

// The equations of Abaqus, solved for q.
double cap_q(double p, double d, double beta, double r, double p_b, double alpha) {
  const double slope = std::tan(beta), p_a = (p_b - r * d) / (1 + r * slope);
  const double strength = d + p_a * slope;
  if (p > p_a)
    return (1 + alpha - alpha / std::cos(beta)) / r *
           std::sqrt(r * r * strength * strength - (p - p_a) * (p - p_a));
  const double arc =
      (1 - alpha / std::cos(beta)) * strength +
      std::sqrt(std::max(0.0, alpha * alpha * strength * strength - (p - p_a) * (p - p_a)));
  const bool on_arc = p_a - p < alpha * std::sin(beta) * strength;
  return on_arc ? arc : d + p * slope;
}

std::vector<YieldPoint> cap_points(double d, double beta, double r, double p_b) {
  std::vector<YieldPoint> points;
  for (int i = 1; i < 30; ++i) {
    const double p = p_b * (0.15 + 0.85 * i / 30);
    points.push_back(point_of(p, cap_q(p, d, beta, r, p_b, 0.03)));
  }
  return points;
}

TEST(Caps, OfDruckerAndPragerComeBack) {
  const auto fits = fit_caps(cap_points(8e6, 0.6, 0.9, 150e6), 0.9, true);
  const FittedModel& fit = model(fits, "drucker_prager_cap");
  EXPECT_NEAR(fit.parameter("d") / 8e6, 1, 0.02);
  EXPECT_NEAR(fit.parameter("beta"), 0.6, 0.005);
  EXPECT_NEAR(fit.parameter("R"), 0.9, 0.01);
  EXPECT_NEAR(fit.parameter("p_b") / 150e6, 1, 1e-3);
  EXPECT_LT(fit.misfit, 2e-3);
}

// Points all around the surface determine everything; those of the cap alone leave the slope open.
TEST(Caps, TellWhatThePointsDoNotDetermine) {
  const auto around = fit_caps(cap_points(8e6, 0.6, 0.9, 150e6), 0.9, true);
  const FittedModel& known = model(around, "drucker_prager_cap");
  EXPECT_EQ(undetermined(known), "");
  ASSERT_EQ(known.ranges.size(), 4U);
  EXPECT_LT(known.ranges[1].low, 0.6);
  EXPECT_GT(known.ranges[1].high, 0.6);

  std::vector<YieldPoint> points;
  for (const double p : {60e6, 90e6, 120e6, 140e6, 148e6})
    points.push_back(point_of(p, cap_q(p, 1e6, 1.2, 2.0, 150e6, 0.03)));
  const auto fits = fit_caps(points, 0.9, false);
  const FittedModel& open = model(fits, "drucker_prager_cap");
  EXPECT_THAT(undetermined(open), HasSubstr("beta ("));
  EXPECT_TRUE(open.ranges[3].determined);  // p_b
  EXPECT_TRUE(model(fits, "modified_cam_clay").ranges[1].determined);
}

// Points that leave the cohesion open: without bonds there is none.
TEST(Caps, OfPowdersWithoutBondsHaveNoCohesion) {
  std::vector<YieldPoint> points = cap_points(0, 0.6, 0.9, 150e6);
  points.erase(points.begin(), points.begin() + 12);
  const auto fits = fit_caps(points, 0.9, false);
  const FittedModel& fit = model(fits, "drucker_prager_cap");
  EXPECT_LT(fit.parameter("d"), 1.5e6);
  EXPECT_NEAR(fit.parameter("beta"), 0.6, 0.03);
  EXPECT_LT(fit.misfit, 0.01);
}

TEST(Caps, OfContactsWithoutTensionComeBack) {
  constexpr double p_y = 80e6;
  std::vector<YieldPoint> points;
  for (int i = 3; i < 20; ++i) {
    const double p = p_y * i / 20, tau = p_y / pi * std::sin(pi * p / p_y);
    YieldPoint point;
    point.stress = {-p + tau, -p - tau, 0, -p};
    points.push_back(point);
  }
  const auto fits = fit_caps(points, 0.9, true);
  EXPECT_NEAR(model(fits, "fleck_plane").parameter("p_y") / p_y, 1, 1e-5);
  EXPECT_LT(model(fits, "fleck_plane").misfit, 1e-5);
  EXPECT_GT(model(fits, "fleck_plane_cohesive").misfit, 0.05);
}

// The closed form against the integral it comes from: contacts of all directions, those that close bear c.
TEST(FleckPlane, IsTheIntegralOverTheContacts) {
  constexpr int directions = 20000;
  constexpr double c = 1;
  for (const double closing : {0.2, 0.5, 0.9, 1.3}) {  // rad, on both sides of the axis of pressing
    double p = 0, tau = 0;
    for (int i = 0; i < directions; ++i) {
      const double angle = pi * (i + 0.5) / directions - pi / 2;
      if (std::abs(angle) > closing) continue;
      const double one = c * pi / directions, s = std::sin(angle), k = std::cos(angle);
      p += 0.5 * one * (k * k + s * s), tau += 0.5 * one * (k * k - s * s);
    }
    const double p_y = 0.5 * pi * c;
    EXPECT_NEAR(tau, p_y / pi * std::sin(pi * p / p_y), 1e-3);
    EXPECT_FALSE(is_elastic("fleck_plane", {{"p_y", p_y}}, p, 1.01 * tau));
    EXPECT_TRUE(is_elastic("fleck_plane", {{"p_y", p_y}}, p, 0.99 * tau));
  }
}

TEST(Caps, NeedPoints) {
  EXPECT_EQ(usable({point_of(1e6, 0), point_of(20e6, 5e6), point_of(20e6, -5e6)}),
            (std::vector<bool>{false, true, false}));
  EXPECT_EQ(usable_points({point_of(1e6, 0), point_of(20e6, 5e6), point_of(20e6, -5e6)}), 1U);
  EXPECT_TRUE(fit_caps({point_of(1e6, 0), point_of(2e6, 1e6)}, 0.9, true).empty());
}

TEST(KeywordBlocks, ReadBackReproduceThePoints) {
  std::vector<CapRow> rows;
  std::vector<std::vector<YieldPoint>> points;
  for (const double density : {0.85, 0.9, 0.95}) {
    const double p_b = 100e6 * std::pow(density / 0.85, 8);
    points.push_back(cap_points(5e6, 0.55, 0.8, p_b));
    const auto fits = fit_caps(points.back(), density, true);
    const FittedModel &cap = model(fits, "drucker_prager_cap"),
                      &clay = model(fits, "modified_cam_clay");
    rows.push_back({density, 40e9 * density, 0.2, cap.parameter("d"), cap.parameter("beta"),
                    cap.parameter("R"), cap.parameter("p_b"), clay.parameter("M"),
                    clay.parameter("p_c")});
  }
  const std::string text = abaqus_block("copper", rows);
  for (const char* keyword : {"*CAP PLASTICITY, DEPENDENCIES=1", "*CAP HARDENING",
                              "*ELASTIC, DEPENDENCIES=1", "*MATERIAL, NAME=copper"})
    EXPECT_THAT(text, HasSubstr(keyword));
  const std::vector<CapRow> read = read_abaqus_block(text);
  ASSERT_EQ(read.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(read[i].density, rows[i].density, 1e-6);
    EXPECT_NEAR(read[i].youngs_modulus / rows[i].youngs_modulus, 1, 1e-6);
    const std::vector<std::pair<std::string, double>> cap{
        {"d", read[i].d}, {"beta", read[i].beta}, {"R", read[i].r}, {"p_b", read[i].p_b}};
    for (const YieldPoint& point : points[i]) {
      const double p = point.pressure(), q = std::abs(point.deviatoric()),
                   middle = 0.5 * read[i].p_b;
      const auto inside = [&](double share) {
        return is_elastic("drucker_prager_cap", cap, middle + share * (p - middle), share * q);
      };
      EXPECT_TRUE(inside(0.98)) << p << " " << q;
      EXPECT_FALSE(inside(1.02)) << p << " " << q;
    }
  }
}

// p_c = p_0 exp((e_0 - e)/lambda) gives lambda back.
TEST(KeywordBlocks, OfCamClayHaveItsSlopes) {
  constexpr double lambda = 0.07;
  std::vector<CapRow> rows;
  for (const double density : {0.8, 0.85, 0.9}) {
    const double e = (1 - density) / density;
    rows.push_back(
        {density, 30e9, 0.25, 1e6, 0.5, 0.8, 100e6, 0.9, 50e6 * std::exp((0.25 - e) / lambda)});
  }
  const CamClay clay = cam_clay_of(rows);
  EXPECT_NEAR(clay.lambda, lambda, 1e-12);
  EXPECT_NEAR(clay.m, 0.9, 1e-12);
  EXPECT_NEAR(clay.porosity, 0.2, 1e-12);
  EXPECT_NEAR(clay.p_c / 50e6, 1, 1e-12);
  EXPECT_THAT(code_aster_block("copper", rows), HasSubstr("CAM_CLAY=_F("));
  EXPECT_THAT(abaqus_block("copper", rows), Not(HasSubstr("WARNING")));
  rows[1].open_cap = "beta (50 to 90 deg)";
  EXPECT_THAT(
      abaqus_block("copper", rows),
      HasSubstr("** WARNING: at density 0.8500 the yield points do not determine beta (50"));
  EXPECT_EQ(read_abaqus_block(abaqus_block("copper", rows)).size(), rows.size());
  EXPECT_EQ(code_aster_block("copper", {rows[0]}), "");
}

}  // namespace
}  // namespace pulvis
