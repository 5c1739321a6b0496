#include "cli/run_afm.hpp"
#include "engine/machine_memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "cli/interrupt.hpp"
#include "cli/plan.hpp"
#include "cli/report/report.hpp"
#include "cli/save_scene.hpp"
#include "cli/summary.hpp"
#include "cli/summary_afm.hpp"
#include "cli/tell.hpp"
#include "components/solid.hpp"
#include "engine/files/own_files.hpp"
#include "engine/files/recorder.hpp"
#include "engine/files/run_folder.hpp"
#include "engine/interruption.hpp"
#include "engine/run_failure.hpp"
#include "scenes/expectations.hpp"
#include "scenes/language/counted.hpp"
#include "scenes/lever/afm_curve.hpp"
#include "scenes/lever/afm_figures.hpp"
#include "scenes/lever/afm_image.hpp"
#include "scenes/lever/afm_loop.hpp"
#include "scenes/lever/afm_simulation.hpp"
#include "scenes/lever/afm_size.hpp"
#include "scenes/lever/mesh_error.hpp"
#include "scenes/memory_need.hpp"
#include "scenes/results/state_hash.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis {
namespace {

// A lever's programme has no time.
const SeriesInfo actions_done{"actions", "-", "actions done, a part of one included"};

RunMesh mesh_of(const AfmSimulation& simulation) {
  const World& world = const_cast<AfmSimulation&>(simulation).world();
  const auto& solid = world.resource<SolidMesh>();
  const auto& reference = world.column<ReferencePosition>();
  RunMesh mesh;
  for (const auto& hexahedron : solid.hexahedra)
    mesh.hexahedra.insert(mesh.hexahedra.end(), hexahedron.begin(), hexahedron.end());
  mesh.cell_particle.assign(solid.part.begin(), solid.part.end());
  // Drawn by their corners, as hexahedra that are drawn together to a tetrahedron.
  for (const auto& t : solid.tetrahedra)
    for (const std::size_t corner : {0, 1, 2, 2, 3, 3, 3, 3}) mesh.hexahedra.push_back(t[corner]);
  mesh.cell_particle.insert(mesh.cell_particle.end(), solid.tetrahedron_part.begin(),
                            solid.tetrahedron_part.end());
  mesh.node_particle.assign(solid.unknown.size(), 0);
  mesh.reference.assign(reference.values(), reference.values() + 3 * solid.unknown.size());
  return mesh;
}

// The lever at rest and under a force normal to the sample, lateral, and along it, each scaled so that
// the tip's end moves by a tenth of the lever's length.
void write_frames(const std::filesystem::path& folder, const LoadedScene& loaded, int threads,
                  AfmSimulation& simulation) {
  const RunMesh mesh = mesh_of(simulation);
  Recorder recorder(folder,
                    {program_version(), program_commit(), loaded.scene.title,
                     fmt::format("{:016x}", loaded.hash), loaded.scene.seed, threads},
                    mesh, {{"tip/displacement", "m", "of the tip's end, as drawn"}},
                    {{"position", "m", "deformed, drawn larger than life", FieldPlace::node, 3},
                     {"displacement", "m", "as drawn", FieldPlace::node, 3}},
                    {"load_case", "-", "0 at rest, then a force normal, lateral, along the lever"});
  const double drawn = 0.1 * loaded.scene.afm->lever.length;
  const std::array<Vec3, 4> directions{Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitX()};
  for (std::size_t i = 0; i < directions.size(); ++i) {
    std::vector<double> u = simulation.unit_displacements(directions[i]);
    const double size = read(simulation.model().end, u.data()).norm();
    std::vector<double> x = mesh.reference;
    for (std::size_t k = 0; k < u.size(); ++k) {
      u[k] *= size > 0 ? drawn / size : 0;
      x[k] += u[k];
    }
    recorder.sample(static_cast<double>(i), std::vector<double>{size > 0 ? drawn : 0});
    recorder.frame(static_cast<double>(i), static_cast<std::int64_t>(i), {x, u});
  }
  recorder.finish();
}

std::vector<double> positions(const AfmSimulation& simulation, const RunMesh& mesh) {
  const double* u = const_cast<AfmSimulation&>(simulation).world().column<Displacement>().values();
  std::vector<double> x = mesh.reference;
  for (std::size_t k = 0; k < x.size(); ++k) x[k] += u[k];
  return x;
}

// Of every cell the mean of its Gauss points; tetrahedra are elastic.
std::vector<double> plastic_strain(const AfmSimulation& simulation, const RunMesh& mesh) {
  const World& world = const_cast<AfmSimulation&>(simulation).world();
  const auto& memory = world.column<SolidMemory>();
  std::vector<double> strain(mesh.cell_particle.size());
  for (std::size_t e = 0; e < memory.table.rows; ++e)
    for (std::size_t g = 0; g < 8; ++g)
      strain[e] += memory.values()[SolidMemory::count * e + 7 * g + 6] / 8;
  return strain;
}

struct ProgrammeEnd {
  bool done = false;
  bool given_up = false;  // half way to an equilibrium: the world is of no use
  std::string failure{};
};

// The actions being run, their history, and some twelve frames of the solid, the last one included.
struct ProgrammeRun {
  const LoadedScene& loaded;
  std::filesystem::path folder;
  AfmSimulation& simulation;
  AfmHistory& history;
  RunMesh mesh;
  Checkpoints checkpoints;
  AfmPosition position;
  std::unique_ptr<Recorder> recorder;
  std::size_t every;
  StateParts kept;  // of the world after the last increment
  AfmPosition kept_position;

