// summary.json: the figures of a run that people and scripts look up first.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/identity.hpp"
#include "cli/step_limits.hpp"
#include "engine/task_graph.hpp"
#include "scenes/expectations.hpp"
#include "scenes/ranks/balance.hpp"
#include "scenes/results/compaction_curve.hpp"
#include "scenes/results/contact_findings.hpp"
#include "scenes/results/results.hpp"
#include "scenes/results/run_quality.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

struct RunCost {
  double wall_seconds = 0;
  std::int64_t steps = 0;
  int threads = 1;  // per rank
  std::string scene_hash, outcome;
  std::vector<SystemCost> systems;
  double bytes_a_step = 0;             // that all ranks together sent per step
  std::vector<double> rank_memory{};   // bytes, peak of each rank; empty for a single process
  std::vector<double> rank_seconds{};  // s, current cost of each rank per step; empty if not known
  std::vector<Rebalancing> rebalancings{};
  std::string state_hash{};
};

// What the user should know about a run's figures.
struct RunQuality {
  ContactFindings contacts;
  std::vector<QualityFigure> figures;
  std::vector<std::string> warnings;  // one line each
  StepLimits steps = {};

  std::vector<std::string> lines() const;  // warnings, and advice for figures beyond their limits
};

void write_summary(const std::filesystem::path& folder, const Scene& scene, const World& world,
                   const Results& results, const CompactionCurve& curve, const RunQuality& quality,
                   const RunCost& cost, const std::vector<Verdict>& verdicts);

// Prints the file as written to standard output.
void print_summary(const std::filesystem::path& folder);

}  // namespace pulvis
