// Hexagonal lattices in a periodic cell against laws: mirror planes, the closed form of elastic discs that touch, and the bulk
// stiffness of the solid that is left when the pores are gone.
//
// Elastic discs, forces per thickness. Six neighbours each press with F; E' = E/(1 - nu^2), nu' = nu/(1 - nu). The half-width
// of Hertz is that against a rigid plane, a^2 = 4 F R/(pi E'). A pair of opposite forces shortens its own diameter by
// 2 F/(pi E') (2 ln(4R/a) - 1) (Johnson 1985, 5.57). At the angle alpha from it the rim moves outward by
//     F/(pi E') g(alpha),   g = 2 cos alpha ln tan(alpha/2) + 2 - (1 - nu') (pi/2) sin alpha
// which is the sum of two Flamant solutions and the uniform tension F/(pi R) that makes the rim traction-free (Timoshenko &
// Goodier 1970, secs. 36 and 41). With the other two pairs at 60 degrees, the approach of two centres and the stress at
// centre distance d are
//     delta = F/(pi E') [4 ln(4R/a) - 2 - 4 g(60 deg)],   -sigma = sqrt(3) F/d 1
// In shear the changes of the three forces sum to zero. A contact has the stiffness k = 1/(d delta_i/dF_i - d delta_i/dF_j).
// Without friction
//     k = pi E'/[4 ln(4R/a) - 4 + 2 g(60 deg)],   sigma = -sum F r x r/(|r| A),   so that G = sqrt(3)/4 (k - 3 F/d)
// with r from centre to centre and A = sqrt(3)/2 d^2 the cell area of a disc.
//
// The solid without pores: docs/theory.md, section 8.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

constexpr double disc_diameter = 10e-3;

std::string lattice_disc(const std::string& material, const std::string& mesh,
                         const std::string& contact) {
  return fmt::format(R"(family = "compaction"
[[material]]
name = "solid"
{}
[[particle]]
name = "disc"
material = "solid"
outline = "disc"
diameter = "10 mm"
[particle.mesh]
{}
[contact]
damping = 0.3
{}
[output]
contacts = true
)",
                     material, mesh, contact);
}

const std::string hardening_copper =
    "density = \"8940 kg/m^3\"\nyoungs_modulus = \"115 GPa\"\npoissons_ratio = 0.35\n"
    "yield_stress = \"50 MPa\"\nhardening_modulus = \"440 MPa\"\n";

std::string disc_at(double x, double y) {
  return fmt::format("[[body]]\nparticle = \"disc\"\nposition = [\"{:.17g} m\", \"{:.17g} m\"]\n",
                     x, y);
}

// Two discs of the lattice in a rectangle that is turned; the lattice itself is the same for every multiple of 60 degrees.
std::string hexagonal_cell(double angle = 0) {
  const double d = disc_diameter, c = std::cos(angle), s = std::sin(angle);
  const auto turned = [&](double x, double y) { return disc_at(c * x - s * y, s * x + c * y); };
  return fmt::format(
             "[cell]\nwidth = \"{:.17g} m\"\nheight = \"{:.17g} m\"\nangle = \"{:.17g} rad\"\n", d,
             std::numbers::sqrt3 * d, angle) +
         turned(d / 4, std::numbers::sqrt3 * d / 4) +
         turned(3 * d / 4, 3 * std::numbers::sqrt3 * d / 4);
}

std::string strained(const std::string& stage, double duration, double xx, double yy,
                     double xy = 0) {
  return fmt::format(
      "[[stage]]\nname = \"{}\"\nkind = \"compact\"\nduration = \"{:.17g} s\"\n[stage.cell]\n"
      "strain_xx = {:.17g}\nstrain_yy = {:.17g}\nstrain_xy = {:.17g}\n",
      stage, duration, xx, yy, xy);
}

