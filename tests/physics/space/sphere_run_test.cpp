// Runs of scenes in three dimensions as a whole: Newton's second law, the balance of energies, and the same bits whatever the
// threads and wherever a run stopped.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "components/space/shape.hpp"
#include "engine/files/checkpoint.hpp"
#include "scenes/results/state_hash.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

// A ball of 316L of seven elements by seven, pressed flat by a tenth.
const std::vector<std::string> coarse{
    "particle.ball.mesh.divisions=2", "particle.ball.mesh.rings=2", "stage.press.duration=0.1 ms",
    "stage.press.move.top.displacement=[\"0 mm\", \"0 mm\", \"-1 mm\"]"};

Scene coarse_scene(std::vector<std::string> more = {}) {
  more.insert(more.begin(), coarse.begin(), coarse.end());
  return read_scene(paths::source_dir() + "/scenes/compaction-3d/one-sphere.toml", more);
}

// What the plates do to the ball changes its momentum, in every step that is looked at.
TEST(SphereBetweenPlates, TheToolsForcesChangeItsMomentum) {
  Experiment e(coarse_scene());
  for (int look = 1; look <= 10; ++look) {
    e.simulation.run_until(0.009e-3 * look);
    e.simulation.observe();
    e.results.sample();
    const Clock& clock = e.simulation.clock();
    const double dt = 0.5 * (clock.dt_before + clock.dt);
    const double top = e.value("tool/top/force_z");
    const double force = -top - e.value("tool/bottom/force_z");
    const std::vector<double> before = e.results.momentum();
    e.simulation.move();
    EXPECT_NEAR(e.results.momentum()[2] - before[2], force * dt, 1e-9 * std::abs(top) * dt) << look;
  }
}

TEST(SphereBetweenPlates, LosesNoEnergy) {
  Experiment e(coarse_scene());
  double top = 0, bottom = 0;  // it is released in the end
  e.run(20, [&] {
    top = std::max(top, e.value("tool/top/force_z"));
    bottom = std::min(bottom, e.value("tool/bottom/force_z"));
  });
  EXPECT_GT(e.results.energies().plastic, 0);
  EXPECT_LT(e.results.energy_balance_error(), 0.01);
  EXPECT_GT(top, 1000);
  EXPECT_LT(bottom, -1000);
}

// An elastic ball in a box that closes on all sides alike has the mean of its stresses times its volume in the virial of the
// walls' forces (Love 1927, Sec. 123): sum f.x = -integral of tr sigma.
TEST(SphereInABox, ForcesOfTheWallsAreTheVirialOfItsStresses) {
  Scene scene = read_scene(
      paths::source_dir() + "/scenes/compaction-3d/unit-cell-sc.toml",
      {"particle.ball.mesh.divisions=2", "particle.ball.mesh.rings=2", "stage.press.duration=1 ms",
       "let.move=0.05 mm", "stage.press.move.top.ramp=0.4"});
  Experiment e(std::move(scene));
  e.run(20);
  double of_walls = 0;
  for (const auto& [low, high, axis] :
       {std::tuple{"left", "right", "x"}, {"front", "back", "y"}, {"bottom", "top", "z"}}) {
    const auto at = [&](const char* tool, const char* what) {
      return e.value(std::string("tool/") + tool + "/" + what + axis);
    };
    of_walls +=
        at(low, "position_") * at(low, "force_") + at(high, "position_") * at(high, "force_");
  }
  const space::Shape& shape = e.simulation.world().resource<space::Shapes>().list.front();
  const std::vector<double> pressure = e.field("pressure");
  double of_stresses = 0;
  for (std::size_t i = 0; i < pressure.size(); ++i)
    of_stresses += 3 * pressure[i] * shape.element[i].volume;
  // The elements' volumes change by the strain of the ball, some thousandths; its mass is hardly accelerated.
  EXPECT_NEAR(of_walls / of_stresses, 1, 0.02);
}

std::string state_after(const Scene& scene, int threads) {
  Experiment e(scene, threads);
  e.run(7);
  return state_hash_text(e.simulation.world());
}

TEST(RunsInSpace, HaveTheSameBitsOnAnyNumberOfThreads) {
  const Scene scene =
      read_scene(paths::source_dir() + "/scenes/compaction-3d/unit-cell-bcc.toml",
                 {"particle.ball.mesh.divisions=2", "particle.ball.mesh.rings=2",
                  "stage.press.duration=0.02 ms", "let.move=0.2 mm", "contact.friction=0.2"});
  EXPECT_EQ(state_after(scene, 1), state_after(scene, 2));
}

TEST(RunsInSpace, GoOnWithTheSameBitsFromACheckpoint) {
  const Scene scene = coarse_scene();
  Simulation whole(scene), first(scene), second(scene);
  whole.run_steps(400);
  first.run_steps(250);
  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     ("pulvis-state-in-space-" + std::to_string(getpid()) + ".h5");
  write_state_file(file, {}, first.world());
  Checkpoint(file).restore(second.world());
  std::filesystem::remove(file);
  second.run_steps(150);
  EXPECT_EQ(state_hash_text(second.world()), state_hash_text(whole.world()));
}

}  // namespace
}  // namespace pulvis
