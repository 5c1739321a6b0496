// Caps are fitted: to points of a surface that is known, its parameters come back. Keyword blocks are read back, and
// reproduce the points.
#include "cli/campaigns/probe/cap_models.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "cli/campaigns/probe/keyword_blocks.hpp"

namespace pulvis {
namespace {

using testing::HasSubstr;
using testing::Not;

using std::numbers::pi;

// A stress with this pressure and this von Mises' stress, xx = zz.
YieldPoint point_of(double p, double q) {
  YieldPoint point;
  point.stress = mandel_of({-p + q / 3, -p - 2 * q / 3, -p + q / 3});
  return point;
}

ProbedPowder powder_of(double relative_density, bool bonded, double centre = 50e6) {
  return {Axis::y, relative_density, bonded, mandel_of({-1, -1, -1}),
          mandel_of({-centre, -centre, -centre})};
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
  const auto fits = fit_caps(points, powder_of(0.9, true));
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
  const auto fits = fit_caps(cap_points(8e6, 0.6, 0.9, 150e6), powder_of(0.9, true));
  const FittedModel& fit = model(fits, "drucker_prager_cap");
  EXPECT_NEAR(fit.parameter("d") / 8e6, 1, 0.02);
  EXPECT_NEAR(fit.parameter("beta"), 0.6, 0.005);
  EXPECT_NEAR(fit.parameter("R"), 0.9, 0.01);
  EXPECT_NEAR(fit.parameter("p_b") / 150e6, 1, 1e-3);
  EXPECT_LT(fit.misfit, 2e-3);
}

// Points all around the surface determine everything; those of the cap alone leave the slope open.
TEST(Caps, TellWhatThePointsDoNotDetermine) {
  const auto around = fit_caps(cap_points(8e6, 0.6, 0.9, 150e6), powder_of(0.9, true));
  const FittedModel& known = model(around, "drucker_prager_cap");
  EXPECT_EQ(undetermined(known), "");
  ASSERT_EQ(known.ranges.size(), 4U);
  EXPECT_LT(known.ranges[1].low, 0.6);
  EXPECT_GT(known.ranges[1].high, 0.6);

  std::vector<YieldPoint> points;
  for (const double p : {60e6, 90e6, 120e6, 140e6, 148e6})
    points.push_back(point_of(p, cap_q(p, 1e6, 1.2, 2.0, 150e6, 0.03)));
  const auto fits = fit_caps(points, powder_of(0.9, false));
  const FittedModel& open = model(fits, "drucker_prager_cap");
  EXPECT_THAT(undetermined(open), HasSubstr("beta ("));
  EXPECT_TRUE(open.ranges[3].determined);  // p_b
  EXPECT_TRUE(model(fits, "modified_cam_clay").ranges[1].determined);
}

// Points that leave the cohesion open: without bonds there is none.
TEST(Caps, OfPowdersWithoutBondsHaveNoCohesion) {
  std::vector<YieldPoint> points = cap_points(0, 0.6, 0.9, 150e6);
  points.erase(points.begin(), points.begin() + 12);
  const auto fits = fit_caps(points, powder_of(0.9, false));
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
    point.stress = mandel_of({-p + tau, -p - tau, -p});
    points.push_back(point);
  }
  const auto fits = fit_caps(points, powder_of(0.9, true));
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
  EXPECT_TRUE(fit_caps({point_of(1e6, 0), point_of(2e6, 1e6)}, powder_of(0.9, true)).empty());
}

TEST(KeywordBlocks, ReadBackReproduceThePoints) {
  std::vector<CapRow> rows;
  std::vector<std::vector<YieldPoint>> points;
  for (const double density : {0.85, 0.9, 0.95}) {
    const double p_b = 100e6 * std::pow(density / 0.85, 8);
    points.push_back(cap_points(5e6, 0.55, 0.8, p_b));
    const auto fits = fit_caps(points.back(), powder_of(density, true));
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
    const std::vector<std::pair<std::string, double>> cap{{"d", *read[i].d.value},
                                                          {"beta", *read[i].beta.value},
                                                          {"R", *read[i].r.value},
                                                          {"p_b", *read[i].p_b.value}};
    for (const YieldPoint& point : points[i]) {
      const double p = point.pressure(), q = std::abs(point.deviatoric()),
                   middle = 0.5 * *read[i].p_b.value;
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
  const CamClay clay = cam_clay_of(rows).value();
  EXPECT_NEAR(clay.lambda, lambda, 1e-12);
  EXPECT_NEAR(clay.m.value.value(), 0.9, 1e-12);
  EXPECT_NEAR(clay.porosity, 0.2, 1e-12);
  EXPECT_NEAR(clay.p_c / 50e6, 1, 1e-12);
  EXPECT_THAT(code_aster_block("copper", rows), HasSubstr("CAM_CLAY=_F("));
  EXPECT_THAT(abaqus_block("copper", rows), Not(HasSubstr("do not determine")));
  EXPECT_EQ(code_aster_block("copper", {rows[0]}), "");
}

// No program takes a range for a number.
TEST(KeywordBlocks, HaveNoNumberForWhatThePointsDoNotDetermine) {
  std::vector<CapRow> rows;
  for (const double density : {0.85, 0.9})
    rows.push_back(
        {density, 30e9, 0.25, 1e6, 0.5, 0.8, 100e6 * density, 0.9, 50e6 * density, 8940});
  rows[0].beta = {std::nullopt, "beta: 50 to 90"};
  rows[0].m = {std::nullopt, "M: 0.2 to 1.5"};
  rows[1].m = rows[0].m;
  const std::string abaqus = abaqus_block("copper", rows), aster = code_aster_block("copper", rows),
                    dyna = ls_dyna_block("copper", rows);
  for (const std::string& text : {abaqus, aster, dyna})
    EXPECT_THAT(text, HasSubstr("The yield points do not determine"));
  EXPECT_THAT(abaqus, HasSubstr("1.000000e+06, <beta: 50 to 90>, 0.800000"));
  EXPECT_THAT(aster, HasSubstr("M=<M: 0.2 to 1.5>"));
  EXPECT_THAT(dyna, HasSubstr("<beta: 50 to 90, tan(beta)/(3 sqrt(3))>"));
  EXPECT_THROW(read_abaqus_block(abaqus), std::runtime_error);
  EXPECT_THAT(abaqus_block("die,rough", rows), HasSubstr("NAME=die_rough\n"));
  EXPECT_THAT(code_aster_block("die,rough", rows), HasSubstr("die_rough = DEFI_MATERIAU"));
  // All of a block is of its first row.
  rows.insert(rows.begin(), {0.8, 20e9, 0.2, 1e6, 0.5, 0.8, BlockValue(std::nullopt, "p_b: 1 to 9"),
                             0.9, BlockValue(std::nullopt, "p_c: 1 to 9"), 8940});
  EXPECT_THAT(code_aster_block("die", rows), HasSubstr("E=3.000000e+10"));
  EXPECT_THAT(ls_dyna_block("die", rows), HasSubstr("Relative density 0.8500"));
}

// The cap of LS-DYNA in its own variables J1 = 3 p and sqrt(J2) = q/sqrt(3) is that of Abaqus but for the transition.
TEST(KeywordBlocks, OfLsDynaBoundTheSameStresses) {
  std::vector<CapRow> rows;
  constexpr double w = 0.16, d = 2e-9;
  for (const double density : {0.85, 0.9, 0.95}) {
    const double strain = std::log(density / 0.85), full = -std::log(0.85);
    rows.push_back({density, 30e9, 0.25, 1e6, 0.5, 0.8, 100e6 - std::log(1 - strain / full) / d / 3,
                    0.9, 50e6, 8940});
  }
  const std::string text = ls_dyna_block("copper", rows);
  std::vector<std::vector<double>> cards;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '$' || line[0] == '*' || line == "copper") continue;
    std::istringstream fields(line);
    auto& card = cards.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) card.push_back(std::stod(field));
  }
  ASSERT_EQ(cards.size(), 3U);
  ASSERT_EQ(cards[0].size(), 8U);
  const double alpha = cards[0][4], theta = cards[0][5], r = cards[1][0];
  EXPECT_NEAR(cards[0][1] / (0.85 * 8940), 1, 1e-6);
  EXPECT_NEAR(cards[1][1] / d, 1, 1e-6);
  EXPECT_NEAR(cards[1][2] / w, 1, 0.02);  // ln(1/0.85) = 0.1625
  EXPECT_NEAR(cards[1][3] / 300e6, 1, 1e-6);
  // X = L + R Fe(L)
  const double x = cards[1][3], l = (x - r * alpha) / (1 + r * theta), fe = alpha + theta * l;
  const std::vector<std::pair<std::string, double>> cap{
      {"d", 1e6}, {"beta", 0.5}, {"R", 0.8}, {"p_b", 100e6}};
  for (const double j1 : {0.3 * l, 0.6 * l, 0.5 * (l + x), 0.9 * x}) {
    const double root =
        j1 < l ? alpha + theta * j1 : std::sqrt((x - l) * (x - l) - (j1 - l) * (j1 - l)) / r;
    const double p = j1 / 3, q = std::sqrt(3.0) * root;
    EXPECT_TRUE(is_elastic("drucker_prager_cap", cap, p, 0.98 * q)) << j1 / fe;
    EXPECT_FALSE(is_elastic("drucker_prager_cap", cap, p, 1.02 * q)) << j1 / fe;
  }
}