// Six frictionless planes around one disc, which close in as the cell's neighbours do.
std::string six_planes(double duration, double strain) {
  std::string tools = disc_at(0, 0), moves;
  const double closing = (std::exp(strain) - 1) * disc_diameter / 2;
  for (int i = 0; i < 6; ++i) {
    const double c = std::cos(i * std::numbers::pi / 3), s = std::sin(i * std::numbers::pi / 3),
                 r = disc_diameter / 2;
    tools += fmt::format(
        "[[tool]]\nname = \"plane{}\"\nshape = \"plane\"\npoint = [\"{:.17g} m\", \"{:.17g} m\"]\n"
        "normal = [{:.17g}, {:.17g}]\n",
        i, r * c, r * s, -c, -s);
    moves += fmt::format(
        "[[stage.move]]\ntool = \"plane{}\"\ndisplacement = [\"{:.17g} m\", \"{:.17g} m\"]\n", i,
        closing * c, closing * s);
  }
  return tools +
         fmt::format("[[stage]]\nname = \"press\"\nkind = \"compact\"\nduration = \"{:.17g} s\"\n",
                     duration) +
         moves;
}

double mean_pressure(const Experiment& e) {
  return -(e.value("stress/xx") + e.value("stress/yy")) / 2;
}

// Every line that halves the distance of two neighbours at a right angle is a mirror of the lattice, as long as it is pressed
// alike from all sides.
TEST(HexagonalCell, BearsWhatADiscBetweenSixPlanesBears) {
  const double strain = -0.04, duration = 1e-3;
  const std::string disc =
      lattice_disc(hardening_copper, "boundary_edges = 48\nrings = 2", "stiffness = 20");
  Experiment cell(own_scene(disc + hexagonal_cell() + strained("press", duration, strain, strain)));
  Experiment planes(own_scene(disc + six_planes(duration, strain)));
  std::vector<double> work, planes_at, in_planes, spacing;
  cell.run(10, [&] {
    work.push_back(cell.value("energy/external") / 2);
    spacing.push_back(cell.value("cell/width"));
  });
  planes.run(100, [&] {
    planes_at.push_back(-2 * planes.value("tool/plane0/position_x"));
    in_planes.push_back(planes.value("energy/external"));
  });
  for (std::size_t i = 4; i < work.size(); ++i)
    EXPECT_NEAR(work[i] / at(planes_at, in_planes, -spacing[i]), 1, 0.005) << spacing[i];
  double force = 0;
  for (int i = 0; i < 6; ++i)
    force += std::hypot(planes.value(fmt::format("tool/plane{}/force_x", i)),
                        planes.value(fmt::format("tool/plane{}/force_y", i))) /
             6;
  const double side = disc_diameter * std::exp(strain) / std::numbers::sqrt3;
  const double pressure = force / (side * planes.scene.thickness);
  for (const char* name : {"stress/", "cell/stress_"}) {
    EXPECT_NEAR(-cell.value(std::string(name) + "xx") / pressure, 1, 0.005) << name;
    EXPECT_NEAR(-cell.value(std::string(name) + "yy") / pressure, 1, 0.005) << name;
    EXPECT_NEAR(cell.value(std::string(name) + "xy") / pressure, 0, 0.005) << name;
  }
  EXPECT_LT(cell.results.energy_balance_error(), 0.003);
}

// Pressed along one direction: which rectangle of the lattice repeats does not matter.
TEST(HexagonalCell, MayBeAnyRectangleOfTheLattice) {
  const std::string disc =
      lattice_disc(hardening_copper, "boundary_edges = 48\nrings = 1", "stiffness = 4");
  const std::string press = strained("press", 0.5e-3, 0, -0.08);
  Experiment straight(own_scene(disc + hexagonal_cell() + press));
  Experiment turned(own_scene(disc + hexagonal_cell(std::numbers::pi / 3) + press));
  straight.run(5);
  turned.run(5);
  ASSERT_LT(straight.value("stress/yy"), -50e6);
  for (const char* name : {"stress/xx", "stress/yy", "stress/zz", "cell/stress_xx",
                           "cell/stress_yy", "energy/external", "energy/plastic"})
    EXPECT_NEAR(turned.value(name) / straight.value(name), 1, 1e-6) << name;
}

