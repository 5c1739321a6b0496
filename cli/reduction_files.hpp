// What a reduction leaves in its folder: reduced-<run>.csv, curves.csv, summary.json, report.html.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "scenes/records/lab_reduction.hpp"
#include "scenes/records/lab_simulation.hpp"

namespace pulvis {

struct Reduction {
  lab::LoadedSettings loaded;
  std::vector<lab::PressRecord> presses;  // one a run, as loggers and runs
  std::vector<lab::LoggerRecord> loggers;
  std::vector<lab::ReducedRun> runs;
  std::vector<lab::RunSpec> specs;
  std::vector<lab::SimulatedCurve> simulations;
  lab::Repeatability over_runs;
};

// Replaces the files of an earlier reduction; others in the folder stay.
void write_reduction(const std::filesystem::path& folder, const Reduction& reduction);

// One run's curve, as reduced-<run>.csv has it, and what summary.json says of it.
std::string run_csv(const lab::Curve& curve);
nlohmann::ordered_json run_json(const lab::ReducedRun& run);

// What summary.json holds, all in SI units.
nlohmann::ordered_json reduction_json(const Reduction& reduction);

}  // namespace pulvis
