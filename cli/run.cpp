#include "cli/run.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/info.h>
#include <spdlog/spdlog.h>

#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "cli/report/report.hpp"
#include "cli/run_afm.hpp"
#include "cli/save_scene.hpp"
#include "cli/summary.hpp"
#include "cli/tell.hpp"
#include "components/body.hpp"
#include "components/servo.hpp"
#include "engine/files/hdf5.hpp"
#include "engine/files/own_files.hpp"
#include "engine/files/recorder.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/run_failure.hpp"
#include "scenes/checks/bending_error.hpp"
#include "scenes/checks/bond_checks.hpp"
#include "scenes/expectations.hpp"
#include "scenes/language/counted.hpp"
#include "scenes/memory_need.hpp"
#include "scenes/read.hpp"
#include "scenes/results/bond_results.hpp"
#include "scenes/results/compaction_curve.hpp"
#include "scenes/results/contact_findings.hpp"
#include "scenes/results/results.hpp"
#include "scenes/results/timetable.hpp"
#include "scenes/simulation.hpp"

namespace pulvis {
namespace {

std::filesystem::path folder_of(const RunOptions& options) {
  return options.folder.empty() ? std::filesystem::path("runs") / options.scene.stem()
                                : options.folder;
}

// Where to look first when the energies say that something is wrong: the most distorted element.
std::string worst_element(const World& world) {
  const double* minimum = world.column<MinJacobian>().values();
  const double* element = world.column<WorstElement>().values();
  int slot = world.resource<Bodies>().slot_of_number.front();
  for (const int s : world.resource<Bodies>().slot_of_number)
    if (!(minimum[s] >= minimum[slot])) slot = s;
  return fmt::format("most distorted: particle {}, element {}, det F = {:.4g}",
                     world.resource<Bodies>().slots[static_cast<std::size_t>(slot)].number,
                     static_cast<int>(element[slot]), minimum[slot]);
}

// Quality that the scene set limits for, looked at on every sample, the last one too: the figures of the summary.
void check_limits(const Scene& scene, const Results& results, const World& world) {
  const Clock& clock = world.resource<Clock>();
  const auto stop = [&](const char* key, double value, double limit) {
    throw RunFailure(fmt::format(
        "energies: {} is {:.4g} at step {}, t = {:.6g} s; allowed {:.4g} (limits.{}); {}", key,
        value, clock.step, clock.time, limit, key, worst_element(world)));
  };
  const auto hold = [&](const char* key, double value, double limit) {
    if (!(value <= limit)) stop(key, value, limit);  // NaN is not
  };
  hold("energy_balance", results.energy_balance_error(), scene.limits.energy_balance);
  const bool started = clock.time > 0.1 * clock.end;  // nothing is quasi-static at first touch
  if (scene.limits.kinetic_energy && started)
    hold("kinetic_energy", results.kinetic_ratio(), *scene.limits.kinetic_energy);
}

struct Run {
  const LoadedScene& loaded;
  const RunOptions& options;
  std::filesystem::path folder;
  int threads;
  std::unique_ptr<Simulation> simulation;
  Results results;
  Expectations expectations;
  CompactionCurve compaction;
  ContactLoading contacts;
  std::vector<std::string> bond_warnings;  // of those made at the start
  std::vector<Verdict> verdicts;
  Timetable samples, frames;
  bool ended = false;  // and its last sample is taken
  bool keeps_states;
  std::size_t stages_over = 0;
  Checkpoints checkpoints;
  std::unique_ptr<Recorder> recorder;
  std::unique_ptr<Progress> progress;

