#include "cli/session/afm_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cli/report/report.hpp"
#include "cli/save_scene.hpp"
#include "components/solid.hpp"
#include "engine/files/own_files.hpp"
#include "engine/interruption.hpp"
#include "engine/run_failure.hpp"
#include "scenes/expectations.hpp"
#include "scenes/lever/afm_curve.hpp"
#include "scenes/lever/afm_figures.hpp"
#include "scenes/lever/afm_image.hpp"
#include "scenes/lever/mesh_error.hpp"
#include "scenes/results/state_hash.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis {
namespace {

// A lever's programme has no physical time.
const SeriesInfo actions_done{"actions", "-", "actions completed",
                              "actions completed, including the part of the current one"};

RunMesh mesh_of(const AfmSimulation& simulation) {
  const World& world = const_cast<AfmSimulation&>(simulation).world();
  const auto& solid = world.resource<SolidMesh>();
  const auto& reference = world.column<ReferencePosition>();
  RunMesh mesh;
  for (const auto& hexahedron : solid.hexahedra)
    mesh.hexahedra.insert(mesh.hexahedra.end(), hexahedron.begin(), hexahedron.end());
  mesh.cell_particle.assign(solid.part.begin(), solid.part.end());
  // Drawn as hexahedra collapsed to tetrahedra.
  for (const auto& t : solid.tetrahedra)
    for (const std::size_t corner : {0, 1, 2, 2, 3, 3, 3, 3}) mesh.hexahedra.push_back(t[corner]);
  mesh.cell_particle.insert(mesh.cell_particle.end(), solid.tetrahedron_part.begin(),
                            solid.tetrahedron_part.end());
  mesh.node_particle.assign(solid.unknown.size(), 0);
  mesh.reference.assign(reference.values(), reference.values() + 3 * solid.unknown.size());
  return mesh;
}

// The lever at rest and under a force normal to the sample, lateral, and along it, each scaled so that
// the end of the tip moves by a tenth of the lever's length.
void write_load_cases(const std::filesystem::path& folder, const LoadedScene& loaded, int threads,
                      AfmSimulation& simulation) {
  const RunMesh mesh = mesh_of(simulation);
  Recorder recorder(
      folder,
      {program_version(), program_commit(), loaded.scene.title, fmt::format("{:016x}", loaded.hash),
       loaded.scene.seed, threads},
      mesh,
      {{"tip/displacement", "m", "displacement of the tip $u$", "of the tip's end, as drawn"}},
      {{"position", "m", "position $x$", "deformed, displacements exaggerated", FieldPlace::node,
        3},
       {"displacement", "m", "displacement $u$", "as drawn", FieldPlace::node, 3}},
      {"load_case", "-", "load case",
       "0 at rest, then a force normal to, across and along the lever"});
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

// Mean over the Gauss points of every cell; tetrahedra are elastic.
std::vector<double> plastic_strain(const AfmSimulation& simulation, const RunMesh& mesh) {
  const World& world = const_cast<AfmSimulation&>(simulation).world();
  const auto& memory = world.column<SolidMemory>();
  std::vector<double> strain(mesh.cell_particle.size());
  for (std::size_t e = 0; e < memory.table.rows; ++e)
    for (std::size_t g = 0; g < 8; ++g)
      strain[e] += memory.values()[SolidMemory::count * e + 7 * g + 6] / 8;
  return strain;
}

std::vector<Verdict> verdicts_of(const LoadedScene& loaded, const AfmHistory& history,
                                 const std::map<std::string, double>& figures,
                                 const std::string& failure, int threads) {
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

}  // namespace

AfmSession::AfmSession(LoadedScene scene, int threads)
    : loaded_(std::move(scene)), threads_(threads), simulation_(loaded_.scene, threads) {
  report_.threads = threads;
  report_.elements = simulation_.model().elements;
  report_.nodes = simulation_.model().nodes;
  try {
    report_.calibration = simulation_.calibrate();
    // A second mesh in long double would take minutes.
    if (!report_.calibration->extended)
      report_.calibration->mesh_error = mesh_error(loaded_.scene, *report_.calibration, threads);
    if (const auto& error = report_.calibration->mesh_error)
      if (const std::string warning = mesh_warning(*error); !warning.empty())
        report_.warnings.push_back(warning);
  } catch (const RunFailure& bad) {
    end_.failure = bad.what();
  }
}

void AfmSession::write_to(const std::filesystem::path& folder, const CheckpointOptions& options) {
  folder_ = folder;
  checkpoints_.emplace(loaded_, folder, options);
}

bool AfmSession::yields() { return simulation_.world().has<SolidMemory>(); }

std::vector<FieldInfo> AfmSession::fields() {
  std::vector<FieldInfo> all{{"position", "m", "position $x$", "of the node", FieldPlace::node, 3}};
  if (yields())
    all.push_back({"plastic_strain", "-", "plastic strain $\\bar\\varepsilon_p$",
                   "accumulated, mean over the element"});
  return all;
}

void AfmSession::frame(double time) {
  if (recorder_ == nullptr) return;
  require_saved_scene(folder_);
  std::vector<std::vector<double>> values{positions(simulation_, mesh_)};
  if (yields()) values.push_back(plastic_strain(simulation_, mesh_));
  recorder_->frame(time, static_cast<std::int64_t>(history_.rows.size()), values);
}

bool AfmSession::stops() const {
  return (hooks.stop && hooks.stop()) || (checkpoints_ && checkpoints_->stops(increment()));
}

// An equilibrium of a large lever takes minutes. One that is interrupted leaves nothing to resume
// from but the state saved before it.
void AfmSession::keep() {
  kept_ = state_of(simulation_.world());
  kept_position_ = position_;
}

template <class State>
void AfmSession::write_checkpoint(const State& state) {
  RecorderPosition results = recorder_->position();
  StateWriter writer;
  double spent = seconds();
  writer(results, position_, history_, spent);
  checkpoints_->write(increment(), history_.times.back(), state, {{"afm", writer.bytes()}});
}

double AfmSession::seconds() const {
  return seconds_before_ +
         std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void AfmSession::write_kept_checkpoint() {
  if (kept_.empty()) return;  // the checkpoint that it resumed from is still the newest
  position_ = kept_position_;
  write_checkpoint(kept_);
}

void AfmSession::tell(double time, const std::vector<double>& row, bool is_frame) {
  if (hooks.on_sample) hooks.on_sample(time, row);
  if (is_frame && hooks.on_frame) hooks.on_frame(recorder_ ? recorder_->frames() - 1 : -1);
  for (const auto& [increments, hook] : hooks.every)
    if (increment() > 0 && increment() % increments == 0) hook();
  if (hooks.tick) hooks.tick();
}

// The last increment does not end a part: after it the programme is over.
bool AfmSession::reached() const {
  constexpr double rounding = 1e-9;  // of the sum of increments
  return history_.rows.size() < total_ &&
         (increment() >= target_.increment || history_.times.back() >= target_.actions - rounding);
}

// False if the run is to stop here.
bool AfmSession::take(double time, const std::vector<double>& row) {
  history_.times.push_back(time);
  history_.rows.push_back(row);
  if (recorder_) recorder_->sample(time, row);
  const bool is_frame = history_.rows.size() % every_ == 1 || every_ == 1;
  if (is_frame) frame(time);
  tell(time, row, is_frame);
  const bool stop = stops();
  if (recorder_ && (stop || checkpoints_->due(increment(), time)))
    write_checkpoint(simulation_.world());
  if (!stop && recorder_) keep();
  return !stop && !reached();
}

void AfmSession::begin(const Checkpoint* from) {
  has_begun_ = true;
  if (loaded_.scene.afm->actions.empty()) return;
  for (const ActionSpec& action : loaded_.scene.afm->actions) total_ += action.samples();
  every_ = std::max<std::size_t>(1, total_ / 12);
  mesh_ = mesh_of(simulation_);
  open_recorder(from);
  std::function<void(World&)> restore;
  if (from != nullptr) restore = [from](World& world) { from->restore(world); };
  try {
    simulation_.begin(restore);
  } catch (const Interrupted&) {  // its first factorisations take long, too
    end_.given_up = true;
  }
}

void AfmSession::open_recorder(const Checkpoint* from) {
  if (from != nullptr) {
    RecorderPosition results;
    const std::vector<std::byte> bytes = from->run("afm");
    StateReader reader(bytes);
    reader(results, position_, history_, seconds_before_);
    checkpoints_->resumed(increment(), history_.times.back());
    recorder_ =
        std::make_unique<Recorder>(folder_, mesh_, afm_series(), fields(), results, actions_done);
  } else if (writes()) {
    recorder_ = std::make_unique<Recorder>(
        folder_,
        RunAttributes{program_version(), program_commit(), loaded_.scene.title,
                      fmt::format("{:016x}", loaded_.hash), loaded_.scene.seed, threads_},
        mesh_, afm_series(), fields(), actions_done);
  }
  if (recorder_) checkpoints_->of_run(recorder_->run_id());
}

void AfmSession::run_programme() {
  try {
    end_.done = simulation_.go_on(
        [this](double time, const std::vector<double>& row) { return take(time, row); }, position_);
  } catch (const RunFailure& failure) {
    end_.failure = failure.what();
  } catch (const Interrupted&) {
    if (recorder_) write_kept_checkpoint();
    end_.given_up = true;
  }
}

void AfmSession::leave() {
  if (has_left_) return;
  const bool goes_on = has_begun_ && !over();
  has_left_ = true;
  if (recorder_ == nullptr) return;
  if (goes_on && !history_.times.empty()) write_checkpoint(simulation_.world());
  if (!history_.times.empty() && !end_.given_up) frame(history_.times.back());
  for (const AfmImage& image : raster_images(loaded_.scene, history_))
    recorder_->image(image.info, image.lines, image.pixels, image.values, image.spacing);
  recorder_->finish(end_.done ? "done" : end_.failure.empty() ? "interrupted" : end_.failure);
  if (end_.done) checkpoints_->remove();
}

void AfmSession::go(const Target& target) {
  if (!report_.calibration || over()) return;
  if (!has_begun_) begin(nullptr);
  target_ = target;
  if (!loaded_.scene.afm->actions.empty()) {
    if (history_.times.empty() || !reached()) run_programme();
    return;
  }
  if (writes()) write_load_cases(folder_, loaded_, threads_, simulation_);
  end_.done = true;
}

void AfmSession::run(const Checkpoint* from) {
  if (!report_.calibration) return;
  begin(from);
  go({});
  leave();
}

// A lever without a solution: there is nothing to draw or to resume.
void AfmSession::refuse_calibration() {
  report_.outcome = "failed: " + end_.failure;
  report_.verdicts = verdicts_of(loaded_, {}, {}, end_.failure, threads_);
  if (!writes()) return;
  remove_own(folder_ / "report.html", role::run);  // this run has none
  write_own(folder_ / "summary.json", role::run, afm_summary(loaded_, report_));
}

void AfmSession::finish() {
  report_.state_hash = state_hash_text(simulation_.world());
  if (!report_.calibration) return refuse_calibration();
  if (end_.done) report_.loops = friction_loops(loaded_.scene, history_);
  if (end_.done)
    for (const ForceCurveFigures& curve : force_curves(loaded_.scene, history_))
      (curve.released ? report_.curves : report_.unreleased).push_back(curve);
  report_.wedge = calibrate_wedge(loaded_.scene, report_.loops);
  report_.increments = history_.rows.empty() ? 0 : history_.rows.size() - 1;
  report_.wall_seconds = seconds();
  report_.outcome = end_.done              ? "done"
                    : end_.failure.empty() ? "interrupted"
                                           : "failed: " + end_.failure;
  report_.figures = afm_figure_values(*report_.calibration, report_.loops, report_.curves);
  if (end_.done || !end_.failure.empty())
    report_.verdicts = verdicts_of(loaded_, history_, report_.figures, end_.failure, threads_);
  if (!writes()) return;
  remove_own(folder_ / "report.html", role::run);  // a report must never be older than the summary
  write_own(folder_ / "summary.json", role::run, afm_summary(loaded_, report_));
  write_report(folder_);
}

}  // namespace pulvis
