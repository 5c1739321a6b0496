// Cold welding: bonds that pressure makes.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/helpers/experiment.hpp"
#include "tests/physics/stone_pieces.hpp"

namespace pulvis {
namespace {

// Pressed, unloaded and without walls: how many boundary edges still touch another particle.
double touching_after_ejection(const char* scene, const std::vector<std::string>& more) {
  std::vector<std::string> overrides{
      "packing[0].width=40 mm", "packing[0].class[0].number=16",
      "tool.right.point=[\"40 mm\", \"0 mm\"]",
      "stage.press.move.top.displacement=[\"0 mm\", \"-3.75 mm\"]",
      "stage.press.move.bottom.displacement=[\"0 mm\", \"3.75 mm\"]"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  Experiment e(scene, overrides);
  double largest = 0;
  e.run(40, [&] { largest = std::max(largest, e.value("contacts")); });
  EXPECT_GT(largest, 100);
  EXPECT_LT(e.results.energy_balance_error(), 0.01);
  return e.value("contacts");
}

TEST(Glue, OfColdWeldingHoldsACompactTogether) {
  // One or two touch as they fly past each other.
  EXPECT_LE(touching_after_ejection("bonds/loose-compact.toml", {}), 2);
  EXPECT_GT(touching_after_ejection(
                "bonds/green-strength.toml",
                {"stage.split.duration=1 us",
                 "stage.split.move.left-platen.displacement=[\"1e-6 mm\", \"0 mm\"]",
                 "stage.split.move.right-platen.displacement=[\"-1e-6 mm\", \"0 mm\"]"}),
            50);
}

// A block pressed onto another and lifted: every step is looked at, those in which points weld, too.
TEST(Glue, OfColdWeldingIsCountedOnceInEveryStep) {
  Experiment e(own_scene(std::string(bar_material) + piece("base", 3, 0) + piece("head", 1, 0, 1) +
                         R"(
[[bond]]
between = ["stone", "stone"]
origin = "pressed"
strength = "40 MPa"
fracture_energy = "200 J/m^2"
threshold = "20 MPa"
growth = 0.1
[[stage]]
name = "press"
kind = "compact"
duration = "20 us"
move = [{ tool = "head", displacement = ["0 mm", "-4 um"] }]
[[stage]]
name = "part"
kind = "unload"
duration = "20 us"
move = [{ tool = "head", displacement = ["0 mm", "20 um"] }]
)" + grip("base", 0, {-2, -.6, 2, .6}, "both") +
                         grip("head", 1, {-.6, .4, .6, 1.6}, "both")));
  double area = 0, work = 0;
  e.run(8000, [&] {
    area = std::max(area, e.value("bonds/area"));
    work = std::max(work, e.value("energy/contact"));
  });
  EXPECT_NEAR(area, 1e-6, 0.2e-6);
  EXPECT_GT(work, 1e-5);
  EXPECT_LT(e.results.energy_balance_error(), 1e-4);
}

// Points that slide past a corner are closest to the corner itself. They are not unloaded, and weld no more.
TEST(Glue, OfColdWeldingIsNotMadeBesideACorner) {
  Experiment e(own_scene(std::string(bar_material) + R"(
[[particle]]
name = "wedge"
material = "stone"
outline = "polygon"
corners = [["-0.6 mm", "0.3 mm"], ["0 mm", "-0.5 mm"], ["0.6 mm", "0.3 mm"]]
mesh = { boundary_edges = 40 }
[[particle]]
name = "slider"
material = "stone"
outline = "rectangle"
width = "1 mm"
height = "0.5 mm"
mesh = { columns = 8, rows = 4 }
[[body]]
particle = "wedge"
position = ["0 mm", "0 mm"]
[[body]]
particle = "slider"
position = ["0.2 mm", "0.518 mm"]
[[bond]]
between = ["stone", "stone"]
origin = "pressed"
strength = "10 MPa"
fracture_energy = "20 J/m^2"
threshold = "5 MPa"
growth = 0.5
[[stage]]
name = "press"
kind = "compact"
duration = "60 us"
move = [{ tool = "head", displacement = ["0 mm", "-0.006 mm"] }]
[[stage]]
name = "slide"
kind = "compact"
duration = "200 us"
move = [{ tool = "head", displacement = ["0.3 mm", "0 mm"] }]
)" + grip("base", 0, {-.5, -.8, .5, -.05}, "both") +
                         grip("head", 1, {-1, .7, 1, 1}, "both")));
  e.run(200);
  EXPECT_GT(e.value("bonds/crack_length"), 1e-4);
  EXPECT_LT(e.results.energy_balance_error(), 1e-3);
}

}  // namespace
}  // namespace pulvis
