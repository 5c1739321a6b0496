// The core library is built for several instruction sets: all of them give the same bits.
#include "engine/instruction_set.hpp"
#include "tests/paths.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

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

// Runs a scene with one variant alone where the loader looks first. Discs that flow, rub and are damped.
json summary_with(const std::string& variant, const std::string& options) {
  const fs::path place = fs::temp_directory_path() / ("pulvis-variant-" + std::to_string(getpid()));
  fs::remove_all(place);
  fs::create_directories(place / "lib");
  fs::create_symlink(fs::path(paths::libraries()) / variant / "libpulvis_core.so",
                     place / "lib" / "libpulvis_core.so");
  const std::string command = "LD_LIBRARY_PATH='" + (place / "lib").string() + "' '" +
                              paths::program() + "' run '" + paths::source_dir() +
                              "/scenes/compaction/regular-25.toml' --set "
                              "stage.press.duration=80us --threads 1 " +
                              options + " -o '" + (place / "run").string() + "' > /dev/null 2>&1";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 0) << command;
  json summary = json::parse(std::ifstream(place / "run" / "summary.json"));
  fs::remove_all(place);
  return summary;
}

class InstructionSets : public testing::TestWithParam<std::string> {};

TEST_P(InstructionSets, GiveTheSameBits) {
  std::vector<std::string> names, hashes;
  double pressed = 0;
  for (const std::string& variant : variants()) {
    const json summary = summary_with(variant, GetParam());
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

}  // namespace
}  // namespace pulvis
