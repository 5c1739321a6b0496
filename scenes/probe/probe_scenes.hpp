// The scenes that a probe runs, as TOML: made from those of its paths.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "scenes/probe/probe.hpp"

namespace pulvis {

// The scene of the path, its last stage once for every density, whose state is kept. A density's stage is called by it.
std::string loading_scene(const LoadedScene& scene, const ProbeSpec& spec);
std::string density_name(double density);  // "0.85"

// From a state: unloaded, then probed. `angle` in rad; none: sheared.
struct ProbeStart {
  std::string state;               // path of the file, from the scene's folder
  std::array<double, 2> stress{};  // Pa, of the state: xx yy
  double pressure = 0;             // Pa, of the state
};
std::string probing_scene(const LoadedScene& scene, const ProbeSpec& spec, const ProbeStart& start,
                          std::optional<double> angle);

// Names of its stages.
inline constexpr const char* release_stage = "release";
inline constexpr const char* probe_stage = "probe";

}  // namespace pulvis
