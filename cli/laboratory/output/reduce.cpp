#include "cli/laboratory/output/reduce.hpp"

#include "cli/laboratory/output/compression_output.hpp"
#include "cli/laboratory/output/die_output.hpp"
#include "cli/laboratory/output/matrix_output.hpp"
#include "cli/laboratory/output/reduction_report.hpp"
#include "cli/laboratory/output/wedge_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "cli/laboratory/output/reduction_files.hpp"
#include "cli/laboratory/output/volts_report.hpp"
#include "cli/laboratory/output/wedge_files.hpp"
#include "cli/laboratory/wedge_records.hpp"
#include "cli/tell.hpp"
#include "engine/files/own_files.hpp"
#include "engine/files/run_folder.hpp"
#include "scenes/language/counted.hpp"
#include "scenes/language/csv_table.hpp"

namespace pulvis {
namespace {

using Paths = std::vector<std::filesystem::path>;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& key,
                         const std::string& message) {
  throw SceneError({{file.string(), 1, 1, "", key, message}});
}

struct Inputs {
  std::filesystem::path settings;  // empty: none
  Paths records;
};

Inputs sorted_inputs(const Paths& files) {
  Inputs inputs;
  for (const std::filesystem::path& file : files) {
    if (!std::filesystem::exists(file))
      refuse(file, "records", "there is no such file, allowed: records (CSV) and settings (.toml)");
    if (file.extension() != ".toml") {
      inputs.records.push_back(file);
      continue;
    }
    if (!inputs.settings.empty())
      refuse(file, "settings", "is a second settings file, allowed: one (.toml)");
    inputs.settings = file;
  }
  return inputs;
}

std::vector<lab::RunFiles> files_of(const std::vector<lab::RunSpec>& specs,
                                    const std::filesystem::path& folder) {
  std::vector<lab::RunFiles> runs;
  for (const lab::RunSpec& run : specs)
    runs.push_back({run.name, folder / run.press, folder / run.logger, run.offset});
  return runs;
}

// The first press record belongs to the first logger record, and so on.
std::vector<lab::RunSpec> pairs_of(const Paths& records, const lab::Settings& settings) {
  Paths presses, loggers;
  for (const std::filesystem::path& file : records) {
    const bool is_press = lab::instrument_of(file, settings) == lab::Instrument::press;
    (is_press ? presses : loggers).push_back(file);
  }
  if (presses.size() != loggers.size())
    refuse(presses.size() > loggers.size() ? presses.back() : loggers.back(), "records",
           fmt::format("{} of the press and {} of the logger are given, allowed: one of each for "
                       "every run, in the same order",
                       presses.size(), loggers.size()));
  std::vector<lab::RunSpec> runs;
  for (std::size_t i = 0; i < presses.size(); ++i) {
    lab::RunSpec run;
    run.name = fmt::format("run-{}", settings.runs.size() + i + 1);
    run.press = std::filesystem::absolute(presses[i]).string();
    run.logger = std::filesystem::absolute(loggers[i]).string();
    runs.push_back(run);
  }
  return runs;
}

void name_runs(std::vector<lab::RunFiles>& runs) {
  std::set<std::string> taken;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].name.empty()) runs[i].name = fmt::format("run-{}", i + 1);
    if (!taken.insert(runs[i].name).second)
      refuse(runs[i].press, "run.name",
             fmt::format("'{}' is the name of another run, allowed: each name once", runs[i].name));
  }
}

// Without settings that give a header line, a record that cannot be read is wrong itself; otherwise the reader of its
// instrument reports it. First of all, since without records the settings would be said to be incomplete.
void require_readable(const Inputs& inputs, const std::vector<std::string>& overrides) {
  const auto gives_header = [](const std::string& setting) {
    return setting.find("header_line") != std::string::npos;
  };
  if (!inputs.settings.empty() || std::ranges::any_of(overrides, gives_header)) return;
  for (const std::filesystem::path& file : inputs.records) csv::read(file, {0, true});
}

