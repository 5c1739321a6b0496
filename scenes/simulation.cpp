#include "scenes/simulation.hpp"

#include <algorithm>
#include <limits>

#include "components/servo.hpp"
#include "engine/run_failure.hpp"
#include "scenes/build.hpp"
#include "scenes/checks/bond_checks.hpp"
#include "scenes/initial_state.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/results/state_hash.hpp"

namespace pulvis {

Simulation::Simulation(const Scene& scene, int threads, Ranks* ranks)
    : world_(build_world(scene, ranks)), workers_(threads) {
  if (ranks != nullptr) {
    group_ = std::make_unique<RankGroup>(
        *world_, ranks->is_root() ? build_whole_world(scene) : std::unique_ptr<World>(), scene,
        mesh_values(*world_), hashed_values());
  }
  workers_.run([&] {
    step_ = std::make_unique<Step>(*world_);
    if (group_ && group_->leads()) observers_ = std::make_unique<WholeObservers>(group_->whole());
    step_->start();
  });
  try {
    require_initial_bonds(scene, *world_);
  } catch (const SceneError&) {
    if (!group_ || group_->leads()) throw;
    return;  // the root has found the same and reports it
  }
  begin_with_state(*world_, scene);
  if (group_ && group_->leads()) tell(group_->fetch_start());
}

Simulation::~Simulation() {
  workers_.run([&] {
    step_.reset();
    observers_.reset();
  });
}

double Simulation::end() const {
  const bool may_end_early = world_->has<StageEnds>();
  return std::min(clock().end, may_end_early ? world_->resource<StageEnds>().run_end
                                             : std::numeric_limits<double>::infinity());
}

// Informs the other ranks, and does this rank's part of a gather.
void Simulation::tell(Command command) {
  group_->tell(command);
  if (command.kind == Command::Kind::fetch) group_->fetch(command);
}

void Simulation::run_until(double time, const std::function<bool()>& stop) {
  if (group_) {
    group_->drop();
    group_->tell({Command::Kind::run, time});
  }
  do_run(time, stop);
}

void Simulation::do_run(double time, const std::function<bool()>& stop) {
  const std::int64_t first = clock().step;
  const std::uint64_t sent = group_ ? group_->bytes_sent() : 0;
  workers_.run([&] {
    while (clock().time < std::min(time, end())) {
      if (group_)
        group_->balance().measure([&] { step_->run(); });
      else
        step_->run();
      if (!goes_on(stop && stop())) return;
    }
  });
  if (group_) group_->ran(clock().step - first, group_->bytes_sent() - sent);
}

// After a step. `stops`: with several ranks, the root's value counts.
bool Simulation::goes_on(bool stops) {
  if (!group_) return !stops;
  const RankGroup::Next next = group_->next(stops);
  if (next == RankGroup::Next::balance && group_->balance().divide()) {
    costs_before_ = costs();
    step_ = std::make_unique<Step>(*world_);
  }
  return next != RankGroup::Next::stop;
}

std::vector<SystemCost> Simulation::costs() const { return added(costs_before_, step_->costs()); }

void Simulation::observe() {
  if (!group_) return workers_.run([&] { step_->observe(); });
  const Command command = group_->fetch_sample(observers_->looks_at());
  group_->tell(command);
  do_observe(command);
}

void Simulation::do_observe(const Command& command) {
  workers_.run([&] {
    step_->observe();
    group_->fetch(command);
    if (observers_) observers_->run();
  });
}

void Simulation::move() {
  if (group_) group_->tell({Command::Kind::move});
  workers_.run([&] { step_->move(); });
}

void Simulation::run_steps(std::int64_t count) {
  workers_.run([&] {
    for (std::int64_t i = 0; i < count; ++i) step_->run();
  });
}

void Simulation::fetch_rows() {
  if (group_) tell(group_->fetch_rows());
}
void Simulation::leave() {
  if (group_) group_->drop();
}

void Simulation::visit_mesh(std::size_t field, const ValueSink& take) {
  if (!group_) return visit_all(*world_, mesh_values(*world_).at(field), take);
  Command command{Command::Kind::particles};
  command.field = field;
  group_->tell(command);
  group_->visit_particles(command, take);
}

std::string Simulation::state_hash() {
  if (!group_) return state_hash_text(*world_);
  group_->tell({Command::Kind::total});
  group_->total();
  return state_hash_text(
      pulvis::state_hash(whole(), [this](std::size_t number, const ValueSink& take) {
        const Command command = group_->hashed(number);
        group_->tell(command);
        group_->visit_particles(command, take);
      }));
}

void Simulation::write_from_root() {
  if (group_) group_->write_from_root();
}

void Simulation::command_write(Command command) {
  group_->tell(command);
  group_->write(command);
}

FieldWriters Simulation::field_writers(const std::filesystem::path& folder) {
  if (!group_) return {};
  return {[this, folder](std::size_t field) { return group_->writes_field_in(folder, field); },
          [this](std::size_t field, const FieldRoom& room) {
            Command command{Command::Kind::write_field};
            command.field = field;
            command.room = room;
            command_write(command);
          },
          [this] { command_write({Command::Kind::flush}); }};
}

ColumnVisit Simulation::visit(const std::filesystem::path& folder) {
  if (!group_) return {};
  ColumnVisit visit;
  visit.write = [this, folder](const ColumnBase& column, const ColumnVisit::MakeRoom& make_room) {
    const std::optional<std::uint64_t> bytes = group_->bytes_written_in(folder, column);
    if (!bytes) return false;
    Command command{Command::Kind::write_column, 0, {group_->number_of(column)}};
    command.room.at = make_room(*bytes);
    command_write(command);
    return true;
  };
  visit.flush = [this] { command_write({Command::Kind::flush}); };
  visit.fetch = [this](const ColumnBase& column) {
    if (is_by_chunk(column) || is_of_contacts(column))
      tell({Command::Kind::fetch, 0, {group_->number_of(column)}});
  };
  visit.leave = [this](const ColumnBase& column) { group_->drop(column); };
  return visit;
}

void Simulation::restore(const Checkpoint& checkpoint) {
  if (!group_) return checkpoint.restore(*world_);
  group_->tell({Command::Kind::restore,
                0,
                {},
                false,
                std::filesystem::absolute(checkpoint.file()).string()});
  restore_share(checkpoint, *world_);
  group_->restore_findings(checkpoint);
}

void Simulation::follow() {
  while (true) {
    const Command command = group_->listen();
    try {
      switch (command.kind) {
        case Command::Kind::run:
          do_run(command.time, {});
          break;
        case Command::Kind::observe:
          do_observe(command);
          break;
        case Command::Kind::move:
          workers_.run([&] { step_->move(); });
          break;
        case Command::Kind::fetch:
          group_->fetch(command);
          break;
        case Command::Kind::particles:
          group_->visit_particles(command);
          break;
        case Command::Kind::write_field:
        case Command::Kind::write_column:
        case Command::Kind::flush:
          group_->write(command);
          break;
        case Command::Kind::total:
          group_->total();
          break;
        case Command::Kind::restore:
          restore_share(Checkpoint::verified(command.file), *world_);
          break;
        case Command::Kind::leave:
          return;
      }
    } catch (const RunFailure&) {  // the root has the same failure and reports it
    }
  }
}

}  // namespace pulvis