  ProgrammeRun(const LoadedScene& scene, const RunOptions& options,
               const std::filesystem::path& where, AfmSimulation& afm, AfmHistory& rows)
      : loaded(scene),
        folder(where),
        simulation(afm),
        history(rows),
        mesh(mesh_of(afm)),
        checkpoints(scene, where, options.checkpoints) {
    std::size_t total = 1;
    for (const ActionSpec& action : loaded.scene.afm->actions) total += action.samples();
    every = std::max<std::size_t>(1, total / 12);
  }

  bool yields() const { return simulation.world().has<SolidMemory>(); }
  std::vector<FieldInfo> fields() const {
    std::vector<FieldInfo> all{{"position", "m", "of the node", FieldPlace::node, 3}};
    if (yields()) all.push_back({"plastic_strain", "-", "accumulated, mean over the element"});
    return all;
  }

  void frame(double time) {
    require_saved_scene(folder);
    std::vector<std::vector<double>> values{positions(simulation, mesh)};
    if (yields()) values.push_back(plastic_strain(simulation, mesh));
    recorder->frame(time, static_cast<std::int64_t>(history.rows.size()), values);
  }

  std::int64_t increment() const { return position.told - 1; }
  bool stops() const { return interrupted() || checkpoints.stops(increment()); }

  // An equilibrium of a large lever takes minutes. One that is given up half way leaves nothing to go on
  // from but what was kept before it.
  void keep() {
    kept = state_of(simulation.world());
    kept_position = position;
  }

  template <class State>
  void write_checkpoint(const State& state) {
    RecorderPosition results = recorder->position();
    StateWriter writer;
    writer(results, position, history);
    checkpoints.write(increment(), history.times.back(), state, {{"afm", writer.bytes()}});
  }

  void write_kept_checkpoint() {
    if (kept.empty()) return;  // the checkpoint that it resumed from is still the newest
    position = kept_position;
    write_checkpoint(kept);
  }

  // False where the run is to stop here.
  bool take(double time, const std::vector<double>& row) {
    history.times.push_back(time);
    history.rows.push_back(row);
    recorder->sample(time, row);
    if (history.rows.size() % every == 1 || every == 1) frame(time);
    if (stops() || checkpoints.due(increment(), time)) write_checkpoint(simulation.world());
    if (stops()) return false;
    keep();
    return true;
  }