  Run(const LoadedScene& scene, const RunOptions& given, const std::filesystem::path& where,
      int workers, std::unique_ptr<Simulation> built)
      : loaded(scene),
        options(given),
        folder(where),
        threads(workers),
        simulation(std::move(built)),
        results(scene.scene, simulation->world()),
        expectations(scene.scene),
        compaction(scene.scene),
        contacts(scene.scene),
        bond_warnings(pulvis::bond_warnings(scene.scene, simulation->world())),
        samples(clock().end, std::max(scene.scene.output.samples, scene.scene.output.frames)),
        frames(clock().end, scene.scene.output.frames),
        keeps_states(std::ranges::any_of(scene.scene.stages, &StageSpec::keep_state)),
        checkpoints(scene, where, given.checkpoints) {}

  const Clock& clock() const { return simulation->clock(); }

  void begin() {
    recorder = std::make_unique<Recorder>(
        folder,
        RunAttributes{program_version(), program_commit(), loaded.scene.title,
                      fmt::format("{:016x}", loaded.hash), loaded.scene.seed, threads},
        results.mesh(), results.series(), results.fields(), simulated_time, results.tables());
    checkpoints.of_run(recorder->run_id());
    if (options.talks())
      for (const std::string& line : bond_warnings) tell("warning: {}\n", line);
    progress = std::make_unique<Progress>(clock().end, results.elements(), options.talks());
  }

  // What the world does not hold of the run's state.
  template <class Bytes>
  void state(Bytes& bytes, RecorderPosition& position, double& seconds) {
    bytes(position, seconds, results, expectations, compaction, contacts, samples, frames, ended,
          stages_over);
  }

  void go_on_from(const Checkpoint& checkpoint) {
    RecorderPosition position;
    double seconds = 0;
    const std::vector<std::byte> bytes = checkpoint.run("plane");
    StateReader reader(bytes);
    state(reader, position, seconds);
    const RunMesh mesh = results.mesh();
    checkpoint.restore(simulation->world());
    checkpoints.resumed(clock().step, clock().time);
    recorder = std::make_unique<Recorder>(folder, mesh, results.series(), results.fields(),
                                          position, simulated_time, results.tables());
    checkpoints.of_run(recorder->run_id());
    progress = std::make_unique<Progress>(clock().end, results.elements(), options.talks(),
                                          Progress::Before{seconds, clock().step});
  }

  void write_checkpoint() {
    RecorderPosition position = recorder->position();
    double seconds = progress->seconds();
    StateWriter writer;
    state(writer, position, seconds);
    checkpoints.write(clock().step, clock().time, simulation->world(), {{"plane", writer.bytes()}});
  }

  // What broke since: the recorder knows how many rows it has.
  void record_cracks() {
    if (results.tables().empty()) return;
    constexpr std::size_t cracks = 0;  // the only table
    for (const auto& row : crack_rows(simulation->world(), recorder->rows(cracks)))
      recorder->row(cracks, row);
  }

  void record() {
    simulation->observe();
    recorder->sample(clock().time, results.sample());
    record_cracks();
    expectations.sample(clock().time, results);
    compaction.sample(results);
    contacts.sample(results, simulation->world());
    samples.pass(clock().time);
    check_limits(loaded.scene, results, simulation->world());
    if (!frames.due(clock().time) && !simulation->finished()) return;
    require_saved_scene(folder);
    recorder->frame(clock().time, clock().step, results.frame());
    frames.pass(clock().time);
  }

  // The stages that are over, and whose states are to be kept.
  void keep_states() {
    const World& world = simulation->world();
    const std::size_t over = world.resource<ToolProgram>().stage_at(clock().time);
    for (; stages_over < over; ++stages_over) {
      const StageSpec& stage = loaded.scene.stages[stages_over];
      if (stage.keep_state && reached_its_end(stages_over))
        checkpoints.keep_state(stage.name, clock().step, clock().time, world);
    }
  }
  // Not so where its time was over before what its `until` asks for.
  bool reached_its_end(std::size_t stage) const {
    if (!simulation->world().has<StageEnds>()) return true;
    const auto& ends = simulation->world().resource<StageEnds>().ends;
    return std::ranges::none_of(ends, [&](const StageEnds::End& end) {
      return static_cast<std::size_t>(end.stage) == stage && !end.reached;
    });
  }
  bool stage_is_over() const {
    const World& world = simulation->world();
    return keeps_states && world.resource<ToolProgram>().stage_at(clock().time) > stages_over;
  }

