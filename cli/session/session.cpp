#include "cli/session/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "cli/report/report.hpp"
#include "cli/save_scene.hpp"
#include "cli/tell.hpp"
#include "components/body.hpp"
#include "components/servo.hpp"
#include "engine/files/own_files.hpp"
#include "engine/run_failure.hpp"
#include "scenes/checks/bending_error.hpp"
#include "scenes/checks/bond_checks.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/results/bond_results.hpp"
#include "scenes/setup_warnings.hpp"

namespace pulvis {
namespace {

constexpr auto between_ticks = std::chrono::milliseconds(200);

// Where to look first if the energies indicate a problem: the most distorted element.
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

// Quality figures with limits in the scene, checked at every sample, also the last: the figures of the summary. Kinetic
// energy is judged at the end of a stage only: before, a first touch may be under more than a tenth of the largest load.
void check_limits(const Scene& scene, const Results& results, const World& world, bool at_an_end) {
  const Clock& clock = world.resource<Clock>();
  const auto stop = [&](const char* key, double value, double limit) {
    throw RunFailure(fmt::format(
        "energies: {} is {:.4g} at step {}, t = {:.6g} s; allowed {:.4g} (limits.{}); {}", key,
        value, clock.step, clock.time, limit, key, worst_element(world)));
  };
  const auto hold = [&](const char* key, double value, double limit) {
    if (!(value <= limit)) stop(key, value, limit);  // NaN fails
  };
  hold("energy_balance", results.energy_balance_error(), scene.limits.energy_balance);
  if (scene.limits.kinetic_energy && at_an_end)
    hold("kinetic_energy", results.kinetic_ratio(), *scene.limits.kinetic_energy);
}

}  // namespace

std::vector<std::string> driven_in(const Checkpoint& checkpoint) {
  std::vector<std::string> driven;
  if (!checkpoint.has_run("driven")) return driven;
  const std::vector<std::byte> words = checkpoint.run("driven");
  StateReader reader(words);
  reader(driven);
  return driven;
}

Session::Session(LoadedScene scene, Options options, std::unique_ptr<Simulation> built)
    : loaded_(std::move(scene)),
      options_(std::move(options)),
      simulation_(std::move(built)),
      results_(loaded_.scene, simulation_->whole()),
      expectations_(loaded_.scene),
      compaction_(loaded_.scene),
      contacts_(loaded_.scene),
      bond_warnings_(bond_warnings(loaded_.scene, simulation_->whole())),
      samples_(clock().end, std::max(loaded_.scene.output.samples, loaded_.scene.output.frames)),
      frames_(clock().end, loaded_.scene.output.frames),
      keeps_states_(std::ranges::any_of(loaded_.scene.stages, &StageSpec::keep_state)),
      checkpoints_(loaded_, options_.folder, options_.checkpoints) {}

void Session::begin() {
  if (writes()) {
    record_into(std::make_unique<Recorder>(
        options_.folder,
        RunAttributes{program_version(), program_commit(), loaded_.scene.title,
                      fmt::format("{:016x}", loaded_.hash), loaded_.scene.seed, options_.threads},
        results_.mesh(), results_.series(), results_.fields(), simulated_time, results_.tables()));
  }
  if (std::FILE* to = options_.warns_on)
    for (const std::string& line :
         all_warnings(loaded_.scene, place_bodies(loaded_.scene), &simulation_->whole()))
      tell(to, "warning: {}\n", line);
  progress_ = std::make_unique<Progress>(clock().end, results_.elements(), options_.talks);
}

void Session::record_into(std::unique_ptr<Recorder> recorder) {
  recorder_ = std::move(recorder);
  recorder_->share(simulation_->field_writers(options_.folder));
  checkpoints_.of_run(recorder_->run_id());
}

// The part of the run's state that is not in the world.
template <class Bytes>
void Session::state(Bytes& bytes, RecorderPosition& position, Spent& spent) {
  bytes(position, spent, results_, expectations_, compaction_, contacts_, steps_, samples_, frames_,
        ended_, stages_over_, judged_stages_);
}

void Session::go_on_from(const Checkpoint& checkpoint) {
  RecorderPosition position;
  Spent spent;
  const std::vector<std::byte> bytes = checkpoint.run("plane");
  StateReader reader(bytes);
  state(reader, position, spent);
  const RunMesh mesh = results_.mesh();
  simulation_->restore(checkpoint);
  for (const std::string& what : driven_in(checkpoint)) driven_.insert(what);
  checkpoints_.resumed(clock().step, clock().time);
  record_into(std::make_unique<Recorder>(options_.folder, mesh, results_.series(),
                                         results_.fields(), position, simulated_time,
                                         results_.tables()));
  costs_before_ = spent.costs;
  told_step_ = clock().step;
  progress_ = std::make_unique<Progress>(clock().end, results_.elements(), options_.talks,
                                         Progress::Before{spent.seconds, clock().step});
}

void Session::write_checkpoint() {
  if (!writes()) return;
  move();
  RecorderPosition position = recorder_->position();
  Spent spent{progress_->seconds(), costs()};
  StateWriter writer;
  state(writer, position, spent);
  StateParts parts{{"plane", writer.bytes()}};
  if (!driven_.empty()) {
    StateWriter words;
    std::vector<std::string> driven(driven_.begin(), driven_.end());
    words(driven);
    parts.emplace("driven", words.bytes());
  }
  simulation_->fetch_rows();
  checkpoints_.write(clock().step, clock().time, simulation_->whole(), parts,
                     simulation_->visit(options_.folder));
  simulation_->leave();
}

// Bonds broken since the last call: the recorder knows how many rows it has.
void Session::record_cracks() {
  if (recorder_ == nullptr || results_.tables().empty()) return;
  constexpr std::size_t cracks = 0;  // the only table
  for (const auto& row : crack_rows(simulation_->whole(), recorder_->rows(cracks)))
    recorder_->row(cracks, row);
}

void Session::record() {
  simulation_->observe();
  const std::vector<double> row = results_.sample();
  if (recorder_) recorder_->sample(clock().time, row);
  record_cracks();
  expectations_.sample(clock().time, results_);
  compaction_.sample(results_);
  contacts_.sample(results_, simulation_->whole());
  steps_.sample(simulation_->world(), simulation_->finished());
  samples_.pass(clock().time);
  const char* const density = "relative_density";
  progress_->expect_end(forecast_.sample(
      simulation_->world(), clock(),
      results_.has(density) ? results_.value(density) : std::numeric_limits<double>::quiet_NaN()));
  const bool at_an_end = has_passed_an_end() || simulation_->finished();
  check_limits(loaded_.scene, results_, simulation_->whole(), at_an_end);
  const bool is_frame = frames_.due(clock().time) || simulation_->finished();
  if (is_frame && recorder_) {
    require_saved_scene(options_.folder);
    recorder_->frame(clock().time, clock().step,
                     results_.frame_values([this](std::size_t field, const ValueSink& take) {
                       simulation_->visit_mesh(field, take);
                     }));
  }
  if (is_frame) frames_.pass(clock().time);
  ended_ = simulation_->finished();
  observed_ = !ended_;
  if (hooks.on_sample) hooks.on_sample(clock().time, row);
  if (is_frame && hooks.on_frame) hooks.on_frame(recorder_ ? recorder_->frames() - 1 : -1);
}

// Whether a stage has ended since the last sample.
bool Session::has_passed_an_end() {
  if (!simulation_->world().has<ToolProgram>()) return false;
  const std::size_t over = simulation_->world().resource<ToolProgram>().stage_at(clock().time);
  return over > std::exchange(judged_stages_, over);
}

// Saves the states of completed stages that ask for it.
void Session::keep_states() {
  const World& world = simulation_->world();
  const std::size_t over = world.resource<ToolProgram>().stage_at(clock().time);
  for (; stages_over_ < over; ++stages_over_) {
    const StageSpec& stage = loaded_.scene.stages[stages_over_];
    if (stage.keep_state && reached_its_end(stages_over_)) {
      simulation_->fetch_rows();
      checkpoints_.keep_state(stage.name, clock().step, clock().time, simulation_->whole(),
                              simulation_->visit(options_.folder));
      simulation_->leave();
    }
  }
}

// Not if its time was over before its `until` condition was met.
bool Session::reached_its_end(std::size_t stage) const {
  if (!simulation_->world().has<StageEnds>()) return true;
  const auto& ends = simulation_->world().resource<StageEnds>().ends;
  return std::ranges::none_of(ends, [&](const StageEnds::End& end) {
    return static_cast<std::size_t>(end.stage) == stage && !end.reached;
  });
}

bool Session::stage_is_over() const {
  const World& world = simulation_->world();
  return keeps_states_ && world.resource<ToolProgram>().stage_at(clock().time) > stages_over_;
}

bool Session::stops() const {
  return (hooks.stop && hooks.stop()) || checkpoints_.stops(clock().step);
}

bool Session::is_every_due() const {
  return clock().step != told_step_ && std::ranges::any_of(hooks.every, [&](const auto& hook) {
           return clock().step % hook.first == 0;
         });
}

bool Session::is_tick_due() const {
  return hooks.tick && std::chrono::steady_clock::now() - ticked_ >= between_ticks;
}

void Session::call_between_steps() {
  if (is_every_due()) {
    told_step_ = clock().step;
    for (const auto& [steps, hook] : hooks.every)
      if (clock().step % steps == 0) hook();
  }
  if (is_tick_due()) {
    ticked_ = std::chrono::steady_clock::now();
    hooks.tick();
  }
}

void Session::move() {
  if (observed_) simulation_->move();
  observed_ = false;
}

// Checkpoints are written when a step is complete and nothing of the next one has started: before a sample, if one
// is due.
Session::Halt Session::go(const Target& target) {
  const auto is_reached = [&] {
    return clock().time >= target.time || clock().step >= target.step;
  };
  while (!ended_) {
    move();
    call_between_steps();
    if (stops()) return Halt::stop;
    const bool due = samples_.due(clock().time) || frames_.due(clock().time);
    const bool last = simulation_->finished();  // early if a stage ended early
    if (is_reached() && !last) return Halt::target;
    if (writes() && keeps_states_) keep_states();
    if (writes() && checkpoints_.due(clock().step, clock().time)) write_checkpoint();
    if (last || due) {
      record();
      continue;
    }
    simulation_->run_until(std::min(samples_.next(), frames_.next()), [&] {
      progress_->show(clock().time, clock().step);
      return stops() || is_reached() || is_every_due() || is_tick_due() || stage_is_over() ||
             (writes() && checkpoints_.due(clock().step, clock().time));
    });
  }
  return Halt::end;
}

void Session::judge(const std::optional<std::string>& failure, const std::function<bool()>& stop) {
  progress_->finish();
  verdicts_ = expectations_.judge(results_, failure, options_.threads, stop);
}

void Session::reopen() {
  if (open()) return;
  record_into(std::make_unique<Recorder>(options_.folder, results_.mesh(), results_.series(),
                                         results_.fields(), closed_at_, simulated_time,
                                         results_.tables()));
}

RunQuality Session::quality() const {
  const ContactFindings found = contacts_.findings();
  RunQuality quality{found, run_quality(loaded_.scene, simulation_->whole(), results_, found),
                     bending_warnings(loaded_.scene), steps_};
  quality.warnings.insert(quality.warnings.end(), bond_warnings_.begin(), bond_warnings_.end());
  if (!driven_.empty())
    quality.warnings.push_back(
        fmt::format("driven from Python ({}): the scene alone does not describe the run",
                    listed({driven_.begin(), driven_.end()})));
  return quality;
}

void Session::finish(const std::string& outcome) {
  progress_->finish();
  if (recorder_ == nullptr) return;
  close(outcome);
  write_report(options_.folder);
}

void Session::end_with_report() {
  simulation_.reset();
  write_report(options_.folder);
}

void Session::close(const std::string& outcome) {
  progress_->finish();
  const std::string hash = simulation_->state_hash();
  record_cracks();  // of the steps since the last sample
  closed_at_ = recorder_->position();
  recorder_->finish(outcome);
  recorder_ = nullptr;
  const std::filesystem::path& folder = options_.folder;
  remove_own(folder / "report.html", role::run);  // a report must never be older than the summary
  RunCost cost{progress_->seconds(),
               clock().step,
               options_.threads,
               fmt::format("{:016x}", loaded_.hash),
               outcome,
               costs()};
  cost.state_hash = hash;
  if (const Balance* balance = simulation_->balance()) {
    cost.bytes_a_step = simulation_->bytes_a_step();
    cost.rank_memory = simulation_->rank_memory();
    cost.rank_seconds = balance->seconds();
    cost.rebalancings = balance->rebalancings();
  }
  write_summary(folder, loaded_.scene, simulation_->whole(), results_, compaction_, quality(), cost,
                verdicts_);
}

}  // namespace pulvis
