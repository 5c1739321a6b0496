// What a lever will need is known from its keys: against the factors that are made of it.
#include <gtest/gtest.h>

#include "scenes/lever/afm_simulation.hpp"
#include "scenes/lever/afm_size.hpp"
#include "systems/lever/solid_equations.hpp"
#include "tests/helpers/lever.hpp"
#include "tests/helpers/paths.hpp"

namespace pulvis {
namespace {

struct Counted {
  double elements = 0, matrix = 0, factors = 0;
};

Counted counted(const Scene& scene) {
  AfmSimulation simulation(scene);
  simulation.calibrate();
  const auto& equations = simulation.world().resource<SolidEquations>();
  return {static_cast<double>(simulation.model().elements),
          static_cast<double>(equations.plain.stiffness.size()),
          static_cast<double>(equations.plain.factors->entries())};
}

// Within a factor of three either way: of sizes over three decades, with one formula.
void expect_near(const Scene& scene) {
  const Counted is = counted(scene);
  const SolidSize told = afm_size(*scene.afm);
  EXPECT_GT(told.elements, 0.5 * is.elements);
  EXPECT_LT(told.elements, 2 * is.elements);
  EXPECT_GT(told.matrix, 0.5 * is.matrix);
  EXPECT_LT(told.matrix, 3 * is.matrix);
  EXPECT_GT(told.factors, is.factors / 3);
  EXPECT_LT(told.factors, is.factors * 3);
}

Scene shipped(const std::string& name, const std::vector<std::string>& changes = {}) {
  return read_scene(paths::source_dir() + "/scenes/afm/" + name, changes);
}

TEST(AfmMemory, OfLeversIsToldFromTheirKeys) {
  expect_near(shipped("tipless-beam.toml"));
  expect_near(shipped("calibration-v.toml"));
  expect_near(
      shipped("tipless-beam.toml", {"lever.elements_along=60", "lever.elements_across=30"}));
  expect_near(shipped("tipless-beam.toml",
                      {"lever.elements_along=30", "lever.elements_across=12", "lever.layers=3"}));
}

TEST(AfmMemory, OfTipsIsToldFromTheirKeys) {
  expect_near(shipped("calibration-beam.toml"));
  expect_near(shipped("calibration-beam.toml", {"tip.elements=8"}));
  expect_near(shipped("hertz-ball.toml"));
  expect_near(shipped("plastic-probe.toml"));
}

TEST(AfmMemory, OfAFilesMeshIsToldFromItsElements) { expect_near(shipped("meshed-v.toml")); }

}  // namespace
}  // namespace pulvis
