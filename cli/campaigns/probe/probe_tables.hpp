// The tables of a probe: yield_points.csv, moduli.csv, caps.csv, and the one for the terminal.
#pragma once

#include <string>
#include <vector>

#include "cli/campaigns/probe/keyword_blocks.hpp"
#include "cli/campaigns/probe/probe_groups.hpp"

namespace pulvis {

std::string points_csv(const std::vector<ProbeSurface>& surfaces);
std::string moduli_csv(const std::vector<ProbeSurface>& surfaces);
std::string caps_csv(const std::vector<ProbeGroup>& groups);

// A row for every density of the path that has a cap, by the dissipated energy.
std::vector<CapRow> cap_rows(const std::string& path, const std::vector<ProbeGroup>& groups);

// The fits to the pooled points, for the terminal.
std::string caps_text(const std::vector<ProbeGroup>& groups);

}  // namespace pulvis