  ProgrammeEnd go(const Checkpoint* from) {
    std::function<void(World&)> restore;
    if (from != nullptr) restore = [&](World& world) { from->restore(world); };
    ProgrammeEnd end;
    try {
      end.done = simulation.run(
          [&](double time, const std::vector<double>& row) { return take(time, row); }, position,
          restore);
    } catch (const RunFailure& failure) {
      end.failure = failure.what();
    } catch (const Interrupted&) {
      write_kept_checkpoint();
      end.given_up = true;
    }
    if (!history.times.empty() && !end.given_up) frame(history.times.back());
    for (const AfmImage& image : raster_images(loaded.scene, history))
      recorder->image(image.info, image.lines, image.pixels, image.values, image.spacing);
    recorder->finish(end.done ? "done" : end.failure.empty() ? "interrupted" : end.failure);
    if (end.done) checkpoints.remove();
    return end;
  }
};

ProgrammeEnd run_programme(const std::filesystem::path& folder, const LoadedScene& loaded,
                           const RunOptions& options, int threads, const Checkpoint* from,
                           AfmSimulation& simulation, AfmHistory& history) {
  ProgrammeRun run(loaded, options, folder, simulation, history);
  if (from == nullptr) {
    run.recorder = std::make_unique<Recorder>(
        folder,
        RunAttributes{program_version(), program_commit(), loaded.scene.title,
                      fmt::format("{:016x}", loaded.hash), loaded.scene.seed, threads},
        run.mesh, afm_series(), run.fields(), actions_done);
  } else {
    RecorderPosition results;
    const std::vector<std::byte> bytes = from->run("afm");
    StateReader reader(bytes);
    reader(results, run.position, history);
    run.checkpoints.resumed(run.increment(), history.times.back());
    run.recorder = std::make_unique<Recorder>(folder, run.mesh, afm_series(), run.fields(), results,
                                              actions_done);
  }
  run.checkpoints.of_run(run.recorder->run_id());
  return run.go(from);
}

std::vector<Verdict> judge(const LoadedScene& loaded, const AfmHistory& history,
                           const std::map<std::string, double>& figures, const std::string& failure,
                           int threads) {
  Expectations expectations(loaded.scene);
  for (std::size_t i = 0; i < history.rows.size(); ++i)
    expectations.sample(history.times[i],
                        [&](const std::string& name) { return history.value(i, name); });
  const double end = static_cast<double>(loaded.scene.afm->actions.size());
  return expectations.judge(
      [&](const std::string& name) {
        const auto found = figures.find(name);  // a run that was stopped has no loops
        return found == figures.end() ? std::nan("") : found->second;
      },
      end, failure.empty() ? std::nullopt : std::optional(failure), threads);
}

void print_afm_end(const AfmReport& report, const std::filesystem::path& folder) {
  tell("{}", calibration_text(*report.calibration));
  for (const FrictionLoop& loop : report.loops) tell("{}", loop_text(loop));
  for (const ForceCurveFigures& curve : report.curves) tell("{}", curve_text(curve));
  if (report.wedge && report.loops.size() > 1) tell("{}", wedge_summary(*report.wedge));
  tell("{}, {}, {}, {:.2f} s\n", counted(report.elements, "element"), counted(report.nodes, "node"),
       counted(report.increments, "increment"), report.wall_seconds);
  if (!report.verdicts.empty()) tell("expectations\n");
  for (const Verdict& verdict : report.verdicts) tell("  {}\n", verdict.text());
  tell("results in {}\n", folder.string());
}

// A lever that has no answer: there is nothing to draw or to go on from.
ExitCode not_calibrated(const LoadedScene& loaded, const RunOptions& options,
                        const std::filesystem::path& folder, const std::string& failure,
                        AfmReport& report) {
  report.outcome = "failed: " + failure;
  report.verdicts = judge(loaded, {}, {}, failure, report.threads);
  remove_own(folder / "report.html", role::run);  // there is none of this
  write_own(folder / "summary.json", role::run, afm_summary(loaded, report));
  if (options.json) print_summary(folder);
  const bool expected = ended_as_expected(loaded.scene, failure);
  if (!expected) tell(stderr, "pulvis: the run failed: {}\n", failure);
  return expected && all_met(report.verdicts) ? ExitCode::done : ExitCode::run_failed;
}

void refuse_checkpoint_time(const LoadedScene& loaded, const RunOptions& options) {
  if (options.checkpoints.time > 0)
    throw SceneError({{loaded.scene.file, 1, 1, "", "--checkpoint-time",
                       "a lever's programme has no time, allowed: --checkpoint-steps"}});
}

// What comes before the folder is touched: the calibration's factorisation may take minutes.
struct Calibrated {
  AfmSimulation simulation;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  std::optional<Calibration> calibration;
  std::string failure;  // why there is none