  bool stops() const { return interrupted() || checkpoints.stops(clock().step); }

  // True when the run reached its end, false when it was interrupted. Checkpoints are taken where a step is
  // complete and nothing of the next one is known yet: before a sample, if one is due.
  bool go() {
    while (!ended) {
      if (stops()) return false;
      if (keeps_states) keep_states();
      if (checkpoints.due(clock().step, clock().time)) write_checkpoint();
      const bool last = simulation->finished();  // before its time where a stage ended early
      if (last || samples.due(clock().time) || frames.due(clock().time)) {
        record();
        ended = simulation->finished();
        if (ended) break;
        simulation->move();
      }
      simulation->run_until(std::min(samples.next(), frames.next()), [&] {
        progress->show(clock().time, clock().step);
        return stops() || stage_is_over() || checkpoints.due(clock().step, clock().time);
      });
    }
    return true;
  }

  // `failure` is what stopped the run, if anything did.
  void judge(const std::optional<std::string>& failure) {
    progress->finish();
    verdicts = expectations.judge(results, failure, threads, [] { return interrupted(); });
  }

  // What its user should know of its figures.
  RunQuality quality() const {
    const ContactFindings found = contacts.findings();
    RunQuality quality{found, run_quality(loaded.scene, simulation->world(), results, found),
                       bending_warnings(loaded.scene)};
    quality.warnings.insert(quality.warnings.end(), bond_warnings.begin(), bond_warnings.end());
    return quality;
  }

