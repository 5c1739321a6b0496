// Cantilevers of few rows of elements against Timoshenko's beam: what scenes/checks/bending_error says of a formulation
// is what a run shows.
#include <gtest/gtest.h>

#include "scenes/checks/bending_error.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/paths.hpp"

namespace pulvis {
namespace {

struct Cantilever {
  const char* formulation;
  int rows, columns;
  double nu = 0.3;
};

constexpr double beam = 20e-3, height = 1e-3, way = 0.02e-3;

Scene scene_of(const Cantilever& c) {
  const auto number = [](auto value) { return std::to_string(value); };
  const std::string text =
      "family = \"compaction\"\n[element]\nformulation = \"" + std::string(c.formulation) +
      "\"\n[[material]]\nname = \"steel\"\ndensity = \"7850 kg/m^3\"\nyoungs_modulus = \"200 "
      "GPa\"\n"
      "poissons_ratio = " +
      number(c.nu) +
      "\n[material.damping]\nmass_proportional = \"6e4 1/s\"\n"
      "[[particle]]\nname = \"bar\"\nmaterial = \"steel\"\noutline = \"rectangle\"\n"
      "width = \"20 mm\"\nheight = \"1 mm\"\n[particle.mesh]\ncolumns = " +
      number(c.columns) + "\nrows = " + number(c.rows) +
      "\n[[body]]\nparticle = \"bar\"\nposition = [\"10 mm\", \"0 mm\"]\n"
      "[[tool]]\nname = \"clamp\"\nshape = \"constraint\"\nholds = \"both\"\n"
      "low = [\"-0.01 mm\", \"-1 mm\"]\nhigh = [\"0.01 mm\", \"1 mm\"]\n"
      "[[tool]]\nname = \"tip\"\nshape = \"constraint\"\nholds = \"y\"\n"
      "low = [\"19.99 mm\", \"-1 mm\"]\nhigh = [\"20.01 mm\", \"1 mm\"]\n"
      "[[stage]]\nname = \"bend\"\nkind = \"compact\"\nduration = \"0.3 ms\"\n"
      "[[stage.move]]\ntool = \"tip\"\ndisplacement = [\"0 mm\", \"0.02 mm\"]\nramp = 0.4\n"
      "[[stage]]\nname = \"hold\"\nkind = \"hold\"\nduration = \"0.3 ms\"\n";
  return load_scene_text(text, "cantilever.toml").scene;
}

// Over Timoshenko's, less one.
double stiffness_error(const Scene& scene, double nu) {
  Experiment e(scene);
  e.simulation.run_until(e.simulation.clock().end);
  e.simulation.observe();
  e.results.sample();
  const double bending = 200e9 / (1 - nu * nu) * height * height * height / 12 * scene.thickness;
  const double shear = 200e9 / (2 * (1 + nu)) * 5.0 / 6 * height * scene.thickness;
  const double exact = way / (beam * beam * beam / (3 * bending) + beam / shear);
  return -e.value("tool/tip/force_y") / exact - 1;
}

class Cantilevers : public ::testing::TestWithParam<Cantilever> {};

TEST_P(Cantilevers, BendAsTheClosedFormSaysOfTheirElements) {
  const Scene scene = scene_of(GetParam());
  const double told = *bending_error(scene, scene.particles[0]);
  const double shown = stiffness_error(scene, GetParam().nu);
  EXPECT_NEAR((1 + shown) / (1 + told), 1, 0.02) << shown << " " << told;
}
INSTANTIATE_TEST_SUITE_P(
    Formulations, Cantilevers,
    ::testing::Values(Cantilever{"one-point", 1, 20}, Cantilever{"one-point", 1, 5},
                      Cantilever{"four-point", 1, 40}, Cantilever{"four-point", 1, 20},
                      Cantilever{"four-point", 1, 5}, Cantilever{"four-point", 1, 40, 0.4},
                      Cantilever{"four-point", 2, 40}, Cantilever{"four-point", 4, 40},
                      Cantilever{"standard", 1, 20}, Cantilever{"standard", 2, 20}));

TEST(BendingError, IsToldWhereItIsLarge) {
  EXPECT_TRUE(bending_warnings(scene_of({"one-point", 1, 5})).empty());
  EXPECT_TRUE(bending_warnings(scene_of({"four-point", 4, 80})).empty());
  const auto told = bending_warnings(scene_of({"four-point", 1, 5}));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("+507%"), std::string::npos) << told[0];
}

TEST(BendingError, IsNoMatterOfSquatParticles) {
  const Scene scene = read_scene(paths::source_dir() + "/scenes/compaction/unit-cell.toml",
                                 {"element.formulation=four-point"});
  EXPECT_FALSE(bending_error(scene, scene.particles[0]));
}

}  // namespace
}  // namespace pulvis
