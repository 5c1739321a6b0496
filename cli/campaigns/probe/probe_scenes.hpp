// The scenes that a probe runs, as TOML: derived from those of its paths.
#pragma once

#include <string>

#include "cli/campaigns/probe/probe_directions.hpp"
#include "cli/campaigns/probe/probe_spec.hpp"

namespace pulvis {

// The path's scene, its last stage repeated for every density, where the state is saved. Stages are named by density.
std::string loading_scene(const LoadedScene& scene, const ProbeSpec& spec);
std::string density_name(double density);  // "0.85"

// Where a run starts: a saved state.
struct ProbeStart {
  std::string file;                // relative to the scene's folder
  Mandel stress = Mandel::Zero();  // Pa
  double pressure = 0;             // Pa, of the state that the powder was loaded to
};

// Unloads from the state of a loading run, and saves the state again: it is common to all probes.
std::string release_scene(const LoadedScene& scene, const ProbeSpec& spec, const ProbeStart& start);
inline constexpr const char* release_stage = "release";

// Probes from the unloaded state, with its stress.
std::string probing_scene(const LoadedScene& scene, const ProbeSpec& spec, const ProbeStart& start,
                          const ProbeDirection& direction);
inline constexpr const char* probe_stage = "probe";

std::string state_file(const std::string& stage);  // in the folder of the run that saves it

}  // namespace pulvis
