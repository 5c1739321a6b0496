// Every shipped scene, run to its end (large ones: a little; bench/nightly.py runs them whole): energies balance, dissipation
// never goes back, nothing goes deep.
// The extreme ones say themselves what must hold: expectations_run_test.cpp.
#include <gtest/gtest.h>

#include <cmath>
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
// Updates of elements: the whole scene is run at night (bench/nightly.py).
constexpr double most_updates = 2e8;
// Grains have small elements and short steps: of a powder of them only the first cracks are waited for.
constexpr double most_updates_with_bonds = 6e7;
// Hexahedra cost ten times as much as quads: of a powder of them only the first contacts are made.
constexpr double most_updates_in_space = 4e7;

double most_updates_of(const Scene& scene) {
  if (scene.in_space()) return most_updates_in_space;
  return scene.bonds.empty() ? most_updates : most_updates_with_bonds;
}

class Shipped : public testing::TestWithParam<std::string> {
 protected:
  Experiment e{GetParam()};

  const Clock& clock() { return e.simulation.clock(); }
  double updates(double steps) const { return static_cast<double>(e.results.elements()) * steps; }

  // As many as the first step promises.
  double share() {
    if (e.results.elements() > max_elements) return share_of_a_large_one;
    return std::min(1.0, most_updates_of(e.scene) / updates(clock().end / clock().dt));
  }
};

TEST_P(Shipped, KeepsItsEnergyBalance) {
  e.simulation.world().resource<Clock>().end *= share();
  const double end = clock().end;
  constexpr int samples = 200;
  Energies before;
  // Steps become shorter where elements are squeezed: a powder so soft is left before its end, too.
  for (int i = 0; i <= samples; ++i) {
    if (i > 0) e.simulation.move();
    e.simulation.run_until(i < samples ? end * i / samples : end);
    e.simulation.observe();
    e.row = e.results.sample();
    const Energies& now = e.results.energies();
    EXPECT_GE(now.plastic, before.plastic);
    // Of a point that turns round in the step in which its limit falls it is a little too small (docs/theory.md, "Friction").
    EXPECT_GE(now.friction, before.friction - 1e-9 * std::abs(e.results.energies().external));
    EXPECT_GE(now.damping, before.damping);
    before = now;
    if (updates(static_cast<double>(clock().step)) >= most_updates_of(e.scene)) break;
  }
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
