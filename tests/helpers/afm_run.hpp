// Programmes for tests: what they leave behind.
#pragma once

#include <string>

#include "scenes/lever/afm_loop.hpp"
#include "tests/helpers/lever.hpp"

namespace pulvis {

inline AfmHistory history_of(AfmSimulation& simulation) {
  AfmHistory history;
  simulation.run([&](double time, const std::vector<double>& row) {
    history.times.push_back(time);
    history.rows.push_back(row);
    return true;
  });
  return history;
}
inline AfmHistory history_of(const Scene& scene, int threads = 1) {
  AfmSimulation simulation(scene, threads);
  return history_of(simulation);
}

inline double last(const AfmHistory& h, const std::string& series) {
  return h.value(h.rows.size() - 1, series);
}

inline constexpr const char* v_with_tip = R"(family = "afm"

[[material]]
name = "lever"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3

[[material]]
name = "stiff"
youngs_modulus = "10 TPa"
poissons_ratio = 0.3

[lever]
shape = "v"
material = "lever"
length = "115 um"
arm_width = "20 um"
half_angle = "30 deg"
thickness = "0.6 um"

[tip]
shape = "block"
material = "stiff"
height = "3.7 um"
foot = "1 um"
set_back = "4 um"
)";
inline const std::string coarse_v_text = on_plates(v_with_tip);
inline const char* const coarse_v = coarse_v_text.c_str();

}  // namespace pulvis
