// Rounded rectangles and rings in use: pressed, spinning; against closed forms.
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>
#include <sstream>

#include "components/body.hpp"
#include "tests/helpers/experiment.hpp"
#include "tests/helpers/paths.hpp"

namespace pulvis {
namespace {

// A shipped scene whose first particle has another outline and mesh.
Scene with_outline(const std::string& file, const std::string& outline,
                   const std::vector<std::string>& overrides) {
  std::ifstream stream(paths::source_dir() + "/scenes/" + file);
  std::stringstream text;
  text << stream.rdbuf();
  std::string scene = text.str();
  const std::size_t from = scene.find("outline = "), end = scene.find("\n\n[[", from);
  return load_scene_text(scene.replace(from, end - from, outline), file, overrides).scene;
}

std::vector<Point> positions(const Experiment& e) {  // of the particle in lane 0
  const auto& x = e.column<Position<TwoD>>();
  std::vector<Point> points;
  for (std::size_t n = 0; n < x.table.rows; ++n)
    points.push_back({x.lanes()[2 * n][0], x.lanes()[2 * n + 1][0]});
  return points;
}

struct Curve {
  std::vector<double> force;  // N, of the lower platen
  double largest_step = 0;    // from one sample to the next, as share of the last force
  double balance = 0;
  double penetration = 0;
};
Curve press_corner(const std::vector<std::string>& overrides) {
  auto all = overrides;  // stiff springs would pass its vibrations on
  all.emplace_back("contact.stiffness=0.5");
  Experiment e("basic/rounded-corner.toml", all);
  Curve curve;
  e.run(300, [&] {
    curve.force.push_back(-e.value("tool/bottom/force_y"));
    EXPECT_NEAR(e.value("tool/top/force_y"), curve.force.back(), 1e-6 * (1 + curve.force.back()));
  });
  for (std::size_t i = 1; i < curve.force.size(); ++i)
    curve.largest_step = std::max(
        curve.largest_step, std::abs(curve.force[i] - curve.force[i - 1]) / curve.force.back());
  curve.balance = e.results.energy_balance_error();
  curve.penetration = e.value("penetration");
  return curve;
}

TEST(RoundedCorner, PressesSmoothlyOnAPlane) {
  const Curve coarse = press_corner({});
  const Curve fine =
      press_corner({"particle.square.mesh.boundary_edges=96", "particle.square.mesh.rings=2"});
  for (const Curve* curve : {&coarse, &fine}) {
    EXPECT_LT(curve->balance, 0.01);
    EXPECT_LT(curve->penetration, 0.1);
    for (std::size_t i = 1; i < curve->force.size(); ++i)  // never back: plastic, loaded only
      EXPECT_GT(curve->force[i] - curve->force[i - 1], -0.002 * curve->force.back()) << i;
    // The fastest point of the ramp moves at twice the mean speed.
    EXPECT_LT(curve->largest_step, 5 * 2.0 / 300);
  }
  // The default mesh is 7.2% stiffer than four times its elements: the wedge under the arc flows in three
  // rows of quads.
  EXPECT_NEAR(coarse.force.back() / fine.force.back(), 1, 0.08);
}

// Energy and shape of a free elastic body: the spin stretches it by rho omega^2 r^2 / E, it rings about
// that, and nothing of it grows.
TEST(SpinningRoundedRectangle, KeepsItsShape) {
  Experiment e(
      with_outline("basic/spinning-disc.toml",
                   "outline = \"rounded_rectangle\"\nwidth = \"15 mm\"\nheight = \"10 mm\"\n"
                   "radius = \"0.5 mm\"\n\n[particle.mesh]\nboundary_edges = 48",
                   {"stage.spin.duration=3 ms", "body[0].angular_velocity=1e4 rad/s"}));
  const std::vector<Point> start = positions(e);
  e.run(30);
  const std::vector<Point> end = positions(e);
  const double r = std::hypot(7.5e-3, 5e-3);
  const double strain = 7850 * 1e4 * 1e4 * r * r / 200e9;
  double maximum = 0;
  for (std::size_t i = 0; i < start.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double was = std::hypot(start[i][0] - start[j][0], start[i][1] - start[j][1]);
      const double is = std::hypot(end[i][0] - end[j][0], end[i][1] - end[j][1]);
      maximum = std::max(maximum, std::abs(is / was - 1));
    }
  EXPECT_GT(maximum, 0);
  EXPECT_LT(maximum, 2 * strain);
  EXPECT_LT(e.results.energy_balance_error(), 1e-3);
}

// A ring pressed between two platens: Timoshenko's curved beam, bending, tension and shear.
TEST(Ring, IsAsStiffAsACurvedBeam) {
  const double hole = 8.5e-3;
  Experiment e(with_outline("basic/disc-platens.toml",
                            "outline = \"ring\"\ndiameter = \"10 mm\"\nhole = \"8.5 mm\"\n\n"
                            "[particle.mesh]\nboundary_edges = 160\nrings = 4",
                            {"stage.press.duration=0.6 ms", "contact.stiffness=1"}));
  const std::vector<Point> start = positions(e);
  e.run(10);
  const std::vector<Point> end = positions(e);
  const double force = 0.5 * (e.value("tool/top/force_y") - e.value("tool/bottom/force_y"));
  // Of the layer in the middle of the wall, where the platens' dents are not felt; 40 edges a side.
  const std::size_t bottom = 2 * 160 + 20, top = bottom + 80;
  const double shortening = (end[bottom][1] - start[bottom][1]) - (end[top][1] - start[top][1]);
  const double t = (10e-3 - hole) / 2, R = (10e-3 + hole) / 4, b = e.scene.thickness;
  const double E = 200e9 / (1 - 0.09), G = 200e9 / 2.6, area = b * t, I = b * t * t * t / 12;
  using std::numbers::pi;
  const double expected = force * R * R * R / (E * I) * (pi / 4 - 2 / pi) +
                          force * R / (E * area) * pi / 4 + 1.2 * force * R / (G * area) * pi / 4;
  EXPECT_GT(force, 0);
  EXPECT_NEAR(shortening / expected, 1, 0.04);  // beam theory at t/R = 0.16
  EXPECT_LT(e.results.energy_balance_error(), 0.01);
}

// One element across, along, or both. A pass samples four points an edge, so that an edge of 10 mm loads
// edges of 2 mm not quite evenly: 0.3%.
TEST(PatchTest, UniformPressureCrossesBlocksOfOneElement) {
  for (const std::vector<std::string>& mesh :
       {std::vector<std::string>{"particle.lower.mesh.rows=1"},
        {"particle.lower.mesh.rows=1", "particle.upper.mesh.rows=1"},
        {"particle.lower.mesh.columns=1"},
        {"particle.lower.mesh.columns=1", "particle.lower.mesh.rows=1"},
        {"particle.lower.mesh.columns=1", "particle.lower.mesh.rows=1",
         "particle.upper.mesh.columns=2", "particle.upper.mesh.rows=1"}}) {
    Experiment e("basic/patch-test.toml", mesh);
    e.run(5);
    const std::vector<double> s = e.results.frame()[4];
    ASSERT_EQ(e.results.fields()[4].name, "stress");
    const double force = 0.5 * (e.value("tool/top/force_y") - e.value("tool/bottom/force_y"));
    const double pressure = force / (10e-3 * e.scene.thickness);
    for (std::size_t c = 0; c < s.size() / 4; ++c) {
      EXPECT_NEAR(-s[4 * c + 1] / pressure, 1, 0.004) << mesh[0] << ", element " << c;
      EXPECT_NEAR(s[4 * c] / pressure, 0, 0.004);
      EXPECT_NEAR(s[4 * c + 3] / pressure, 0, 0.004);
    }
  }
}

// A block of the patch test as a polygon, meshed by an O-grid of skewed quads: how far its stresses are from
// the uniform one.
double patch_error(const std::string& stiffness) {
  Experiment e(
      with_outline("basic/patch-test.toml",
                   "outline = \"polygon\"\ncorners = [[\"0 mm\", \"0 mm\"], [\"10 mm\", \"0 "
                   "mm\"], [\"10 mm\", \"5 mm\"], [\"0 mm\", \"5 mm\"]]\n\n"
                   "[particle.mesh]\nboundary_edges = 24",
                   {"contact.stiffness=" + stiffness}));
  e.run(5);
  const std::vector<double> s = e.results.frame()[4];
  const double force = 0.5 * (e.value("tool/top/force_y") - e.value("tool/bottom/force_y"));
  const double pressure = force / (10e-3 * e.scene.thickness);
  double maximum = 0;
  for (std::size_t c = 0; c < s.size() / 4; ++c)
    maximum = std::max({maximum, std::abs(s[4 * c + 1] / pressure + 1),
                        std::abs(s[4 * c] / pressure), std::abs(s[4 * c + 3] / pressure)});
  return maximum;
}

// The springs of the contact are as soft as the element behind them is thick, which is not the same along an
// O-grid's boundary: the surface sinks in unevenly, the less the stiffer they are. Nothing else is left.
TEST(PatchTest, UniformPressureCrossesAStarMesh) {
  const double soft = patch_error("0.5"), stiff = patch_error("8");
  EXPECT_LT(soft, 0.02);
  EXPECT_LT(stiff, 0.003);
  EXPECT_GT(soft / stiff, 5);
}

// Kinetic energy of a spin: half of thickness rho omega^2 times the polar moment of the area.
TEST(SpinningEllipse, HasItsEnergyAndKeepsIt) {
  Experiment e(with_outline("basic/spinning-disc.toml",
                            "outline = \"ellipse\"\nwidth = \"12 mm\"\nheight = \"6 mm\"\n\n"
                            "[particle.mesh]\nsize = \"0.4 mm\"",
                            {"stage.spin.duration=1 ms", "body[0].angular_velocity=5e3 rad/s"}));
  const double a = 6e-3, b = 3e-3;
  const double moment = std::numbers::pi / 4 * a * b * (a * a + b * b);
  const double expected = 0.5 * e.scene.thickness * 7850 * 5e3 * 5e3 * moment;
  e.run(20);
  // Masses at the corners of elements instead of within them: (0.4 mm)^2 / (a^2 + b^2), at most.
  EXPECT_NEAR(e.value("energy/kinetic") / expected, 1, 0.005);
  EXPECT_LT(e.results.energy_balance_error(), 1e-3);
}

// An ellipse of equal axes is a disc: its own mesh, crushed alike.
TEST(Ellipse, OfEqualAxesIsCrushedLikeADisc) {
  const auto force = [](const std::string& outline) {
    Experiment e(
        with_outline("basic/rounded-corner.toml", outline,
                     {"tool.bottom.point=[\"0 mm\", \"-5 mm\"]",
                      "tool.top.point=[\"0 mm\", \"5 mm\"]", "stage.press.duration=0.3 ms"}));
    e.run(10);
    return e.value("tool/top/force_y");
  };
  const double disc =
      force("outline = \"disc\"\ndiameter = \"10 mm\"\n\n[particle.mesh]\nsize = \"0.4 mm\"");
  const double ellipse = force(
      "outline = \"ellipse\"\nwidth = \"10 mm\"\nheight = \"10 mm\"\n\n[particle.mesh]\nsize = "
      "\"0.4 mm\"");
  EXPECT_GT(disc, 0);
  EXPECT_NEAR(ellipse / disc, 1, 0.03);  // two meshes of the same size: 1 to 2% (docs/accuracy.md)
}

}  // namespace
}  // namespace pulvis