// Elastic discs that touch six neighbours with the force F per thickness each.
struct ElasticLattice {
  double modulus, ratio;  // plane strain: E/(1 - nu^2), nu/(1 - nu)
  double radius = disc_diameter / 2;

  double half_width(double F) const {
    return std::sqrt(4 * F * radius / (std::numbers::pi * modulus));
  }
  // How far a pair of forces F = pi E' moves the rim outward at 60 degrees from them.
  double outward() const {
    const double angle = std::numbers::pi / 3;
    return 2 * std::cos(angle) * std::log(std::tan(angle / 2)) + 2 -
           (1 - ratio) * std::numbers::pi / 2 * std::sin(angle);
  }
  double approach(double F) const {
    return F / (std::numbers::pi * modulus) *
           (4 * std::log(4 * radius / half_width(F)) - 2 - 4 * outward());
  }
  // Bisection: the approach rises with the force as far as the half-width is small.
  double force(double approached) const {
    double low = 0, high = 0.05 * modulus * radius;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (approach(middle) < approached ? low : high) = middle;
    }
    return low;
  }
  double pressure(double spacing) const {
    return std::numbers::sqrt3 * force(2 * radius - spacing) / spacing;
  }
  double shear_modulus(double spacing) const {
    const double F = force(2 * radius - spacing);
    const double own = 4 * std::log(4 * radius / half_width(F)) - 4, other = -2 * outward();
    const double stiffness = std::numbers::pi * modulus / (own - other);
    return std::numbers::sqrt3 / 4 * (stiffness - 3 * F / spacing);
  }
};

struct ShearState {
  double normal, shear;  // (xx - yy)/2 and xy
};
ShearState shear_stress(const Experiment& e) {
  return {(e.value("stress/xx") - e.value("stress/yy")) / 2, e.value("stress/xy")};
}
ShearState shear_strain(const Experiment& e) {
  return {(e.value("cell/strain_xx") - e.value("cell/strain_yy")) / 2, e.value("cell/strain_xy")};
}

// From where the width of a contact is three edges on: a/R of 0.05 on 192 edges.
TEST(HexagonalCell, OfElasticDiscsHasThePressureAndTheShearModulusOfItsClosedForm) {
  const double E = 200e9, nu = 0.3, strain = 0.008, duration = 0.1e-3;
  const ElasticLattice law{E / (1 - nu * nu), nu / (1 - nu)};
  Experiment e(own_scene(
      lattice_disc("density = \"7850 kg/m^3\"\nyoungs_modulus = \"200 GPa\"\npoissons_ratio = 0.3",
                   "boundary_edges = 192\nrings = 6\ncore = \"coarse\"", "stiffness = 20") +
      hexagonal_cell() + strained("press", duration, -strain, -strain) +
      strained("stretch", duration, 4e-4, -4e-4) + strained("shear", duration, 0, 0, 4e-4)));
  std::vector<ShearState> stress, strains;
  int held = 0;
  e.run(60, [&] {
    stress.push_back(shear_stress(e));
    strains.push_back(shear_strain(e));
    const double spacing = disc_diameter * std::exp(e.value("cell/strain_xx"));
    const double pressed = disc_diameter - spacing;
    if (stress.size() > 21 || law.half_width(law.force(pressed)) < 0.05 * law.radius) return;
    ++held;
    EXPECT_NEAR(mean_pressure(e) / law.pressure(spacing), 1, 0.01) << pressed;
  });
  EXPECT_GE(held, 8);
  const double G = law.shear_modulus(disc_diameter * std::exp(-strain));
  const auto share = [&](auto component, std::size_t from, std::size_t to) {
    return (stress[to].*component - stress[from].*component) /
           (strains[to].*component - strains[from].*component) / 2 / G;
  };
  EXPECT_NEAR(share(&ShearState::normal, 20, 40), 1, 0.015);
  EXPECT_NEAR(share(&ShearState::shear, 40, 60), 1, 0.015);
}

