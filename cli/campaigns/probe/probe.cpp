#include "cli/campaigns/probe/probe.hpp"

#include <fmt/format.h>

#include <chrono>
#include <map>
#include <set>

#include "cli/campaigns/probe/declare_probe.hpp"
#include "cli/campaigns/probe/probe_files.hpp"
#include "cli/campaigns/probe/probe_read.hpp"
#include "cli/campaigns/probe/probe_results.hpp"
#include "cli/campaigns/probe/probe_scenes.hpp"
#include "cli/campaigns/probe/probe_tables.hpp"
#include "cli/campaigns/study/saved_settings.hpp"
#include "cli/campaigns/study/study_runner.hpp"
#include "cli/interrupt.hpp"
#include "cli/results_folder.hpp"
#include "cli/save_scene.hpp"
#include "cli/tell.hpp"
#include "engine/files/own_files.hpp"
#include "engine/files/run_folder.hpp"
#include "scenes/language/counted.hpp"
#include "scenes/results/run_quality.hpp"
#include "scenes/spec/elastic_response.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;

constexpr const char* scenes_folder = "scenes";

void require_own_probe(const fs::path& folder, const Probe& probe) {
  std::vector<std::string> names{"probe.toml", "yield_points.csv", "moduli.csv",
                                 "caps.csv",   "summary.json",     "report.html"};
  for (const std::string& history : probe.histories)
    for (const char* ending : {".inp", ".comm", ".k"}) names.push_back(history + ending);
  for (const std::string& name : names) {
    require_another(probe.file, folder / name);
    require_own_or_none(folder / name, role::probe);
  }
  std::error_code ignored;
  if (fs::exists(folder / "run.h5", ignored) || fs::exists(folder / "study.toml", ignored))
    throw RunFolderTaken(folder, "probe here",
                         "it holds a run or a study; allowed: a folder of its own");
}

// The scene, written to a file in the probe's folder, as a run.
StudyRun written_run(const fs::path& folder, const std::string& name, const std::string& text) {
  StudyRun run;
  run.name = run.variation = name;
  run.file = folder / scenes_folder / (name + ".toml");
  write_own(run.file, role::probe, text);
  LoadedScene loaded = load_scene(run.file);
  run.scene = std::move(loaded.scene);
  run.hash = loaded.hash;
  return run;
}

std::vector<StudyRun> loading_runs(const fs::path& folder, const Probe& probe) {
  std::vector<StudyRun> runs;
  for (const ProbeLoading& loading : probe.loadings) {
    save_inputs(folder / scenes_folder, loading.scene.inputs);
    runs.push_back(written_run(folder, loading.name, loading_scene(loading.scene, probe.spec)));
  }
  return runs;
}

std::string state_of(const std::string& run, const std::string& stage) {
  return fmt::format("../{}/{}", run, state_file(stage));
}

StudyRun releasing_run(const fs::path& folder, const ProbeSpec& spec, const ProbeState& state) {
  const ProbeLoading& loading = *state.loading;
  const ProbeStart start{state_of(loading.name, density_name(state.asked)), state.stress,
                         state.pressure()};
  return written_run(folder, name_of_release(state), release_scene(loading.scene, spec, start));
}

// The runs from one state.
struct StateRuns {
  std::vector<ProbeDirection> directions;
  std::size_t first = 0;  // index in the list of all runs
};

StateRuns add_probes(const fs::path& folder, const ProbeSpec& spec, const ProbeState& state,
                     const StudyResult& release, std::vector<StudyRun>& runs) {
  StateRuns mine{{}, runs.size()};
  if (!release.usable) return mine;
  const ProbeStart start{state_of(name_of_release(state), release_stage), stress_at_end(release),
                         state.pressure()};
  mine.directions = directions_of(spec, state.in_space());
  for (const ProbeDirection& direction : mine.directions)
    runs.push_back(written_run(folder, name_of_run(state, direction),
                               probing_scene(state.loading->scene, spec, start, direction)));
  return mine;
}

// True if it ran to its end.
bool went(StudyRunner& runner, const char* what) {
  tell("{}: ", what);
  runner.go();
  if (!interrupted()) return true;
  tell(stderr,
       "pulvis: interrupted; {} of {} runs were finished; run the same command again to continue\n",
       runner.done(), runner.to_do());
  return false;
}

// Every probe measures moduli.
void warn_of_soft_contacts(const Probe& probe) {
  std::set<std::string> paths;
  for (const ProbeLoading& loading : probe.loadings) {
    if (!paths.insert(loading.history).second) continue;
    const std::string line = soft_contact_warning(
        loading.scene.scene, fmt::format("path '{}' is probed for moduli", loading.history));
    if (!line.empty()) tell(stderr, "pulvis: warning: {}\n", line);
  }
}

void print_list(const Probe& probe) {
  const std::size_t densities = probe.spec.densities.size();
  std::size_t probes = 0;
  for (const ProbeLoading& loading : probe.loadings) {
    tell("{}\n", loading.name);
    probes += densities * directions_of(probe.spec, loading.scene.scene.in_space()).size();
  }
  tell("{}: good: {}, {}, {}\n", probe.file.string(), counted(probe.loadings.size(), "loading run"),
       counted(probe.loadings.size() * densities, "state"), counted(probes, "probe"));
}

std::set<fs::path> files_of(const Probe& probe) {
  std::set<fs::path> files;
  for (const ProbeLoading& loading : probe.loadings)
    for (const InputFile& input : loading.scene.inputs) files.insert(input.source);
  return files;
}

