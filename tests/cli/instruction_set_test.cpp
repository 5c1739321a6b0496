// The core library is built for several instruction sets, and the library of the C language has several of its
// functions: all of them give the same bits.
#include "engine/instruction_set.hpp"
#include "tests/helpers/paths.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace pulvis {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// The library's variants, as folders below that of the portable one, that this processor can run.
std::vector<std::string> variants() {
  std::vector<std::string> folders{"."};
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    folders.emplace_back("glibc-hwcaps/x86-64-v3");
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512cd"))
    folders.emplace_back("glibc-hwcaps/x86-64-v4");
  std::erase_if(folders, [](const std::string& folder) {
    return !fs::exists(fs::path(paths::libraries()) / folder / "libpulvis_core.so");
  });
  return folders;
}

fs::path own_place() {
  return fs::temp_directory_path() / ("pulvis-variant-" + std::to_string(getpid()));
}

struct Ended {
  json summary;
  std::string history;
};

// `environment`: assignments before the command.
Ended run(const std::string& environment, const std::string& scene, const std::string& options,
          int code = 0) {
  const fs::path folder = own_place() / "run";
  const std::string command = environment + " '" + paths::program() + "' run '" +
                              paths::source_dir() + "/scenes/" + scene + "' " + options + " -o '" +
                              folder.string() + "' > /dev/null 2>&1";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), code) << command;
  Ended ended{json::parse(std::ifstream(folder / "summary.json")), {}};
  std::ostringstream history;
  history << std::ifstream(folder / "history.csv").rdbuf();
  ended.history = history.str();
  fs::remove_all(own_place());
  return ended;
}

// Runs a scene with one variant alone where the loader looks first.
json summary_with(const std::string& variant, const std::string& scene, const std::string& options,
                  int code = 0) {
  const fs::path place = own_place() / "lib";
  fs::remove_all(place);
  fs::create_directories(place);
  fs::create_symlink(fs::path(paths::libraries()) / variant / "libpulvis_core.so",
                     place / "libpulvis_core.so");
  return run("LD_LIBRARY_PATH='" + place.string() + "'", scene, "--threads 1 " + options, code)
      .summary;
}

class InstructionSets : public testing::TestWithParam<std::string> {};

TEST_P(InstructionSets, GiveTheSameBits) {
  std::vector<std::string> names, hashes;
  double pressed = 0;
  for (const std::string& variant : variants()) {
    // Discs that flow, rub and are damped.
    const json summary = summary_with(variant, "compaction/regular-25.toml",
                                      "--set stage.press.duration=80us " + GetParam());
    names.push_back(summary["instruction_set"]);
    hashes.push_back(summary["state_hash"]);
    pressed = summary["stress_ratio/axial"];
    EXPECT_EQ(hashes.back(), hashes.front()) << names.back();
  }
  EXPECT_GT(pressed, 0.3);  // of the yield stress: contacts flow
  EXPECT_EQ(names.front(), "portable");
  // The loader takes the best of them by itself.
  EXPECT_EQ(names.back(), instruction_set());
}

INSTANTIATE_TEST_SUITE_P(Formulations, InstructionSets,
                         testing::Values("", "--set 'element.formulation=\"four-point\"'"),
                         [](const auto& set) {
                           return set.param.empty() ? "OnePoint" : "FourPoint";
                         });

// Glue of drawn strengths, stopped while it breaks: some points are gone, others damaged.
TEST(InstructionSetsOfBonds, BreakToTheSameBits) {
  constexpr int stopped = 130;
  const std::string glue =
      "--set 'stage.pull.duration=30 us' --set 'bond[0].weibull_modulus=5' --set "
      "'stage.pull.move.head.displacement=[\"0.012 mm\", \"0.004 mm\"]' --stop-after ";
  std::vector<std::string> hashes;
  for (const std::string& variant : variants())
    for (const char* steps : {"1700", "1860"})
      hashes.push_back(
          summary_with(variant, "bonds/sheared-blocks.toml", glue + steps, stopped)["state_hash"]);
  ASSERT_GE(hashes.size(), 2U);
  EXPECT_NE(hashes[0], hashes[1]);
  for (std::size_t i = 2; i < hashes.size(); ++i) EXPECT_EQ(hashes[i], hashes[i - 2]) << i;
}

struct Family {
  const char *name, *scene, *options;
};
void PrintTo(const Family& family, std::ostream* out) { *out << family.name; }

// On a processor without fused multiply-adds glibc takes other sines, exponentials and powers, and the loader the
// portable variant. A few steps: such functions have their part in what is made at the start and in levers,
// and a multiply-add is a long call there.
class WithoutFma : public testing::TestWithParam<Family> {};

TEST_P(WithoutFma, AScenesBitsAreTheSame) {
  constexpr int stopped = 130;
  const auto& [name, scene, options] = GetParam();
  const Ended with = run("", scene, options, stopped);
  const Ended without =
      run("GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2", scene, options, stopped);
  EXPECT_EQ(without.summary["instruction_set"], "portable");
  EXPECT_EQ(with.summary["state_hash"], without.summary["state_hash"]);
  EXPECT_EQ(with.history, without.history);
  EXPECT_GT(std::ranges::count(with.history, '\n'), 1);
}

constexpr const char* rough =
    "--set tool.target.relief=rough --set 'tool.target.ra=0.3 mm' --set "
    "'tool.target.correlation_length=3 mm' --set 'tool.target.rounding=0.65 mm' --stop-after 10";

INSTANTIATE_TEST_SUITE_P(
    Families, WithoutFma,
    testing::Values(Family{"RandomDiscs", "compaction/random-100.toml", "--stop-after 10"},
                    Family{"RandomSizes", "studies/scenes/random-sizes.toml", "--stop-after 5"},
                    Family{"RandomShapes", "studies/scenes/random-shapes.toml", "--stop-after 5"},
                    Family{"RoughTarget", "studies/scenes/shear-regular-held.toml", rough},
                    Family{"Ellipse", "basic/ellipse-plates.toml", "--stop-after 10"},
                    Family{"TracedGrain", "basic/traced-grain.toml", "--stop-after 10"},
                    Family{"TurnedSquare", "extreme/corner-in-rough-valley-slow.toml",
                           "--stop-after 20"},
                    Family{"BeamOnASlope", "afm/loop-beam+14.toml", "--stop-after 4"},
                    Family{"V", "afm/loop-v-12.5.toml", "--stop-after 4"},
                    Family{"ColloidProbe", "afm/colloid-cu.toml", "--stop-after 2"},
                    Family{"HeightMap", "afm/raster.toml", "--stop-after 2"},
                    Family{"Waves", "afm/sinusoid.toml", "--stop-after 2"},
                    Family{"Jkr", "afm/jkr-force-curve.toml", "--stop-after 4"}),
    [](const auto& family) { return family.param.name; });

}  // namespace
}  // namespace pulvis
