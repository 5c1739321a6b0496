// A right scene with one of everything, for tests that make it wrong, and the problems found then.
#pragma once

#include "scenes/read.hpp"
#include "tests/helpers/wrong.hpp"

#include <gtest/gtest.h>

namespace pulvis {

inline constexpr const char* right_scene = R"(family = "compaction"
title = "right"
thickness = "1 mm"

[[material]]
name = "316L"
density = "7990 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
yield_stress = "240 MPa"
hardening_modulus = "440 MPa"

[[particle]]
name = "grain"
material = "316L"
outline = "disc"
diameter = "10 mm"

[particle.mesh]
boundary_edges = 40
rings = 1

[[particle]]
name = "block"
material = "316L"
outline = "rectangle"
width = "20 mm"
height = "10 mm"

[[body]]
particle = "block"
position = ["10 mm", "25 mm"]

[[packing]]
kind = "square"
particle = "grain"
rows = 2
columns = 2

[[tool]]
name = "bottom"
shape = "plane"
point = ["0 mm", "0 mm"]
normal = [0, 1]

[[tool]]
name = "top"
shape = "plane"
point = ["0 mm", "30 mm"]
normal = [0, -1]

[[stage]]
name = "press"
kind = "compact"
duration = "1 ms"

[[stage.move]]
tool = "top"
displacement = ["0 mm", "-1 mm"]

[[friction]]
between = ["316L", "bottom"]
coefficient = 0.3

[time]
safety = 0.5
)";

inline std::vector<SceneProblem> problems_of(const std::string& text,
                                             const std::vector<std::string>& overrides = {}) {
  auto problems = problems_in([&] { load_scene_text(text, "wrong.toml", overrides); });
  EXPECT_FALSE(problems.empty()) << "the scene was accepted";
  return problems;
}

}  // namespace pulvis