void refuse_simulations(const ReduceOptions& options) {
  if (!options.simulations.empty())
    refuse(options.simulations.front(), "simulation",
           "is not compared with an AFM calibration, allowed: --simulation with sliding-plate "
           "tests, compression curves and instrumented dies");
}

// A file of friction loops among the records determines the kind of reduction.
lab::LoadedSettings settings_of(const Inputs& inputs, std::vector<std::string> overrides) {
  require_readable(inputs, overrides);
  const auto loops = std::ranges::find_if(inputs.records, wedge::holds_loops);
  if (loops != inputs.records.end()) {
    if (inputs.records.size() > 1)
      refuse(*loops, "records",
             "friction loops together with other records, allowed: one file of loops");
    const std::string path = std::filesystem::absolute(*loops).string();
    overrides.push_back("wedge.loops=" + document::value_text({path, {}}));
  }
  return lab::load_settings(inputs.settings, overrides);
}

Reduction reduced(const ReduceOptions& options, const Inputs& inputs,
                  const lab::LoadedSettings& loaded) {
  Reduction all;
  all.loaded = loaded;
  const lab::Settings& settings = all.loaded.settings;
  std::vector<lab::RunSpec> runs = settings.runs;
  const std::vector<lab::RunSpec> given = pairs_of(inputs.records, settings);
  if (!given.empty() && !runs.empty() && runs.front().has_condition())
    refuse(given.front().press, "records",
           "has no condition, allowed: [[run]] tables alone, each with the condition");
  lab::add_runs(all.loaded, given);
  runs.insert(runs.end(), given.begin(), given.end());
  std::vector<lab::RunFiles> files = files_of(runs, settings.file.parent_path());
  if (files.empty())
    refuse(settings.file, "run",
           "there is none, allowed: [[run]] tables, or records (CSV) on the command line");
  name_runs(files);
  for (const lab::RunFiles& run : files) {
    all.presses.push_back(lab::read_press(run.press, settings));
    all.loggers.push_back(lab::read_logger(run.logger, settings));
    const lab::Settings own = settings.of_run(runs[all.runs.size()]);
    all.runs.push_back(lab::reduce(all.presses.back(), all.loggers.back(), own, run));
  }
  all.specs = runs;
  for (const std::filesystem::path& folder : options.simulations)
    all.simulations.push_back(lab::read_simulation(folder, settings.simulation.target));
  all.over_runs = lab::repeatability(all.runs, settings.analysis.distance_step);
  return all;
}

std::vector<std::string> files_of(const Reduction& all) {
  std::vector<std::string> files{"reduce.toml", "summary.json", "report.html", "curves.csv"};
  for (const lab::ReducedRun& run : all.runs) files.push_back("reduced-" + run.name + ".csv");
  return files;
}

// `files` are what will be written. None of them may be a foreign file, or one that is being read.
void open_folder(const ReduceOptions& options, const std::vector<std::string>& files) {
  const std::filesystem::path& folder = options.folder;
  for (const std::string& file : files) {
    for (const std::filesystem::path& read : options.files) require_another(read, folder / file);
    require_own_or_none(folder / file, role::reduction);
  }
  if (std::filesystem::exists(folder / "run.h5"))
    throw RunFolderTaken(folder, "write", "it holds a run; allowed: a folder of its own");
  if (std::filesystem::exists(folder / "summary.json") && !options.overwrite)
    throw RunFolderTaken(folder, "write",
                         "it holds results already; allowed: another folder, or --overwrite");
  make_results_folder(folder);
}

std::string with_error(const char* name, const lab::Sample& sample, double confidence) {
  const auto half = lab::half_width(sample, confidence);
  if (!half) return fmt::format("{} {:.4f}", name, sample.mean);
  return fmt::format("{} {:.4f} +- {:.4f} ({:g} % of {}; standard deviation {:.4f})", name,
                     sample.mean, *half, 100 * confidence, counted(sample.count, "run"),
                     sample.deviation);
}

