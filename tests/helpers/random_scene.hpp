// Scenes with random packings, for tests.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

namespace pulvis {

inline constexpr const char* random_head = R"(family = "compaction"

[[material]]
name = "steel"
density = "7990 kg/m^3"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
yield_stress = "240 MPa"

)";

// The particles of the thesis and some others, by name.
inline std::string random_particle(const std::string& name) {
  const std::string outline =
      name == "large"    ? "outline = \"disc\"\ndiameter = \"10 mm\"\n"
      : name == "middle" ? "outline = \"disc\"\ndiameter = \"14 mm\"\n"
      : name == "small"  ? "outline = \"disc\"\ndiameter = \"4 mm\"\n"
      : name == "semi" ? "outline = \"rounded_rectangle\"\nwidth = \"15 mm\"\nheight = \"10 mm\"\n"
                         "radius = \"4 mm\"\n"
      : name == "square" ? "outline = \"rectangle\"\nwidth = \"10 mm\"\nheight = \"10 mm\"\n"
      : name == "ellipse"
          ? "outline = \"ellipse\"\nwidth = \"15 mm\"\nheight = \"10 mm\"\n"
          : "outline = \"polygon\"\nrounding = \"0.5 mm\"\ncorners = [[\"0 mm\", \"0 "
            "mm\"], [\"14 mm\", \"0 mm\"], [\"14 mm\", \"5 mm\"], [\"5 mm\", \"8 "
            "mm\"], [\"4 mm\", \"13 mm\"], [\"0 mm\", \"13 mm\"]]\n";
  return fmt::format("[[particle]]\nname = \"{}\"\nmaterial = \"steel\"\n{}\n", name, outline);
}

struct RandomClass {
  std::string particle;
  std::string keys;  // "number = 50"
};

// `die`: the keys of the packing, among them its width; particles are meshed roughly.
inline std::string random_scene(const std::string& die, const std::vector<RandomClass>& classes,
                                const std::string& right_wall) {
  std::string text = random_head;
  for (const RandomClass& c : classes) text += random_particle(c.particle);
  text += "[[packing]]\nkind = \"random\"\n" + die + "\n";
  for (const RandomClass& c : classes)
    text += fmt::format("\n[[packing.class]]\nparticle = \"{}\"\n{}\n", c.particle, c.keys);
  for (const auto& [name, point, normal] :
       {std::array<std::string, 3>{"left", "[\"0 mm\", \"0 mm\"]", "[1, 0]"},
        std::array<std::string, 3>{"right", "[\"" + right_wall + "\", \"0 mm\"]", "[-1, 0]"},
        std::array<std::string, 3>{"bottom", "[\"0 mm\", \"0 mm\"]", "[0, 1]"},
        std::array<std::string, 3>{"top", "[\"0 mm\", \"packing top\"]", "[0, -1]"}})
    text += fmt::format("\n[[tool]]\nname = \"{}\"\nshape = \"plane\"\npoint = {}\nnormal = {}\n",
                        name, point, normal);
  return text + R"(
[[stage]]
name = "press"
kind = "compact"
duration = "0.4 ms"

[[stage.move]]
tool = "top"
displacement = ["0 mm", "-2 mm"]

[contact]
damping = 0.1
friction = 0.1
)";
}

}  // namespace pulvis
