// Compression curves: records of known laws give them back within the interval that is told, the interval holds what
// it says over many noisy curves, and records that are no single loading are refused.
#include "cli/laboratory/lab_compression.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "scenes/results/density_fit_errors.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis::lab {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

const fs::path lab_folder = fs::path(paths::source_dir()) / "scenes/lab";

struct Reduced {
  Settings settings;
  Compliance machine;
  std::map<std::string, ReducedCurve> curves;
};

Reduced shipped_curves() {
  Reduced all{load_settings(lab_folder / "press.toml", {}).settings, {}, {}};
  const CompressionSpec& c = all.settings.compression;
  all.machine = compliance_of(read_press(lab_folder / c.empty, all.settings), c);
  for (const CurveSpec& spec : all.settings.curves)
    all.curves[spec.name] = reduce_curve(read_press(lab_folder / spec.press, all.settings), spec,
                                         all.settings, all.machine);
  return all;
}

Measured parameter(const ReducedCurve& curve, const std::string& law, const std::string& name) {
  for (const LawFit& fit : curve.laws)
    for (const Measured& p : fit.parameters)
      if (fit.fit.law == law && p.name == name) return p;
  ADD_FAILURE() << law << " " << name;
  return {};
}

// Within the interval, which is no wider than `share` of the truth.
void expect_found(const Measured& found, double truth, double share) {
  EXPECT_NEAR(found.value, truth, found.half_width(0.95)) << found.name;
  EXPECT_LT(found.half_width(0.95), share * truth) << found.name;
  EXPECT_GT(found.half_width(0.95), 0) << found.name;
}

TEST(LabCompression, DensitiesThatNoCompactHasAreRefused) {
  const auto refusal = [](const char* mass) {
    const Settings settings =
        load_settings(lab_folder / "press.toml", {std::string("curve[0].mass=") + mass}).settings;
    const CurveSpec& spec = settings.curves.front();
    const PressRecord record = read_press(lab_folder / spec.press, settings);
    return message_of([&] { reduce_curve(record, spec, settings, machine_of(settings)); });
  };
  EXPECT_THAT(refusal("11.5 g"),
              AllOf(HasSubstr("press-heckel.csv"), HasSubstr("1.038 without load"),
                    HasSubstr("check mass, die.solid_density")));
  EXPECT_THAT(refusal("94.88 g"), HasSubstr("relative density is 8.5"));
  const Settings settings =
      load_settings(lab_folder / "press.toml", {"curve[0].mass=13 g"}).settings;
  const CurveSpec& spec = settings.curves.front();
  PressRecord loading = read_press(lab_folder / spec.press, settings);
  const auto until = std::ranges::max_element(loading.force) - loading.force.begin() + 1;
  for (auto* values : {&loading.time, &loading.force, &loading.displacement})
    if (!values->empty()) values->resize(static_cast<std::size_t>(until));
  EXPECT_THAT(message_of([&] { reduce_curve(loading, spec, settings, machine_of(settings)); }),
              HasSubstr("under the largest force, allowed: up to 1.1"));
}

TEST(LabCompression, TheShippedRecordsGiveTheirLawsBack) {
  const Reduced all = shipped_curves();
  std::ifstream file(lab_folder / "press-truth.json");
  const auto truth = nlohmann::json::parse(file);
  const auto& heckel = truth["curves"]["heckel"];
  const ReducedCurve& h = all.curves.at("heckel");
  expect_found(parameter(h, "heckel", "yield_pressure"),
               heckel["yield_pressure"].get<double>() * 1e6, 0.03);
  expect_found(parameter(h, "heckel", "A"), heckel["A"], 0.01);
  const auto& kawakita = truth["curves"]["kawakita"];
  expect_found(parameter(all.curves.at("kawakita"), "kawakita", "a"), kawakita["a"], 0.01);
  expect_found(parameter(all.curves.at("kawakita"), "kawakita", "b"),
               kawakita["b"].get<double>() / 1e6, 0.02);
  const auto& cooper = truth["curves"]["cooper-eaton"];
  for (const char* name : {"a1", "a2"})
    expect_found(parameter(all.curves.at("cooper-eaton"), "cooper_eaton", name), cooper[name],
                 0.05);
  for (const char* name : {"k1", "k2"})
    expect_found(parameter(all.curves.at("cooper-eaton"), "cooper_eaton", name),
                 cooper[name].get<double>() * 1e6, 0.15);
  for (const auto& [name, curve] : all.curves) {
    ASSERT_TRUE(curve.unloading && curve.unloading->modulus) << name;
    EXPECT_NEAR(*curve.unloading->modulus, 45e9, 0.03 * 45e9) << name;
    EXPECT_NEAR(curve.unloading->recovery, 396.1e6 / 45e9, 5e-4) << name;
  }
}