// What a curve of pressure against relative density has reached, and its slope over ln(density).
struct PressureCurve {
  std::vector<double> density, pressure;
  void add(const Experiment& e) {
    density.push_back(e.value("relative_density"));
    pressure.push_back(mean_pressure(e));
  }
  double slope(double from, double to) const {
    return (at(density, pressure, to) - at(density, pressure, from)) / std::log(to / from);
  }
};
// The solid flows and keeps its volume but for the pressure: K, and not K + mu/3 of an elastic one in plane strain.
constexpr double bulk_modulus_of_copper = 115e9 / (3 * (1 - 2 * 0.35));

TEST(HexagonalCell, WithoutPoresHasTheBulkStiffnessOfTheSolid) {
  const double strain = 0.5 * std::log(1.03 / (std::numbers::pi / (2 * std::numbers::sqrt3)));
  Experiment e(
      own_scene(lattice_disc(hardening_copper, "boundary_edges = 48\nrings = 2", "stiffness = 80") +
                hexagonal_cell() + strained("press", 1e-3, -strain, -strain)));
  PressureCurve curve;
  e.run(100, [&] { curve.add(e); });
  EXPECT_LT(curve.slope(0.94, 0.96), 0.03 * bulk_modulus_of_copper);
  EXPECT_NEAR(curve.slope(1.02, 1.029) / bulk_modulus_of_copper, 1, 0.015);
  EXPECT_LT(e.results.energy_balance_error(), 0.003);
}

// 16 discs at random, pressed isotropically to a relative density of 1.06.
PressureCurve random_powder(const std::vector<std::string>& overrides) {
  const double width = disc_diameter * std::sqrt(16 * std::numbers::pi / 4 / 0.8),
               strain = 0.5 * std::log(1.06 / 0.8);
  Experiment e(own_scene(
      lattice_disc(hardening_copper, "boundary_edges = 48\nrings = 2",
                   "stiffness = 40\nfriction = 0.2") +
          fmt::format(
              "[cell]\nwidth = \"{0:.17g} m\"\n[[packing]]\nkind = \"random\"\nwidth = "
              "\"{0:.17g} m\"\ndensity = 0.8\nclass = [{{ particle = \"disc\", number = 16 }}]\n",
              width) +
          strained("press", 1e-3, -strain, -strain),
      overrides));
  PressureCurve curve;
  e.run(100, [&] { curve.add(e); });
  EXPECT_LT(e.results.energy_balance_error(), 0.003);
  return curve;
}

TEST(Cell, OfARandomPowderWithoutPoresHasTheBulkStiffnessOfTheSolid) {
  const PressureCurve curve = random_powder({"contact.hardness=1000"});  // nothing indents
  EXPECT_LT(curve.slope(0.90, 0.92), 0.015 * bulk_modulus_of_copper);
  const double slopes[] = {curve.slope(0.98, 0.99), curve.slope(1.01, 1.02),
                           curve.slope(1.03, 1.04), curve.slope(1.05, 1.059)};
  EXPECT_TRUE(std::ranges::is_sorted(slopes));
  EXPECT_NEAR(slopes[3] / bulk_modulus_of_copper, 1, 0.025);
}

// Without pores nothing indents further: the last pores close earlier, and the stiffness is reached sooner.
TEST(Cell, OfARandomPowderThatIndentsHasTheBulkStiffnessOfTheSolid) {
  const PressureCurve curve = random_powder({});
  EXPECT_LT(curve.slope(0.90, 0.92), 0.015 * bulk_modulus_of_copper);
  EXPECT_LT(curve.slope(0.94, 0.96), curve.slope(0.98, 0.99));
  for (const double from : {1.01, 1.03, 1.05})
    EXPECT_NEAR(curve.slope(from, from + 0.009) / bulk_modulus_of_copper, 1, 0.025) << from;
}

}  // namespace
}  // namespace pulvis
