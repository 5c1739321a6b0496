// Levers for tests, as scene texts, and their calibrations.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "scenes/afm_scene.hpp"
#include "scenes/afm_simulation.hpp"
#include "scenes/read.hpp"

namespace pulvis {

inline constexpr const char* beam_with_tip = R"(family = "afm"

[[material]]
name = "lever"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3

[[material]]
name = "stiff"
youngs_modulus = "10 TPa"
poissons_ratio = 0.3

[lever]
shape = "beam"
material = "lever"
length = "440 um"
width = "50 um"
thickness = "2.2 um"

[tip]
shape = "block"
material = "stiff"
height = "12.6 um"
foot = "2 um"
set_back = "1 um"
)";

inline std::string tipless_beam() {
  const std::string text(beam_with_tip);
  return text.substr(0, text.find("[tip]"));
}

inline Scene afm_scene(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return load_scene_text(text, "test.toml", overrides).scene;
}

inline Calibration calibration_of(const std::string& text,
                                  const std::vector<std::string>& overrides = {}) {
  const Scene scene = afm_scene(text, overrides);
  return AfmSimulation(scene).calibrate();
}

inline Scene shipped_afm(const std::string& file, const std::vector<std::string>& overrides = {}) {
  return read_scene(std::string(PULVIS_SOURCE_DIR) + "/scenes/afm/" + file, overrides);
}

}  // namespace pulvis