TEST(LabCompression, TheEmptyPressTellsWhatItGives) {
  const Reduced all = shipped_curves();
  std::ifstream file(lab_folder / "press-truth.json");
  const auto give = nlohmann::json::parse(file)["give_mm"];
  EXPECT_NEAR(*all.machine.meeting, 31.7e-3, 1e-6);
  for (const double force : {5e3, 20e3, 45e3, 69e3}) {
    const double truth =
        1e-3 * force *
        (give[0].get<double>() + force * (give[1].get<double>() + force * give[2].get<double>()));
    EXPECT_NEAR(all.machine.at(force), truth, 0.6e-6) << force;  // of a noise of 1 um
  }
}

// Within the pressures from 200 MPa on a term of the fit is constant: its k is at the end of its range.
TEST(LabCompression, AValueAtItsBoundHasNoInterval) {
  const Settings settings =
      load_settings(lab_folder / "press.toml", {"compression.fit_from=200 MPa"}).settings;
  const auto& spec = *std::ranges::find(settings.curves, "kawakita", &CurveSpec::name);
  const ReducedCurve curve = reduce_curve(read_press(lab_folder / spec.press, settings), spec,
                                          settings, machine_of(settings));
  const Measured k1 = parameter(curve, "cooper_eaton", "k1");
  EXPECT_NEAR(k1.value, 1e-4 * curve.curve.pressure[curve.curve.peak], 1);
  EXPECT_FALSE(k1.has_interval());
  EXPECT_EQ(k1.contributions.size(), 6U);
  for (const Contribution& c : k1.contributions) EXPECT_TRUE(std::isinf(c.error)) << c.source;
  for (const char* name : {"a1", "a2", "k2"})
    EXPECT_TRUE(parameter(curve, "cooper_eaton", name).has_interval()) << name;
  for (const OverCurves& over : over_curves({curve})) EXPECT_NE(over.name, "k1");
}

TEST(LabCompression, WithoutTakingThePressOutTheYieldPressureIsWrong) {
  const Reduced all = shipped_curves();
  CurveSpec spec = all.settings.curves.front();
  spec.fill_height = 31.7e-3;
  const ReducedCurve rigid = reduce_curve(read_press(lab_folder / spec.press, all.settings), spec,
                                          all.settings, Compliance{});
  const Measured found = parameter(rigid, "heckel", "yield_pressure");
  EXPECT_GT(std::abs(found.value - 420e6), 0.15 * 420e6);
}

// 95% intervals hold the truth in 95 of 100 curves: of 400, between 367 and 393 (three deviations).
TEST(LabCompression, IntervalsHoldWhatTheySay) {
  std::mt19937 source(3);
  std::normal_distribution<double> noise(0, 2e-4);
  constexpr double yield = 420e6, a = 1.05, d0 = 0.52, ka = 0.43, kb = 0.021e-6;
  int heckel = 0, kawakita = 0;
  for (int curve = 0; curve < 400; ++curve) {
    std::vector<double> pressure, one, other;
    for (int i = 0; i < 200; ++i) {
      const double p = 100e6 + 1.5e6 * i;
      pressure.push_back(p);
      one.push_back(1 - std::exp(-(p / yield + a)) + noise(source));
      other.push_back(d0 / (1 - ka * kb * p / (1 + kb * p)) + noise(source));
    }
    const auto holds = [&](const std::vector<double>& density, auto fitted, std::size_t of,
                           double truth) {
      const FitRange range = range_between(d0, density, pressure, 0, 1e12);
      const DensityFit fit = fitted(range);
      const FitErrors errors = fit_errors(fit, range);
      const Measured found{
          "", "", fit.parameters[of].value, errors.freedom, {{"scatter", errors.standard[of]}}};
      return std::abs(found.value - truth) <= found.half_width(0.95) ? 1 : 0;
    };
    heckel += holds(one, fit_heckel, 2, yield);
    kawakita += holds(other, fit_kawakita, 0, ka);
  }
  EXPECT_GE(heckel, 367);
  EXPECT_LE(heckel, 393);
  EXPECT_GE(kawakita, 367);
  EXPECT_LE(kawakita, 393);
}

