// Stress on the wall of a round die: the normal forces of all contacts with it over its wall between the punches.
#include <gtest/gtest.h>

#include <numbers>

#include "components/observed.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

// The network sums up each contact and takes its part along the mean normal. Over a contact of half-width a that is smaller by
// some (a/R)^2/4: a hundredth where a is a fifth of the die's radius.
TEST(DieWall, BearsTheNormalForcesOfItsContacts) {
  Experiment e(read_scene(paths::source_dir() + "/scenes/compaction-3d/tablet.toml",
                          {"packing[0].density=0.4", "packing[0].class[0].number=20",
                           "output.contacts=true", "particle.granule.mesh.divisions=2",
                           "particle.granule.mesh.rings=2", "stage.press.duration=0.5 ms"}));
  e.simulation.run_until(0.2e-3);
  e.simulation.observe();
  e.results.sample();
  double normal = 0, across = 0;
  for (const auto& link : e.simulation.world().resource<ContactNetwork<ThreeD>>().tools)
    if (link.second == 0) normal += link.normal_force();
  for (const char* axis : {"x", "y"})
    across = std::hypot(across, e.value(std::string("tool/die/force_") + axis));
  const double wall = std::numbers::pi * 36e-3 *
                      (e.value("tool/top/position_z") - e.value("tool/bottom/position_z"));
  ASSERT_GT(normal, 100);
  EXPECT_NEAR(e.value("stress/radial") * wall, normal, 0.02 * normal);
  EXPECT_LT(across, 0.5 * normal);  // what the force on the die itself leaves of them
  EXPECT_DOUBLE_EQ(e.value("stress_ratio/lateral"), e.value("stress/radial") / 100e6);
}

}  // namespace
}  // namespace pulvis
