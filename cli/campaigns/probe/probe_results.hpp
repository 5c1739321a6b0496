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
  const ProbeLoading* loading = nullptr;
  double asked = 0;                // -, density requested in the probe file
  double density = 0;              // -, relative, as reached
  Mandel stress = Mandel::Zero();  // Pa
  double coordination = 0;         // -, mean number of other particles that a particle touches
  Mandel fabric = Mandel::Zero();  // -, mean of n n over the contacts; trace 1
  double pressure() const { return pressure_of(stress); }  // Pa
  bool bonded() const { return !loading->scene.scene.bonds.empty(); }
  bool in_space() const { return loading->scene.scene.in_space(); }
};

// All states that the loading run has reached.
// `passed`: gets one line for each density already exceeded before the powder is compacted to it; it has no state.
std::vector<ProbeState> states_of(const ProbeLoading& loading, const ProbeSpec& spec,
                                  const StudyResult& result, std::vector<std::string>& passed);

// Pa, at the end of the run.
Mandel stress_at_end(const StudyResult& result);

struct ProbeSurface {
  const ProbeState* state = nullptr;
  PowderModuli moduli;
  Mandel centre = Mandel::Zero();      // Pa, unloaded, where the probes began: mean
  std::optional<double> spring_share;  // -, of the energy released on unloading
  std::vector<YieldPoint> offset, dissipation;
  std::vector<FittedModel> offset_models, dissipation_models;
  ProbedPowder powder() const;
};

// Of the run that unloads this state, and of those that probe it.
std::string name_of_release(const ProbeState& state);
std::string name_of_run(const ProbeState& state, const ProbeDirection& direction);

struct ProbeRun {
  ProbeDirection direction;
  const StudyResult* result = nullptr;
};
ProbeSurface surface_of(const ProbeState& state, const ProbeSpec& spec, const StudyResult& release,
                        const std::vector<ProbeRun>& runs);

}  // namespace pulvis
