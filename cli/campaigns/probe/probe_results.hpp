// Results of probing a powder: a surface for every path, density, seed and criterion, and the models fitted to it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/campaigns/probe/cap_models.hpp"
#include "cli/campaigns/probe/probe_spec.hpp"
#include "cli/campaigns/study/study_results.hpp"

namespace pulvis {

// A state saved by a loading run.
struct ProbeState {
  std::string path;
  std::int64_t seed = 1;
  double asked = 0;                // -, density requested in the probe file
  std::string loading;             // name of the run
  double density = 0;              // -, relative, as reached
  std::array<double, 4> stress{};  // Pa: xx yy xy zz
  double pressure = 0;             // Pa
  bool bonded = false;             // whether its scene has bonds
};

// All states that the loading run has reached.
// `passed`: gets one line for each density already exceeded before the powder is compacted to it; it has no state.
std::vector<ProbeState> states_of(const ProbeLoading& loading, const ProbeSpec& spec,
                                  const StudyResult& result, std::vector<std::string>& passed);

struct ProbeSurface {
  const ProbeState* state = nullptr;
  PowderModuli moduli;
  std::optional<double> spring_share;  // -, of the energy released in its runs: mean
  std::vector<YieldPoint> offset, dissipation;
  std::vector<FittedModel> offset_models, dissipation_models;
};

// Of the run from this state in the direction `angle`, rad; none: the shear run.
std::string name_of_run(const ProbeState& state, std::optional<double> angle);

// `angle` of each run from this state; none: the shear run.
struct ProbeRun {
  std::optional<double> angle;
  const StudyResult* result = nullptr;
};
ProbeSurface surface_of(const ProbeState& state, const ProbeSpec& spec,
                        const std::vector<ProbeRun>& runs);

}  // namespace pulvis
