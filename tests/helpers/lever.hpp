// Levers for tests, as scene texts, and their calibrations.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "scenes/lever/afm_simulation.hpp"
#include "scenes/read.hpp"
#include "scenes/spec/afm_scene.hpp"
#include "tests/helpers/paths.hpp"

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

// The same on a coarse mesh of plates alone, for laws that hold on any mesh.
inline std::string on_plates(const std::string& lever) {
  const std::size_t at = lever.find('\n', lever.find("thickness = ")) + 1;
  return lever.substr(0, at) + "side_aspect = 100\nfoot_edge = 0.5\nfoot_layers = 0\n" +
         lever.substr(at);
}
inline const std::string coarse_beam_text = on_plates(beam_with_tip);
inline const char* const coarse_beam = coarse_beam_text.c_str();

// Pressed to a force in three steps, then a trace and a retrace at that force.
inline std::string press_and_scan(int increments, const std::string& force = "100 nN") {
  return "[[action]]\nkind = \"press\"\nforce = \"" + force +
         "\"\nincrements = 3\n"
         "[[action]]\nkind = \"scan\"\ndistance = \"4 nm\"\nset_point = \"force\"\nincrements = " +
         std::to_string(increments) + "\n";
}

inline std::string inclined_plane(double degrees, double friction) {
  return "[surface]\nshape = \"plane\"\nfriction = " + std::to_string(friction) + "\nincline = \"" +
         std::to_string(degrees) + " deg\"\n";
}

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
  return read_scene(paths::source_dir() + "/scenes/afm/" + file, overrides);
}

}  // namespace pulvis
