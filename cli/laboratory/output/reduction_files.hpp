// Output files of a reduction: reduced-<run>.csv, curves.csv, summary.json, report.html.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/laboratory/lab_reduction.hpp"
#include "cli/laboratory/lab_simulation.hpp"

namespace pulvis {

struct Reduction {
  lab::LoadedSettings loaded;
  std::vector<lab::PressRecord> presses;  // one per run, in the order of loggers and runs
  std::vector<lab::LoggerRecord> loggers;
  std::vector<lab::ReducedRun> runs;
  std::vector<lab::RunSpec> specs;
  std::vector<lab::SimulatedCurve> simulations;
  lab::Repeatability over_runs;
};

// Replaces the files of an earlier reduction; others in the folder stay.
void write_reduction(const std::filesystem::path& folder, const Reduction& reduction);

// One run's curve, as written to reduced-<run>.csv, and its entry in summary.json.
std::string run_csv(const lab::Curve& curve);
nlohmann::ordered_json run_json(const lab::ReducedRun& run);

// Content of summary.json, all in SI units.
nlohmann::ordered_json reduction_json(const Reduction& reduction);

}  // namespace pulvis