void print_run(const lab::ReducedRun& run) {
  tell("{}: static {:.4f} at {:.2f} mm{}, dynamic {:.4f}", run.name, run.peak.value,
       run.peak.distance * 1e3, run.peak.is_distinct ? "" : " (not distinct)", run.dynamic.mean);
  if (run.elastic_dynamic) tell(" ({:.4f} with K = nu/(1 - nu))", *run.elastic_dynamic);
  if (run.stick_slip)
    tell(", stick-slip {:.4f} every {:.2f} mm", run.stick_slip->amplitude,
         run.stick_slip->period * 1e3);
  const lab::Clocks& clocks = run.clocks;
  tell("; clock offset {:.3f} s", clocks.offset);
  if (clocks.is_given) tell(" as given");
  if (!clocks.is_given) tell(" +- {:.3f} s", clocks.offset_uncertainty);
  if (clocks.drift)
    tell(", drift {:.1e} +- {:.1e}{}", *clocks.drift, clocks.drift_uncertainty,
         clocks.is_drift_applied ? "" : " (not applied)");
  tell("\n");
}

// On standard error: results on standard output may go to a file.
void warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) tell(stderr, "warning: {}\n", warning);
}

ExitCode reduce_volts(const ReduceOptions& options, const Inputs& inputs,
                      const lab::LoadedSettings& loaded) {
  if (!inputs.records.empty())
    refuse(inputs.records.front(), "records",
           "is given together with settings that have afm.loops, allowed: files that the settings "
           "name");
  const VoltsReduction done = volts_reduction(loaded);
  open_folder(options, volts_files());
  write_volts(options.folder, done);
  write_volts_report(options.folder, done);
  if (done.reduced.slopes) warn(wedge_warnings(*done.reduced.slopes));
  tell("{}results in {}\n", volts_text(done), options.folder.string());
  return ExitCode::done;
}

void write_output(const ReduceOptions& options, const LabOutput& output,
                  const lab::LoadedSettings& loaded) {
  open_folder(options, output.names());
  write_lab(options.folder, output, loaded);
  tell("{}results in {}\n", output.told, options.folder.string());
}

// Kinds whose records are named only in the settings.
std::optional<LabOutput> output_of(const ReduceOptions& options,
                                   const lab::LoadedSettings& loaded) {
  if (!loaded.settings.curves.empty()) return compression_output(loaded, options.simulations);
  if (!loaded.settings.transmissions.empty()) return die_output(loaded, options.simulations);
  return std::nullopt;
}

}  // namespace

ExitCode reduce_records(const ReduceOptions& options) {
  const Inputs inputs = sorted_inputs(options.files);
  const lab::LoadedSettings loaded = settings_of(inputs, options.overrides);
  if (loaded.settings.volts.wanted()) {
    refuse_simulations(options);
    return reduce_volts(options, inputs, loaded);
  }
  if (const auto output = output_of(options, loaded)) {
    if (!inputs.records.empty())
      refuse(
          inputs.records.front(), "records",
          "is given together with settings that name their records, allowed: the settings alone");
    write_output(options, *output, loaded);
    return ExitCode::done;
  }
  if (!loaded.settings.wedge.loops.empty()) {
    refuse_simulations(options);
    const WedgeReduction calibrated = wedge_reduction(loaded);
    open_folder(options, {"reduce.toml", "summary.json", "report.html", "facets.csv"});
    write_wedge(options.folder, calibrated);
    write_wedge_report(options.folder, calibrated);
    warn(wedge_warnings(calibrated.calibration));
    tell("{}results in {}\n", wedge_text(calibrated.calibration), options.folder.string());
    return ExitCode::done;
  }
  const Reduction all = reduced(options, inputs, loaded);
  if (all.specs.front().has_condition()) {
    write_output(options, matrix_output(all), all.loaded);
    return ExitCode::done;
  }
  open_folder(options, files_of(all));
  write_reduction(options.folder, all);
  write_reduction_report(options.folder, all);
  for (const lab::ReducedRun& run : all.runs) print_run(run);
  const double confidence = all.loaded.settings.analysis.confidence;
  tell("{}; {}\n", with_error("static", all.over_runs.peak, confidence),
       with_error("dynamic", all.over_runs.dynamic, confidence));
  tell("results in {}\n", options.folder.string());
  return ExitCode::done;
}

}  // namespace pulvis
