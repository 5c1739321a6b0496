// A cylinder pressed in a round die, unloaded and ejected past its mouth.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "components/space/shape.hpp"
#include "scenes/spec/scene.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/plates.hpp"

namespace pulvis {
namespace {

constexpr double youngs_modulus = 9e9, poissons_ratio = 0.3, height_of_mouth = 20e-3;

constexpr const char* set_up = R"(family = "compaction"
dimension = 3

[[material]]
name = "powder"
density = "1560 kg/m^3"
youngs_modulus = "9 GPa"
poissons_ratio = 0.3
yield_stress = "100 MPa"
hardening_modulus = "100 MPa"

[[particle]]
name = "tablet"
material = "powder"
shape = "cylinder"
diameter = "35.8 mm"
height = "16 mm"
rounding = "1.3 mm"

[particle.mesh]
grid = "extruded"
divisions = 4
rings = 2
axial_divisions = 6

[[body]]
particle = "tablet"
position = ["0 mm", "0 mm", "8.2 mm"]

[[tool]]
name = "die"
shape = "die"
point = ["0 mm", "0 mm", "0 mm"]
diameter = "36 mm"
height = "20 mm"
rounding = "2 mm"
)";

constexpr const char* stages = R"(
[[stage]]
name = "press"
kind = "compact"
duration = "0.5 ms"
move = [{ tool = "top", displacement = ["0 mm", "0 mm", "-1.4 mm"] }]

[[stage]]
name = "unload"
kind = "unload"
duration = "0.3 ms"
move = [{ tool = "top", displacement = ["0 mm", "0 mm", "2 mm"] }]

[[stage]]
name = "rest"
kind = "settle"
duration = "0.2 ms"

[[stage]]
name = "eject"
kind = "eject"
duration = "2 ms"
move = [
  { tool = "top", displacement = ["0 mm", "0 mm", "60 mm"] },
  { tool = "bottom", displacement = ["0 mm", "0 mm", "22 mm"] },
]

[[stage]]
name = "free"
kind = "settle"
duration = "0.4 ms"

[contact]
damping = 0.5
)";

Scene tablet_in_a_die(double friction, std::vector<std::string> overrides = {}) {
  overrides.push_back("contact.friction=" + std::to_string(friction));
  return own_scene(set_up + plates("16.4 mm") + stages, overrides);
}

using Places = std::vector<Vec3>;  // of the nodes

Places places_in(const Experiment& e) {
  const std::vector<double> x = e.field("position");
  Places nodes(x.size() / 3);
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = Vec3::Map(&x[3 * i]);
  return nodes;
}

// By the divergence theorem over the faces of the mesh: how much the body has widened in the plane of x and y, mean over
// its volume.
struct Widening {
  double strain = 0, volume = 0;  // -; m^3, before
  Widening(Experiment& e, const Places& before, const Places& after) {
    for (const auto& face : e.simulation.world().resource<space::Shapes>().list[0].faces) {
      std::array<Vec3, 4> corner;
      Vec3 middle = Vec3::Zero(), moved = Vec3::Zero();
      for (std::size_t k = 0; k < 4; ++k) {
        const auto node = static_cast<std::size_t>(face.corner[k].value);
        corner[k] = before[node];
        middle += before[node] / 4;
        moved += (after[node] - before[node]) / 4;
      }
      const Vec3 area = 0.5 * (corner[2] - corner[0]).cross(corner[3] - corner[1]);
      volume += middle.dot(area) / 3;
      strain += 0.5 * moved.head<2>().dot(area.head<2>());
    }
    strain /= volume;
  }
};

// N, normal to the wall.
double force_on_wall(const Experiment& e) {
  const double from = e.value("tool/bottom/position_z");
  const double to = std::min(e.value("tool/top/position_z"), height_of_mouth);
  return e.value("stress/radial") * std::numbers::pi * 36e-3 * std::max(to - from, 0.0);
}

// Law: by the theorem of the mean stress, a wall that bears N at a radius R holds a body of volume V with N R/(2 V) in its plane,
// whatever the distribution. Without axial stress, this holds it (1 - nu) N R/(2 V E) too narrow.
TEST(Ejection, ReleasesTheStressThatTheWallBore) {
  // With stiff springs the wall keeps more of its stress, at the yield stress, and the tablet flows as it is let go.
  Experiment e(tablet_in_a_die(0, {"contact.stiffness=0.5"}));
  double wall = 0, released = 0, volume = 0;
  Places held;
  int samples = 0;
  bool hit = false;
  e.run(400, [&] {
    const double time = e.simulation.clock().time;
    // The tablet moves up and down between the plates; when one hits it, it rings.
    const bool free = e.value("tool/top/force_z") == 0 && e.value("tool/bottom/force_z") == 0;
    if (time < 0.99e-3 && free) {
      wall = force_on_wall(e);
      held = places_in(e);
    }
    hit = time >= 2.9e-3 && (hit || !free);
    if (time < 2.9e-3 || hit) return;
    const Widening widening(e, held, places_in(e));
    released += widening.strain;
    volume = widening.volume;
    ++samples;
    EXPECT_EQ(e.value("stress/radial"), 0);
    EXPECT_EQ(e.value("tool/die/force_z"), 0);
  });
  ASSERT_GT(samples, 15);
  const double radius = 18.05e-3;  // of the wall, and the penetration that its springs need
  const double pressure = wall * radius / (2 * volume);
  ASSERT_GT(pressure, 50e6);
  const double strain = (1 - poissons_ratio) * pressure / youngs_modulus;
  EXPECT_NEAR(released / samples, strain, 0.01 * strain);
  EXPECT_LT(e.results.energy_balance_error(), 0.01);
}

// Law: the wall slides at mu times its normal force, which the lower punch has to push; both fall to nothing past the mouth.
TEST(Ejection, NeedsTheFrictionOfTheWall) {
  constexpr double mu = 0.1;
  Experiment e(tablet_in_a_die(mu));
  double first = 0, before = 1e30;
  int sliding = 0;
  e.run(400, [&] {
    const double friction = e.value("tool/die/force_z"), wall = force_on_wall(e);
    const double bottom = e.value("tool/bottom/position_z");
    if (bottom < 2e-3) {  // all of it is below the edge of the mouth
      EXPECT_LE(std::abs(friction), mu * wall * (1 + 1e-6) + 1e-9);
    }
    if (bottom > 0.5e-3 && bottom < 2e-3) {
      EXPECT_NEAR(friction, mu * wall, 1e-3 * friction);
      first = friction;
      ++sliding;
    }
    if (e.simulation.clock().time > 2.9e-3) {
      EXPECT_EQ(friction, 0);
    }
    before = friction;
  });
  EXPECT_GT(sliding, 5);
  EXPECT_GT(first, 5e3);
  EXPECT_EQ(before, 0);
}

}  // namespace
}  // namespace pulvis
