// The whole way from a simulated microscope's volts to the friction that was put into it: force curve, loops on two
// slopes and on a flat sample in volts, and the calibrated lever; nothing else is told.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "cli/laboratory/lab_settings.hpp"
#include "cli/laboratory/volts/volts_reduction.hpp"
#include "scenes/lever/afm_loop.hpp"
#include "tests/helpers/afm_run.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> gains{"detector.normal_gain=3e4 V/rad",
                                     "detector.lateral_gain=2e5 V/rad"};
constexpr double pull_off = 20e-9, friction = 0.2;

// Normal volts over the second half of both ways of a scan, less those of the free lever, which are none.
double normal_volts(const AfmHistory& h, int action) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < h.rows.size(); ++i) {
    const double at = h.times[i] - action;
    if ((at < 0.25 || at > 0.5 + 1e-9) && (at < 0.75 || at > 1 + 1e-9)) continue;
    sum += h.value(i, "detector/normal");
    ++count;
  }
  return sum / count;
}

// Loops of a scene as lines: [slope,] load, half-width, offset in volts, with an uncertainty of 1e-4 of the half-width.
std::string loops_of(const Scene& scene, const std::string& slope) {
  const AfmHistory h = history_of(scene);
  std::string text;
  for (const FrictionLoop& loop : friction_loops(scene, h)) {
    EXPECT_TRUE(loop.full());
    text += fmt::format("{}{:.12g},{:.12g},{:.12g},{:.3g},{:.3g}\n", slope,
                        std::abs(normal_volts(h, loop.action)), loop.volts_half_width,
                        loop.volts_offset, 1e-4 * std::abs(loop.volts_half_width),
                        1e-4 * std::abs(loop.volts_half_width));
  }
  return text;
}

std::string surface(double degrees, double mu) {
  return inclined_plane(degrees, mu) + "pull_off = \"20 nN\"\nadhesion_range = \"1 nm\"\n";
}

std::string way(const char* kind, const char* distance, int increments) {
  return fmt::format("[[action]]\nkind = \"{}\"\ndistance = \"{}\"\nincrements = {}\n", kind,
                     distance, increments);
}

// Displacement of the scanner against normal volts, from free to pressed and back.
std::string volts_curve(const AfmHistory& h) {
  std::string text;
  for (std::size_t i = 0; i < h.rows.size(); ++i)
    if (h.times[i] > 1 + 1e-9)
      text += fmt::format(
          "{:.12g},{:.12g}\n", h.value(i, "scanner/z"),
          std::abs(h.value(i, "detector/normal")) * (h.value(i, "probe/force_z") < 0 ? -1 : 1));
  return text;
}

class VoltsOfRun : public ::testing::Test {
 protected:
  VoltsOfRun() : place(fs::temp_directory_path() / fmt::format("pulvis-volts-run-{}", getpid())) {
    fs::create_directories(place);
  }
  ~VoltsOfRun() override { fs::remove_all(place); }
  void put(const char* name, const std::string& text) const { std::ofstream(place / name) << text; }
  fs::path place;
};

