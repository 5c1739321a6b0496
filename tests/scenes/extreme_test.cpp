// The extreme scenes, run by the program: each says itself what must hold (docs/stability.md). Those with
// `slow` in their name are left to bench/stability.py.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace pulvis {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> fast_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(PULVIS_SOURCE_DIR "/scenes/extreme"))
    if (entry.path().stem().string().find("slow") == std::string::npos)
      names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

class Extreme : public testing::TestWithParam<std::string> {};

TEST_P(Extreme, MeetsItsExpectations) {
  const std::string& name = GetParam();
  const fs::path place =
      fs::temp_directory_path() / ("pulvis-extreme-" + std::to_string(getpid()) + name);
  fs::create_directories(place);
  const std::string at = place.string();
  const int status = std::system(
      ("'" PULVIS_PROGRAM "' run '" PULVIS_SOURCE_DIR "/scenes/extreme/" + name +
       ".toml' --threads 1 --set output.frames=1 -o '" + at + "/run' > '" + at + "/out' 2>&1")
          .c_str());
  std::ostringstream printed;
  printed << std::ifstream(place / "out").rdbuf();
  EXPECT_EQ(WEXITSTATUS(status), 0) << printed.str();
  fs::remove_all(place);
}

std::string name_of(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Scenes, Extreme, testing::ValuesIn(fast_scenes()), name_of);

}  // namespace
}  // namespace pulvis
