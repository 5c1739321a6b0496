// A particle of salt, whole or of grains, by itself.
#pragma once

#include <fmt/format.h>

#include <string>

namespace pulvis {

struct Crystal {
  std::string outline = "outline = \"disc\"\ndiameter = \"10 mm\"";
  std::string grains{};  // table [particle.grains] and what stands above the bodies
  std::string motion{};  // of its body, and what follows the body
  std::string duration = "1 us";
  std::string head{};  // keys of the scene

  std::string text() const {
    return fmt::format(R"(family = "compaction"
{}
[[material]]
name = "salt"
density = "2160 kg/m^3"
youngs_modulus = "20 GPa"
poissons_ratio = 0.25
[[particle]]
name = "crystal"
material = "salt"
{}
{}
[[body]]
particle = "crystal"
position = ["0 mm", "0 mm"]
{}
[[stage]]
name = "free"
kind = "hold"
duration = "{}"
)",
                       head, outline, grains, motion, duration);
  }
};

}  // namespace pulvis
