// Every switch of [output] records something, in two and in three dimensions: a key of the plane that three dimensions inherit
// by mistake would be accepted there, and do nothing.
#include <gmock/gmock.h>

#include <filesystem>

#include "scenes/keys/tables.hpp"
#include "scenes/read.hpp"
#include "scenes/results/results.hpp"
#include "scenes/simulation.hpp"
#include "tests/helpers/paths.hpp"

namespace pulvis::keys {
namespace {

// Names of the series and fields of a run.
std::vector<std::string> recorded(const std::string& scene, const std::string& override) {
  const auto file = std::filesystem::path(paths::source_dir()) / "scenes" / scene;
  const LoadedScene loaded = load_scene(file, {override});
  Simulation simulation(loaded.scene);
  const Results results(loaded.scene, simulation.world());
  std::vector<std::string> names;
  for (const SeriesInfo& series : results.series()) names.push_back(series.name);
  for (const FieldInfo& field : results.fields()) names.push_back("field " + field.name);
  return names;
}

void expect_all_record(int dimension, const std::string& scene) {
  int switches = 0;
  for (const auto& key : schema::find_table("output", schema::scene_language(dimension))->keys) {
    if (key.kind != schema::Kind::flag) continue;
    ++switches;
    const std::string name = "output." + key.name;
    EXPECT_NE(recorded(scene, name + "=true"), recorded(scene, name + "=false"))
        << scene << ": " << name << " = true records nothing";
  }
  EXPECT_GT(switches, 0);
}

TEST(KeysOfOutput, RecordSomethingInThePlane) {
  expect_all_record(2, "compaction/regular-25.toml");
}
TEST(KeysOfOutput, RecordSomethingInSpace) {
  expect_all_record(3, "compaction-3d/unit-cell-bcc.toml");
}

}  // namespace
}  // namespace pulvis::keys
