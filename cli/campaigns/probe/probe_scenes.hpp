// The scenes that a probe runs, as TOML: derived from those of its paths.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "cli/campaigns/probe/probe_spec.hpp"

namespace pulvis {

// The path's scene, its last stage repeated for every density, where the state is saved. Stages are named by density.
std::string loading_scene(const LoadedScene& scene, const ProbeSpec& spec);
std::string density_name(double density);  // "0.85"

// Starts from a state: unloads, then probes. `angle` in rad; none: shear.
struct ProbeStart {
  std::string state;               // path of the file, relative to the scene's folder
  std::array<double, 2> stress{};  // Pa, of the state: xx yy
  double pressure = 0;             // Pa, of the state
};
std::string probing_scene(const LoadedScene& scene, const ProbeSpec& spec, const ProbeStart& start,
                          std::optional<double> angle);

// Names of its stages.
inline constexpr const char* release_stage = "release";
inline constexpr const char* probe_stage = "probe";

}  // namespace pulvis
