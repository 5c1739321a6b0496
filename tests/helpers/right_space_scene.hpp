// A right scene in three dimensions with one of everything, for tests that make it wrong.
#pragma once

#include <string>

namespace pulvis {

inline constexpr const char* right_space_scene = R"(family = "compaction"
dimension = 3
title = "right"

[[material]]
name = "316L"
density = "7990 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
yield_stress = "240 MPa"
hardening_modulus = "440 MPa"

[[particle]]
name = "ball"
material = "316L"
shape = "sphere"
diameter = "10 mm"

[particle.mesh]
divisions = 2
rings = 2

[[particle]]
name = "pill"
material = "316L"
shape = "cylinder"
diameter = "8 mm"
height = "6 mm"
rounding = "1 mm"

[particle.mesh]
divisions = 3
rings = 3

[[body]]
particle = "pill"
position = ["10 mm", "10 mm", "15 mm"]
angle = "30 deg"
axis = [0, 0, 1]

[[packing]]
kind = "cubic"
particle = "ball"
cells = [2, 2, 1]

[[tool]]
name = "bottom"
shape = "plane"
point = ["0 mm", "0 mm", "0 mm"]
normal = [0, 0, 1]

[[tool]]
name = "top"
shape = "plane"
point = ["0 mm", "0 mm", "20 mm"]
normal = [0, 0, -1]

[[stage]]
name = "press"
kind = "compact"
duration = "0.1 ms"

[[stage.move]]
tool = "top"
displacement = ["0 mm", "0 mm", "-1 mm"]

[[friction]]
between = ["316L", "bottom"]
coefficient = 0.3

[time]
safety = 0.5
)";

}  // namespace pulvis
