// What a probe leaves beside its runs:
//   yield_points.csv  a row for every state, direction and criterion: stresses, p, q, plastic strain, angle to the normal
//   moduli.csv        a row a state: c11, c12, c22, shear modulus, E, nu
//   caps.csv          a row for every surface and model: parameters and misfit; `all` in place of a seed: over all seeds
//   summary.json      the same, with the surfaces of the models as drawn
//   <path>.inp        Abaqus, by the dissipated energy
//   <path>.comm       code_aster, the same
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/probe/probe_results.hpp"

namespace pulvis {

// `file`: where a block goes. Densities that have no cap are left out.
void write_probe(const std::filesystem::path& folder, const Probe& probe,
                 const std::vector<ProbeSurface>& surfaces, double wall_seconds);

// The fits of the pooled points as a table for the terminal.
std::string caps_text(const Probe& probe, const std::vector<ProbeSurface>& surfaces);

}  // namespace pulvis
