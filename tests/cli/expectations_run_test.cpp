// Scenes that say themselves what must hold, run by the program: the extreme ones (docs/stability.md; those with
// `slow` in their name are left to bench/stability.py) and those of the AFM (docs/afm.md). bench/nightly.py runs all of the
// AFM's.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include "tests/helpers/paths.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;

// tests/physics/afm holds them to the same laws, more closely.
const std::set<std::string> elsewhere{"plastic-probe", "hertz-ball",      "bump",
                                      "force-curve",   "jkr-force-curve", "incline-frictionless"};
// The raster takes minutes; of the others a sibling is run here: another slope, metal or beam under the same systems.
const std::set<std::string> at_night{"raster",
                                     "loop-v-0",
                                     "loop-v-12.5",
                                     "loop-v+14-kept-height",
                                     "loop-v-12.5-kept-height",
                                     "loop-beam-0",
                                     "loop-beam-12.5",
                                     "ogletree-0",
                                     "colloid-cu-plastic",
                                     "bump-kept-height"};

// Scenes of a folder below scenes/, without those that are run elsewhere.
std::vector<std::string> fast_scenes(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(paths::source_dir() + "/scenes/" + folder)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".toml" && name.find("slow") == std::string::npos &&
        !elsewhere.contains(name) && !at_night.contains(name))
      names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

// The program's exit code says whether all expectations of the scene were met.
void run_scene(const std::string& scene, const std::string& options) {
  const fs::path place = fs::temp_directory_path() / ("pulvis-expect-" + std::to_string(getpid()));
  fs::create_directories(place);
  const std::string at = place.string();
  const int status = std::system((std::string("'") + paths::program() + "' run '" +
                                  paths::source_dir() + "/scenes/" + scene + ".toml' --threads 1 " +
                                  options + " -o '" + at + "/run' > '" + at + "/out' 2>&1")
                                     .c_str());
  std::ostringstream printed;
  printed << std::ifstream(place / "out").rdbuf();
  EXPECT_EQ(WEXITSTATUS(status), 0) << printed.str();
  fs::remove_all(place);
}

class Extreme : public testing::TestWithParam<std::string> {};
TEST_P(Extreme, MeetsItsExpectations) {
  run_scene("extreme/" + GetParam(), "--set output.frames=1");
}

class AfmScene : public testing::TestWithParam<std::string> {};
TEST_P(AfmScene, MeetsItsExpectations) { run_scene("afm/" + GetParam(), ""); }

std::string name_of(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Scenes, Extreme, testing::ValuesIn(fast_scenes("extreme")), name_of);
INSTANTIATE_TEST_SUITE_P(Scenes, AfmScene, testing::ValuesIn(fast_scenes("afm")), name_of);

}  // namespace
}  // namespace pulvis