TEST_F(VoltsOfRun, GivesBackTheFrictionThatWasPutIn) {
  const std::string lever = coarse_beam;
  const Scene curve_scene = afm_scene(
      lever + "[surface]\nshape = \"plane\"\npull_off = \"20 nN\"\nadhesion_range = \"1 nm\"\n" +
          way("retract", "150 nm", 2) + way("press", "400 nm", 80) + way("retract", "300 nm", 30) +
          way("retract", "40 nm", 80) + way("retract", "60 nm", 12),
      gains);
  AfmSimulation simulation(curve_scene);
  const Calibration c = simulation.calibrate();
  put("curve.csv", "displacement [m],normal [V]\n" + volts_curve(history_of(simulation)));
  const std::string loads = press_and_scan(12, "60 nN") + press_and_scan(12, "100 nN");
  put("wedge.csv",
      "slope [deg],load [V],half_width [V],offset [V],half_width_error [V],offset_error [V]\n" +
          loops_of(afm_scene(lever + inclined_plane(14, 0.1) + loads, gains), "14,") +
          loops_of(afm_scene(lever + inclined_plane(-12.5, 0.1) + loads, gains), "-12.5,"));
  put("flat.csv",
      "load [V],half_width [V],offset [V],half_width_error [V],offset_error [V]\n" +
          loops_of(afm_scene(lever + surface(0, friction) + press_and_scan(16, "40 nN") +
                                 press_and_scan(16, "80 nN") + press_and_scan(16, "120 nN"),
                             gains),
                   ""));
  put("summary.json",
      fmt::format(R"({{"calibration": {{"k_n": {}, "k_l": {}, "arm": {}, "share_twist": {}}}}})",
                  c.normal_stiffness, c.lateral_stiffness, c.arm, c.twist_share));
  put("reduce.toml",
      "[afm]\nloops = \"flat.csv\"\ndraws = 1000\n[force_curves]\nhard = "
      "\"curve.csv\"\n[lever]\ncalibration = "
      "\"summary.json\"\nk_n_error = 0.03\n[wedge]\nloops = \"wedge.csv\"\n");
  const lab::Settings s =
      lab::load_settings(place / "reduce.toml", {"force_curves.free=0.15"}).settings;
  const volts::Reduced all =
      volts::reduce(s.volts, {place / s.wedge.loops, {}, s.wedge.skip}, place, 0.95);
  const volts::Outcome& out = all.result.nominal;
  EXPECT_NEAR(out.friction / friction, 1, 0.005);
  // A bent lever twists less for the detector: 0.2 % for each 40 nN here, which the line's zero shows tenfold.
  EXPECT_NEAR(*out.adhesion_of_line / pull_off, 1, 0.03);
  EXPECT_NEAR(out.adhesion / pull_off, 1, 0.005);
  EXPECT_NEAR(out.normal / (c.normal_stiffness * std::abs(c.normal_invols)), 1, 0.005);
  EXPECT_NEAR(out.lateral * 2e5 * std::abs(c.lateral.spot.lateral), 1, 0.01);
}

// What a test probe on the same lever says of the lateral detector, from both calibrations alone: F/V of the lever by
// the slope of a probe that is twice as tall.
TEST(TestProbe, TellsTheLateralSensitivityOfAnotherTip) {
  const auto with_height = [](const char* height) {
    return calibration_of(beam_with_tip,
                          {"detector.lateral_gain=2e5 V/rad", std::string("tip.height=") + height});
  };
  const Calibration lever = with_height("12.6 um"), probe = with_height("25 um");
  volts::Measured measured;
  measured.lever = {lever.normal_stiffness, lever.lateral_stiffness, lever.arm, lever.twist_share};
  measured.hard.slope = {1e7, 0};
  measured.side = lab::Mean{1 / std::abs(probe.lateral_invols), 0};
  measured.loops.loops = {{0, 1, 0.1, 0, 0.001, 0.001, 0, {}, {}}};
  volts::VoltsSpec spec;
  spec.afm.lateral = volts::LateralMethod::test_probe;
  spec.lever.k_n_error = spec.lever.k_l_error = 0.0;
  spec.test_probe.arm = probe.arm;
  spec.test_probe.twist_share = probe.twist_share;
  spec.test_probe.intensity_ratio = 1;
  const volts::Model model(measured, spec);
  const double told = model.evaluate(model.values()).lateral;
  EXPECT_NEAR(told * 2e5 * std::abs(lever.lateral.spot.lateral), 1, 0.01);
  // Without the shares it would be wrong: half of the tip's way is bending here.
  EXPECT_GT(std::abs(lever.twist_share - probe.twist_share), 0.1);
}

}  // namespace
}  // namespace pulvis
