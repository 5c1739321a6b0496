// Every shipped scene, run to its end (large ones: a little): energies balance, dissipation never goes back, nothing goes deep.
// The extreme ones say themselves what must hold: expectations_run_test.cpp.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/helpers/experiment.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/shipped_scenes.hpp"

namespace pulvis {
namespace {

// Those of studies belong to their studies, which ask for trends.
std::vector<std::string> shipped() {
  const std::filesystem::path root = std::filesystem::path(paths::source_dir()) / "scenes";
  std::vector<std::string> scenes;
  for (const std::filesystem::path& file : shipped_scenes()) {
    const std::string name = std::filesystem::relative(file, root).string();
    const bool elsewhere = name.starts_with("extreme/") || name.starts_with("studies/") ||
                           name.starts_with("probes/") ||
                           name.starts_with("afm/");  // statics: tests/afm
    if (!elsewhere) scenes.push_back(name);
  }
  return scenes;
}

// A large one takes many minutes: here it only begins, with the first touches and waves.
constexpr std::int64_t max_elements = 100'000;
constexpr double share_of_a_large_one = 0.004;
// Grains have small elements and short steps: of a powder of them only the first cracks are waited for.
constexpr double most_updates_with_bonds = 8e8;  // of elements
// Hexahedra cost ten times as much as quads: of a powder of them only the first contacts are made.
constexpr double most_updates_in_space = 4e7;

double share_of(Experiment& e) {
  if (e.results.elements() > max_elements) return share_of_a_large_one;
  if (e.scene.bonds.empty() && !e.scene.space) return 1;
  const Clock& clock = e.simulation.world().resource<Clock>();
  const double updates = static_cast<double>(e.results.elements()) * clock.end / clock.dt;
  return std::min(1.0, (e.scene.space ? most_updates_in_space : most_updates_with_bonds) / updates);
}

class Shipped : public testing::TestWithParam<std::string> {};

TEST_P(Shipped, KeepsItsEnergyBalance) {
  Experiment e(GetParam());
  e.simulation.world().resource<Clock>().end *= share_of(e);
  Energies before;
  e.run(200, [&] {
    const Energies& now = e.results.energies();
    EXPECT_GE(now.plastic, before.plastic);
    EXPECT_GE(now.friction, before.friction);
    EXPECT_GE(now.damping, before.damping);
    before = now;
  });
  EXPECT_LT(e.results.energy_balance_error(), 0.01);
  EXPECT_LT(e.value("penetration"), 0.1);  // two particles share theirs
}

std::string name_of(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}
INSTANTIATE_TEST_SUITE_P(Scenes, Shipped, testing::ValuesIn(shipped()), name_of);

}  // namespace
}  // namespace pulvis