class Probing {
 public:
  Probing(const ProbeOptions& options, const Probe& probe, fs::path folder)
      : options_(options), probe_(probe), folder_(std::move(folder)) {}

  ExitCode go() {
    const auto begin = std::chrono::steady_clock::now();
    const RunnerOptions how{options_.jobs, 1, options_.fresh};
    const std::vector<StudyRun> loading = loading_runs(folder_, probe_);
    StudyRunner loader(how, loading, folder_);
    if (!went(loader, "loading")) return ExitCode::interrupted;
    const std::vector<StudyResult>& loaded = loader.read();
    std::size_t bad = loader.tell_bad();
    std::vector<std::string> passed;
    for (std::size_t i = 0; i < loaded.size(); ++i)
      for (ProbeState& state : states_of(probe_.loadings[i], probe_.spec, loaded[i], passed))
        states_.push_back(std::move(state));
    for (const std::string& line : passed) tell(stderr, "pulvis: {}\n", line);
    for (const ProbeState& state : states_)
      releases_.push_back(releasing_run(folder_, probe_.spec, state));
    StudyRunner releaser(how, releases_, folder_);
    if (!went(releaser, "unloading")) return ExitCode::interrupted;
    const std::vector<StudyResult>& released = releaser.read();
    bad += releaser.tell_bad();
    for (std::size_t i = 0; i < states_.size(); ++i)
      parts_.push_back(add_probes(folder_, probe_.spec, states_[i], released[i], probes_));
    StudyRunner prober(how, probes_, folder_);
    if (!went(prober, "probes")) return ExitCode::interrupted;
    const std::vector<StudyResult>& probed = prober.read();
    bad += prober.tell_bad();
    const std::vector<ProbeSurface> surfaces = surfaces_of(released, probed);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    const std::vector<ProbeGroup> groups = groups_of(probe_, surfaces);
    write_probe(folder_, probe_, surfaces, groups, time.count());
    tell("{}", caps_text(groups));
    for (const ProbeSurface& surface : surfaces) {
      warn_of_moduli(surface);
      warn_of_springs(surface);
    }
    const std::size_t missing =
        probe_.loadings.size() * probe_.spec.densities.size() - states_.size();
    if (missing > 0) tell(stderr, "pulvis: not reached: {}\n", counted(missing, "state"));
    tell("results in {}, to look at: report.html; pictures: pulvis figure {}\n", folder_.string(),
         folder_.string());
    return bad > 0 || missing > 0 ? ExitCode::run_failed : ExitCode::done;
  }

 private:
  static void warn_of_springs(const ProbeSurface& surface) {
    if (!surface.spring_share || *surface.spring_share <= most_in_springs) return;
    const ProbeState& state = *surface.state;
    tell(stderr,
         "pulvis: warning: path '{}', relative density {:.4f}, seed {}: {:.0f}% of the energy "
         "released on unloading was in contact springs (limit {:.0f}%): the moduli are too small "
         "by about as much\n",
         state.loading->history, state.density, state.loading->seed, 100 * *surface.spring_share,
         100 * most_in_springs);
  }
  void warn_of_moduli(const ProbeSurface& surface) const {
    const PowderModuli& m = surface.moduli;
    if (!m.known() || m.are_of_a_solid()) return;  // missing ones: their runs have been reported
    const ProbeState& state = *surface.state;
    tell(stderr,
         "pulvis: warning: path '{}', relative density {:.4f}, seed {}: the stiffness (E {:.3g} "
         "GPa, "
         "nu {:.3g}) is not physical, nor are the fits: use a smaller elastic_strain ({:g}) or a "
         "longer duration\n",
         state.loading->history, state.density, state.loading->seed, m.youngs_modulus() * 1e-9,
         m.poissons_ratio(), probe_.spec.elastic_strain);
  }
  std::vector<ProbeSurface> surfaces_of(const std::vector<StudyResult>& released,
                                        const std::vector<StudyResult>& probed) const {
    std::vector<ProbeSurface> surfaces;
    for (std::size_t s = 0; s < states_.size(); ++s) {
      std::vector<ProbeRun> runs;
      for (std::size_t k = 0; k < parts_[s].directions.size(); ++k)
        runs.push_back({parts_[s].directions[k], &probed[parts_[s].first + k]});
      surfaces.push_back(surface_of(states_[s], probe_.spec, released[s], runs));
    }
    return surfaces;
  }

  const ProbeOptions& options_;
  const Probe& probe_;
  fs::path folder_;
  std::vector<ProbeState> states_;
  std::vector<StateRuns> parts_;  // one per state
  std::vector<StudyRun> releases_, probes_;
};

}  // namespace

ExitCode run_probe(const ProbeOptions& options) {
  leave_at_interrupts();
  const Probe probe = load_probe(options.probe, options.overrides);
  warn_of_soft_contacts(probe);
  if (options.list) {
    print_list(probe);
    return ExitCode::done;
  }
  take_interrupts();
  const fs::path folder = results_folder(options.folder, options.probe);
  require_own_probe(folder, probe);
  make_folder(folder / scenes_folder);
  const FolderLock lock(folder, "another probe is running in it");
  save_settings(folder / "probe.toml", role::probe,
                whole_settings({probe.text, probe.file, schema::probe_language(), files_of(probe),
                                probe.overrides}));
  return Probing(options, probe, folder).go();
}

}  // namespace pulvis