  Calibrated(const Scene& scene, int threads) : simulation(scene, threads) {
    try {
      calibration = simulation.calibrate();
      // In long double another mesh would cost minutes.
      if (!calibration->extended)
        calibration->mesh_error = mesh_error(scene, *calibration, threads);
    } catch (const RunFailure& bad) {
      failure = bad.what();
    }
  }
};

ExitCode complete_programme(const LoadedScene& loaded, const RunOptions& options,
                            const std::filesystem::path& folder, int threads,
                            const Checkpoint* from, Calibrated& calibrated) {
  AfmSimulation& simulation = calibrated.simulation;
  AfmReport report;
  AfmHistory history;
  ProgrammeEnd end{.done = true};
  report.threads = threads;
  report.elements = simulation.model().elements;
  report.nodes = simulation.model().nodes;
  report.calibration = calibrated.calibration;
  if (!report.calibration) {
    report.state_hash = state_hash_text(simulation.world());
    return not_calibrated(loaded, options, folder, calibrated.failure, report);
  }
  if (loaded.scene.afm->actions.empty())
    write_frames(folder, loaded, threads, simulation);
  else
    end = run_programme(folder, loaded, options, threads, from, simulation, history);
  if (end.done) report.loops = friction_loops(loaded.scene, history);
  if (end.done) report.curves = force_curves(loaded.scene, history);
  report.wedge = calibrate_wedge(loaded.scene, report.loops);
  report.increments = history.rows.empty() ? 0 : history.rows.size() - 1;
  report.state_hash = state_hash_text(simulation.world());
  report.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - calibrated.start).count();
  report.outcome = end.done              ? "done"
                   : end.failure.empty() ? "interrupted"
                                         : "failed: " + end.failure;
  report.figures = afm_figure_values(*report.calibration, report.loops, report.curves);
  if (end.done || !end.failure.empty())
    report.verdicts = judge(loaded, history, report.figures, end.failure, threads);
  remove_own(folder / "report.html", role::run);  // with a summary, there is the report of it
  write_own(folder / "summary.json", role::run, afm_summary(loaded, report));
  write_report(folder);
  if (options.json) print_summary(folder);
  if (options.talks()) print_afm_end(report, folder);
  const bool expected = end.failure.empty() || ended_as_expected(loaded.scene, end.failure);
  if (!expected) tell(stderr, "pulvis: the run failed: {}\n", end.failure);
  if (!end.done && end.failure.empty()) {
    tell(stderr, "pulvis: interrupted at increment {}; continue with: pulvis resume {}\n",
         report.increments, folder.string());
    return ExitCode::interrupted;
  }
  return expected && all_met(report.verdicts) ? ExitCode::done : ExitCode::run_failed;
}

}  // namespace

ExitCode run_afm(const LoadedScene& loaded, const RunOptions& options,
                 const std::filesystem::path& folder, int threads) {
  refuse_checkpoint_time(loaded, options);
  require_afm_memory(loaded.scene);
  Calibrated calibrated(loaded.scene, threads);
  take_interrupts();
  const FolderLock lock = open_run_folder(folder, options.overwrite);
  save_scene(folder, loaded);
  return complete_programme(loaded, options, folder, threads, nullptr, calibrated);
}

ExitCode resume_afm(const LoadedScene& loaded, const RunOptions& options,
                    const Checkpoint& checkpoint, int threads) {
  refuse_checkpoint_time(loaded, options);
  require_afm_memory(loaded.scene);
  Calibrated calibrated(loaded.scene, threads);
  take_interrupts();
  return complete_programme(loaded, options, options.folder, threads, &checkpoint, calibrated);
}

ExitCode plan_afm(const Scene& scene, bool dot) {
  AfmSimulation simulation(scene);
  tell("{}", dot ? plan_dot(simulation.plan()) : plan_text(simulation.plan(), simulation.world()));
  return ExitCode::done;
}

}  // namespace pulvis