// A powder of Heckel's law and the empty press, each with its own noise; nothing else is uncertain.
struct NoisyPress {
  std::mt19937 source{5};
  std::normal_distribution<double> noise{0, 2e-6};  // m
  static constexpr double yield = 420e6, a = 1.05, meeting = 30e-3, mass = 9e-3;

  // m, of the powder at a force.
  static auto height(const DieSpec& die) {
    return [&die](double force) {
      const double density = 1 - std::exp(-(force / die.area() / yield + a));
      return mass / (die.solid_density * die.area() * density);
    };
  }

  PressRecord record(const auto& height) {
    PressRecord made;
    for (int i = 0; i <= 300; ++i) {
      const double force = 70e3 * i / 300;
      made.lines.push_back(i + 2);
      made.time.push_back(0.1 * i);
      made.force.push_back(force);
      made.displacement.push_back(meeting - height(force) + 12e-9 * force - 6e-14 * force * force +
                                  noise(source));
    }
    return made;
  }
};

// Every curve has an empty press of its own: of 200, between 181 and 199 intervals hold the truth (three deviations).
TEST(LabCompression, IntervalsKnowTheNoiseOfTheEmptyPress) {
  NoisyPress press;
  const Settings settings =
      load_settings_text(
          "[die]\nsolid_density = \"7990 kg/m^3\"\n[compression]\nempty = \"e.csv\"\n"
          "empty_degree = 2\nfit_from = \"100 MPa\"\n[[curve]]\nname = \"a\"\npress = \"p.csv\"\n"
          "mass = \"9 g\"\ninitial_density = 0.5\n",
          "reduce.toml", {})
          .settings;
  const auto height = NoisyPress::height(settings.die);
  int yields = 0, without = 0;
  for (int i = 0; i < 200; ++i) {
    const PressRecord empty = press.record([](double) { return 0.0; });
    const Compliance machine = compliance_of(empty, settings.compression);
    const ReducedCurve curve =
        reduce_curve(press.record(height), settings.curves.front(), settings, machine);
    Measured found = parameter(curve, "heckel", "yield_pressure");
    const double error = std::abs(found.value - NoisyPress::yield);
    yields += error <= found.half_width(0.95) ? 1 : 0;
    found.contributions.pop_back();
    without += error <= found.half_width(0.95) ? 1 : 0;
  }
  EXPECT_GE(yields, 181);
  EXPECT_LE(yields, 199);
  EXPECT_LT(without, 181);  // or the test could not tell
}

// Without an empty press: all heights follow from the last sample, with its noise of 2 um.
TEST(LabCompression, IntervalsKnowTheNoiseOfTheLastSample) {
  NoisyPress press;
  const Settings settings =
      load_settings_text(
          "[die]\nsolid_density = \"7990 kg/m^3\"\n[compression]\nfit_from = \"100 MPa\"\n"
          "[[curve]]\nname = \"a\"\npress = \"p.csv\"\nmass = \"9 g\"\nfinal_height = \"1 mm\"\n"
          "initial_density = 0.5\n",
          "reduce.toml", {})
          .settings;
  const Compliance machine{{12e-9, -6e-14}, {}, 0, 0, 0, {}};
  CurveSpec spec = settings.curves.front();
  spec.final_height = NoisyPress::height(settings.die)(70e3);
  int with = 0, without = 0;
  for (int i = 0; i < 200; ++i) {
    const PressRecord record = press.record(NoisyPress::height(settings.die));
    EXPECT_NEAR(displacement_noise(record), 2e-6, 0.6e-6);
    Measured found =
        parameter(reduce_curve(record, spec, settings, machine), "heckel", "yield_pressure");
    const double error = std::abs(found.value - NoisyPress::yield);
    with += error <= found.half_width(0.95) ? 1 : 0;
    ASSERT_EQ(found.contributions.back().source, "last sample");
    found.contributions.pop_back();
    without += error <= found.half_width(0.95) ? 1 : 0;
  }
  EXPECT_GE(with, 181);
  EXPECT_LE(with, 199);
  EXPECT_LT(without, 100);
}

