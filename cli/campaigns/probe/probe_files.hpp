// Output files of a probe, besides its runs:
//   yield_points.csv  one row per state, direction, criterion: stresses, p, q, plastic strain, angle to the normal
//   moduli.csv        one row per state: stiffness, E, nu, symmetry, coordination number, fabric tensor
//   caps.csv          one row per surface and model: parameters and misfit; `all` in place of a seed: over all seeds
//   summary.json      the same, with the surfaces of the models as drawn
//   report.html       the same, to look at in a browser (cli/report/page/probe.js)
//   <path>.inp        Abaqus, by the dissipated-energy criterion
//   <path>.comm       code_aster, the same
//   <path>.k          LS-DYNA, the same
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/campaigns/probe/probe_groups.hpp"

namespace pulvis {

// Densities without a cap are left out of the keyword blocks.
void write_probe(const std::filesystem::path& folder, const Probe& probe,
                 const std::vector<ProbeSurface>& surfaces, const std::vector<ProbeGroup>& groups,
                 double wall_seconds);

}  // namespace pulvis
