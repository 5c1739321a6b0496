// Fits of compaction laws: curves of known parameters give them back, and curves that a law says nothing
// about are refused with the reason.
#include "scenes/results/density_fits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace pulvis {
namespace {

using testing::HasSubstr;

struct Curve {
  std::vector<double> density, pressure;
};

// `density_at` for pressures up to `maximum`, after a first sample without pressure.
template <class Law>
Curve curve_of(double first, double maximum, const Law& density_at, int count = 200) {
  Curve curve{{first}, {0}};
  for (int i = 1; i <= count; ++i) {
    const double p = maximum * i / count;
    curve.pressure.push_back(p);
    curve.density.push_back(density_at(p));
  }
  return curve;
}

std::map<std::string, double> values(const DensityFit& fit) {
  std::map<std::string, double> by_name;
  for (const FitParameter& p : fit.parameters) by_name[p.name] = p.value;
  return by_name;
}

TEST(DensityFits, HeckelGivesItsParametersBack) {
  const double k = 2.5e-9, a = 1.4;
  const Curve c = curve_of(0.7, 400e6, [&](double p) { return 1 - std::exp(-(k * p + a)); });
  const DensityFit fit = fit_heckel(fit_range(c.density, c.pressure));
  EXPECT_EQ(fit.not_fitted, "");
  EXPECT_NEAR(values(fit)["K"], k, 1e-10 * k);
  EXPECT_NEAR(values(fit)["A"], a, 1e-10 * a);
  EXPECT_NEAR(values(fit)["yield_pressure"], 4e8, 0.1);
  EXPECT_LT(fit.rms, 1e-12);
  EXPECT_NEAR(fit.r_squared, 1, 1e-12);
  EXPECT_LT(fit.rms_density, 1e-12);
}

TEST(DensityFits, KawakitaGivesItsParametersBack) {
  const double d0 = 0.72, a = 0.27, b = 1.7e-8;
  const Curve c = curve_of(d0, 300e6, [&](double p) { return d0 / (1 - a * b * p / (1 + b * p)); });
  const DensityFit fit = fit_kawakita(fit_range(c.density, c.pressure));
  EXPECT_EQ(fit.not_fitted, "");
  EXPECT_NEAR(values(fit)["a"], a, 1e-9);
  EXPECT_NEAR(values(fit)["b"], b, 1e-9 * b);
  EXPECT_NEAR(fit.r_squared, 1, 1e-12);
  EXPECT_LT(fit.rms_density, 1e-12);
}

double cooper_eaton(double d0, double a1, double k1, double a2, double k2, double p) {
  return d0 / (1 - (a1 * std::exp(-k1 / p) + a2 * std::exp(-k2 / p)) * (1 - d0));
}

TEST(DensityFits, CooperEatonGivesBothTermsBack) {
  const double d0 = 0.68;
  const Curve c =
      curve_of(d0, 500e6, [&](double p) { return cooper_eaton(d0, 0.35, 8e6, 0.55, 180e6, p); });
  const DensityFit fit = fit_cooper_eaton(fit_range(c.density, c.pressure));
  EXPECT_EQ(fit.not_fitted, "");
  EXPECT_NEAR(values(fit)["a1"], 0.35, 1e-5);
  EXPECT_NEAR(values(fit)["k1"], 8e6, 1e-4 * 8e6);
  EXPECT_NEAR(values(fit)["a2"], 0.55, 1e-5);
  EXPECT_NEAR(values(fit)["k2"], 180e6, 1e-4 * 180e6);
  EXPECT_LT(fit.rms, 1e-6);
}

TEST(DensityFits, CooperEatonOfOneTermHasOne) {
  const double d0 = 0.68;
  const Curve c =
      curve_of(d0, 500e6, [&](double p) { return cooper_eaton(d0, 0.8, 60e6, 0, 1e9, p); });
  const DensityFit fit = fit_cooper_eaton(fit_range(c.density, c.pressure));
  EXPECT_NEAR(values(fit)["a1"], 0.8, 1e-4);
  EXPECT_NEAR(values(fit)["k1"], 60e6, 1e-3 * 60e6);
  EXPECT_LT(fit.rms, 1e-5);
}

// A term that is constant within the measured pressures has a k of no known value.
TEST(DensityFits, CooperEatonMarksAValueAtItsBound) {
  const double d0 = 0.68;
  const auto fit_of = [&](double k1) {
    const Curve c =
        curve_of(d0, 500e6, [&](double p) { return cooper_eaton(d0, 0.35, k1, 0.55, 180e6, p); });
    return fit_cooper_eaton(fit_range(c.density, c.pressure));
  };
  const DensityFit fit = fit_of(1.0);
  EXPECT_NEAR(values(fit)["k1"], 1e-4 * 500e6, 1);
  std::map<std::string, bool> bound;
  for (const FitParameter& p : fit.parameters) bound[p.name] = p.is_at_bound;
  EXPECT_EQ(bound, (std::map<std::string, bool>{
                       {"a1", false}, {"k1", true}, {"a2", false}, {"k2", false}}));
  for (const FitParameter& p : fit_of(8e6).parameters) EXPECT_FALSE(p.is_at_bound) << p.name;
}

// The residual is that of the noise put in: 1e-3 of the ordinate, from a generator of its own.
TEST(DensityFits, ResidualIsTheNoise) {
  const double d0 = 0.7;
  std::uint32_t state = 7;
  const auto noise = [&] {
    state = state * 1664525U + 1013904223U;
    return static_cast<double>(state >> 8) / 0x1p24 * 2 - 1;
  };
  Curve c = curve_of(
      d0, 400e6, [&](double p) { return 1 - std::exp(-(2e-9 * p + 1.3)); }, 4000);
  for (std::size_t i = 1; i < c.pressure.size(); ++i) c.pressure[i] += 1e6 * noise();
  const DensityFit fit = fit_heckel(fit_range(c.density, c.pressure));
  EXPECT_NEAR(values(fit)["K"], 2e-9, 2e-12);
  EXPECT_NEAR(fit.rms, 2e-9 * 1e6 / std::sqrt(3.0), 2e-5);  // rms of an even spread over +-1
}

// Before the punch touches, and once it goes back, nothing counts.
TEST(DensityFits, OnlyTheLoadingUnderPressureCounts) {
  const auto law = [](double p) { return 1 - std::exp(-(2.5e-9 * p + 1.4)); };
  Curve c = curve_of(0.6, 400e6, law);
  for (int i = 1; i <= 50; ++i) {  // springback: pressure gone long before the density
    c.pressure.push_back(400e6 * (1 - i / 50.0));
    c.density.push_back(c.density.back() - 1e-4);
  }
  const FitRange range = fit_range(c.density, c.pressure);
  EXPECT_EQ(range.unusable, "");
  EXPECT_EQ(range.density.size(), 199U);  // not the first, and not 0.5% of the largest pressure
  EXPECT_NEAR(values(fit_heckel(range))["K"], 2.5e-9, 1e-18);
}

void expect_refused(const Curve& c, const char* why) {
  for (const DensityFit& fit : fit_all(fit_range(c.density, c.pressure))) {
    EXPECT_THAT(fit.not_fitted, HasSubstr(why)) << fit.law;
    EXPECT_TRUE(fit.parameters.empty()) << fit.law;
  }
}

TEST(DensityFits, BadCurvesAreRefusedWithTheReason) {
  const auto law = [](double p) { return 1 - std::exp(-(2.5e-9 * p + 1.4)); };
  expect_refused({}, "no samples");
  expect_refused(curve_of(0.7, 400e6, law, 7), "7 samples under pressure, at least 8");
  expect_refused(curve_of(0.75, 400e6, [](double) { return 0.75; }), "changes by 0,");
  expect_refused(curve_of(0.75, 4e6, [](double p) { return 0.75 + 1e-10 * p; }),
                 "changes by 0.0004");
  Curve cycles = curve_of(0.7, 400e6, law);
  cycles.density[100] = 0.7;
  expect_refused(cycles, "not a single loading");
  Curve constant = curve_of(0.7, 400e6, law);
  for (double& p : constant.pressure) p = 1e6;
  expect_refused(constant, "the pressure is constant");
  Curve broken = curve_of(0.7, 400e6, law);
  broken.pressure[3] = std::nan("");
  expect_refused(broken, "not finite");
  Curve pulled = curve_of(0.7, 400e6, law);
  for (double& p : pulled.pressure) p = -p;
  expect_refused(pulled, "0 samples under pressure");
}

// Each law has bounds of its own.
TEST(DensityFits, PressureThatFallsWhileTheDensityGrowsHasNoParameters) {
  const Curve falling{{0.70, 0.71, 0.72, 0.73, 0.74, 0.75, 0.76, 0.77, 0.78, 0.79},
                      {0, 9e6, 8e6, 7e6, 6e6, 5e6, 4e6, 3e6, 2e6, 1e6}};
  const FitRange range = fit_range(falling.density, falling.pressure);
  EXPECT_THAT(fit_heckel(range).not_fitted, HasSubstr("no yield pressure"));
  EXPECT_THAT(fit_kawakita(range).not_fitted, HasSubstr("a and b"));
}

// Kawakita: pressure at V0 itself has no place in the law.
TEST(DensityFits, PressureAtTheInitialDensityIsNothingForKawakita) {
  Curve c = curve_of(0.8, 400e6, [](double p) { return 1 - std::exp(-(2.5e-9 * p + 1.7)); });
  c.density[1] = c.density[0] = 0.8;
  c.pressure[1] = 50e6;
  EXPECT_THAT(fit_kawakita(fit_range(c.density, c.pressure)).not_fitted,
              HasSubstr("pressure at the initial density 0.8"));
}

}  // namespace
}  // namespace pulvis