// ---- the turned ellipsoid -------------------------------------------------------------------------------
// Points on the surface along many directions of stress, from a powder pressed along z.
std::vector<YieldPoint> turned_points(double m, double p_c, double alpha, double p_t) {
  const Mandel n = unit_deviator(0);
  ProbeSpec spec;
  spec.directions = 24, spec.deviatoric = 12;
  std::vector<YieldPoint> points;
  for (const ProbeDirection& direction : directions_of(spec, true)) {
    const Mandel centre = mandel_of({-0.4 * p_c, -0.4 * p_c, -0.4 * p_c});
    double low = 0, high = 10 * p_c;
    for (int i = 0; i < 80; ++i) {
      const double r = 0.5 * (low + high);
      const Mandel at = centre + r * direction.unit;
      const double p = pressure_of(at) + p_t, a = alpha * std::sqrt(2.0 / 3);
      const bool inside = 1.5 * (deviator_of(at) - p * a * n).squaredNorm() <=
                          (m * m - alpha * alpha) * p * (p_c + p_t - p);
      (inside ? low : high) = r;
    }
    YieldPoint point;
    point.direction = direction;
    point.axis = Axis::z;
    point.stress = centre + low * direction.unit;
    points.push_back(point);
  }
  return points;
}

TEST(TurnedEllipsoids, ComeBack) {
  constexpr double m = 1.1, p_c = 80e6, alpha = 0.4;
  for (const bool bonded : {false, true}) {
    ProbedPowder powder{Axis::z, 0.8, bonded, mandel_of({-40e6, -40e6, -90e6}),
                        mandel_of({-30e6, -30e6, -40e6})};
    const double p_t = bonded ? 6e6 : 0;
    const auto fits = fit_caps(turned_points(m, p_c, alpha, p_t), powder);
    const FittedModel& fit = model(fits, "s_clay");
    EXPECT_NEAR(fit.parameter("M"), m, 2e-3);
    EXPECT_NEAR(fit.parameter("p_c") / p_c, 1, 2e-3);
    EXPECT_NEAR(fit.parameter("alpha"), alpha, 2e-3);
    if (bonded) {
      EXPECT_NEAR(fit.parameter("p_t") / p_t, 1, 0.05);
    }
    EXPECT_LT(fit.misfit, 1e-3);
    for (const char* name : {"M", "p_c", "alpha"}) EXPECT_TRUE(fit.determines(name)) << name;
    EXPECT_GT(model(fits, "modified_cam_clay").misfit, 0.02);
    EXPECT_EQ(fit.shell.size(), 17U);
    EXPECT_EQ(std::ranges::count(fits, "fleck_plane", &FittedModel::name), 0);
  }
}

// Pressed isostatically it is not turned, and is Cam-Clay.
TEST(TurnedEllipsoids, OfAnIsotropicPowderAreNotTurned) {
  ProbedPowder powder{Axis::z, 0.8, false, mandel_of({-60e6, -61e6, -60e6}),
                      mandel_of({-30e6, -30e6, -30e6})};
  const auto fits = fit_caps(turned_points(1.1, 80e6, 0, 0), powder);
  const FittedModel& fit = model(fits, "s_clay");
  EXPECT_LT(fit.parameter("alpha"), 0.03);
  EXPECT_NEAR(fit.parameter("M") / model(fits, "modified_cam_clay").parameter("M"), 1, 0.01);
}

}  // namespace
}  // namespace pulvis