TEST(LabCompression, ASimulationIsComparedWhereBothHaveBeen) {
  const Reduced all = shipped_curves();
  const ReducedCurve& measured = all.curves.at("heckel");
  SimulatedCompression twice{"twice", {}, {}};
  for (double d = 0.75; d < 0.85; d += 0.005) {
    twice.density.push_back(d);
    twice.pressure.push_back(2 * 420e6 * (std::log(1 / (1 - d)) - 1.05));
  }
  const CompressionMisfit misfit = misfit_of(twice, measured);
  EXPECT_EQ(misfit.not_compared, "");
  EXPECT_NEAR(std::exp(misfit.log_pressure), 2, 0.02);
  EXPECT_NEAR(misfit.rms_log_pressure, std::log(2.0), 0.01);
  EXPECT_GT(misfit.rms_density, 0.03);
  for (double& d : twice.density) d -= 0.5;
  EXPECT_THAT(misfit_of(twice, measured).not_compared, HasSubstr("simulated from 0.25"));
}

TEST(LabCompression, RefusesWhatIsNoSingleLoading) {
  const Reduced all = shipped_curves();
  const CurveSpec& spec = all.settings.curves.front();
  const PressRecord whole = read_press(lab_folder / spec.press, all.settings);
  const auto refusal = [&](const PressRecord& record, const Compliance& machine) {
    return message_of([&] { reduce_curve(record, spec, all.settings, machine); });
  };
  PressRecord cycled = whole;
  for (std::size_t i = 400; i < 420; ++i) cycled.force[i] = 30e3;
  EXPECT_THAT(refusal(cycled, all.machine),
              HasSubstr("not a single loading, allowed: a drop of 0.03"));
  Compliance weak = all.machine;
  weak.largest_force = 60e3;
  EXPECT_THAT(refusal(whole, weak),
              HasSubstr("beyond the range of the record of the empty press, allowed: up"));
  Compliance none = all.machine;
  none.meeting = 20e-3;
  EXPECT_THAT(refusal(whole, none), HasSubstr("mm high, allowed: > 0"));
}

TEST(LabCompression, SettingsAreCheckedBeforeAnyRecord) {
  const auto refusal = [](const std::string& text) {
    return message_of([&] { load_settings_text(text, "reduce.toml", {}); });
  };
  const std::string curve = "[[curve]]\nname = \"a\"\npress = \"p.csv\"\nmass = \"8 g\"\n";
  const std::string die = "[die]\nsolid_density = \"7990 kg/m^3\"\n";
  EXPECT_EQ(refusal(die + curve + "fill_height = \"12 mm\"\n"), "");
  EXPECT_THAT(refusal(die + curve), HasSubstr("curve[0]: has no height, allowed: fill_height"));
  EXPECT_THAT(refusal(curve + "fill_height = \"12 mm\"\n"),
              HasSubstr("die.solid_density: is not given, allowed: > 0 kg/m^3"));
  EXPECT_THAT(refusal(die + curve + "fill_height = \"12 mm\"\nfinal_height = \"8 mm\"\n"),
              HasSubstr("curve[0].final_height: is given together with fill_height"));
  EXPECT_THAT(refusal(die + curve +
                      "fill_height = \"12 mm\"\n[compression]\nempty = \"e.csv\"\n"
                      "compliance = [1e-9]\n"),
              HasSubstr("compression.compliance: is given together with compression.empty"));
  EXPECT_THAT(refusal(die + curve +
                      "fill_height = \"12 mm\"\n[[run]]\npress = \"p\"\nlogger = "
                      "\"l\"\n"),
              HasSubstr("allowed: records of one kind in one file"));
}

}  // namespace
}  // namespace pulvis::lab
