// Reads a probe file and the scenes of its paths. All errors are thrown as one SceneError before anything runs.
#pragma once

#include <string>
#include <vector>

#include "cli/campaigns/probe/probe_spec.hpp"

namespace pulvis {

// `overrides` change the scene of every path.
Probe load_probe(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

std::string probe_reference();  // docs/probe.md

}  // namespace pulvis