  void finish(const std::string& outcome) {
    progress->finish();
    record_cracks();  // of the steps since the last sample
    recorder->finish(outcome);
    remove_own(folder / "report.html", role::run);  // with a summary, there is the report of it
    write_summary(folder, loaded.scene, simulation->world(), results, compaction, quality(),
                  {progress->seconds(), clock().step, threads, fmt::format("{:016x}", loaded.hash),
                   outcome, simulation->costs()},
                  verdicts);
    write_report(folder);
  }
};

void print_end(const Run& run) {
  if (run.options.json) print_summary(run.folder);
  if (!run.options.talks()) return;
  const Results& r = run.results;
  const double seconds = run.progress->seconds();
  const std::int64_t steps = run.simulation->clock().step;
  tell("{} in {:.2f} s, {:.1f} M element updates/s; energy balance error {:.3g}\n",
       counted(steps, "step"), seconds, static_cast<double>(steps * r.elements()) / seconds * 1e-6,
       r.energy_balance_error());
  if (r.has("stress_ratio/axial"))
    tell("relative density {:.4f}, axial stress / yield stress {:.4f}, lateral {:.4f}\n",
         r.value("relative_density"), r.value("stress_ratio/axial"),
         r.value("stress_ratio/lateral"));
  if (const auto shear = r.shear().figures())
    tell("friction static {:.4f}, dynamic {:.4f}; target moved {:.4g} mm, dilation {:.4g} mm\n",
         shear->static_friction, shear->dynamic_friction, shear->distance * 1e3,
         shear->dilation * 1e3);
  const RunQuality quality = run.quality();
  for (const std::string& line : quality.warnings) tell("warning: {}\n", line);
  for (const QualityFigure& figure : quality.figures)
    if (figure.beyond()) tell("warning: {}\n", figure.line());
  if (!run.verdicts.empty()) tell("expectations\n");
  for (const Verdict& verdict : run.verdicts) tell("  {}\n", verdict.text());
  tell("results in {}\n", run.folder.string());
}

// A health check or a limit ended the run: that may be what the scene is about.
ExitCode stopped(Run& run, const std::string& message) {
  run.judge(message);
  const bool expected = ended_as_expected(run.loaded.scene, message);
  run.finish((expected ? "stopped as expected: " : "failed: ") + message);
  if (!expected)
    tell(stderr, "pulvis: the run failed: {}\nwhat was written before is in {}\n", message,
         run.folder.string());
  if (!run.verdicts.empty() || run.options.json) print_end(run);
  return expected && all_met(run.verdicts) ? ExitCode::done : ExitCode::run_failed;
}

// After the machine failed the run.
void tell_what_is_left(const std::filesystem::path& folder) {
  if (checkpoints_in(folder).empty())
    tell(
        stderr,
        "pulvis: there is no checkpoint yet that could go on; once the cause is gone run it again, "
        "with --overwrite where {} holds a run.h5\n",
        folder.string());
  else
    tell(stderr,
         "pulvis: what was written before is in {}; once the cause is gone continue with: "
         "pulvis resume {}\n",
         folder.string(), folder.string());
}

// From wherever the run stands to its end.
ExitCode complete(Run& run) {
  try {
    bool done = run.go();
    if (done) run.judge({});
    done = done && !interrupted();
    if (!done) run.write_checkpoint();
    run.finish(done ? "done" : "interrupted");
    print_end(run);
    if (done) {
      run.checkpoints.remove();
      return all_met(run.verdicts) ? ExitCode::done : ExitCode::run_failed;
    }
    tell(stderr, "pulvis: interrupted at step {}; continue with: pulvis resume {}\n",
         run.clock().step, run.folder.string());
    return ExitCode::interrupted;
  } catch (const RunFailure& failure) {
    return stopped(run, failure.what());
  } catch (const OutputError&) {
    run.progress->finish();
    tell_what_is_left(run.folder);
    throw;
  }
}

int threads_of(const RunOptions& options) {
  return options.threads > 0 ? options.threads : tbb::info::default_concurrency();
}

}  // namespace

ExitCode run_scene(const RunOptions& options) {
  leave_at_interrupts();
  const LoadedScene loaded = load_scene(options.scene, options.overrides);
  const std::filesystem::path folder = folder_of(options);
  const int threads = threads_of(options);
  require_not_read(folder, options.scene);
  for (const InputFile& input : loaded.inputs) require_not_read(folder, input.source);
  require_own_files(folder);
  if (loaded.scene.afm) return run_afm(loaded, options, folder, threads);
  // Everything that can be refused is refused before the folder is made, and before memory is taken.
  require_memory(loaded.scene);
  auto simulation = std::make_unique<Simulation>(loaded.scene, threads);
  take_interrupts();
  const FolderLock lock = open_run_folder(folder, options.overwrite);
  save_scene(folder, loaded);
  const LoadedScene saved = as_saved(folder, loaded);
  Run run(saved, options, folder, threads, std::move(simulation));
  run.begin();
  return complete(run);
}

ExitCode resume_run(const RunOptions& options) {
  leave_at_interrupts();
  require_stopped_run(options.folder);
  const FolderLock lock(options.folder);
  require_own_results(options.folder);
  hdf5::File::open_to_change(options.folder / "run.h5")
      .close();  // repairs it after a loss of power
  const StoppedRun stopped_run = find_stopped_run(options.folder);
  const LoadedScene& loaded = stopped_run.scene;
  const CheckpointInfo& at = stopped_run.checkpoint->info();
  clear_other_checkpoints(options.folder, at.run);
  if (options.talks()) tell("resumed at step {}, t = {:.6g} s\n", at.step, at.time);
  const int threads = threads_of(options);
  if (loaded.scene.afm) return resume_afm(loaded, options, *stopped_run.checkpoint, threads);
  require_memory(loaded.scene);
  Run run(loaded, options, options.folder, threads,
          std::make_unique<Simulation>(loaded.scene, threads));
  take_interrupts();
  run.go_on_from(*stopped_run.checkpoint);
  return complete(run);
}

}  // namespace pulvis
