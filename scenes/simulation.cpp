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
    crew_ = std::make_unique<Crew>(
        *world_, ranks->is_root() ? build_whole_world(scene) : std::unique_ptr<World>(), scene,
        mesh_values(*world_), hashed_values());
  }
  workers_.run([&] {
    step_ = std::make_unique<Step>(*world_);
    if (crew_ && crew_->leads()) observers_ = std::make_unique<WholeObservers>(crew_->whole());
    step_->start();
  });
  try {
    require_initial_bonds(scene, *world_);
  } catch (const SceneError&) {
    if (!crew_ || crew_->leads()) throw;
    return;  // the root has found the same and reports it
  }
  begin_with_state(*world_, scene);
  if (crew_ && crew_->leads()) tell(crew_->fetch_start());
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
void Simulation::tell(Order order) {
  crew_->tell(order);
  if (order.kind == Order::Kind::fetch) crew_->fetch(order);
}

void Simulation::run_until(double time, const std::function<bool()>& stop) {
  if (crew_) {
    crew_->drop();
    crew_->tell({Order::Kind::run, time});
  }
  do_run(time, stop);
}

void Simulation::do_run(double time, const std::function<bool()>& stop) {
  const std::int64_t first = clock().step;
  const std::uint64_t sent = crew_ ? crew_->bytes_sent() : 0;
  workers_.run([&] {
    while (clock().time < std::min(time, end())) {
      if (crew_)
        crew_->balance().measure([&] { step_->run(); });
      else
        step_->run();
      if (!goes_on(stop && stop())) return;
    }
  });
  if (crew_) crew_->ran(clock().step - first, crew_->bytes_sent() - sent);
}

// After a step. `stops`: with several ranks, the root's value counts.
bool Simulation::goes_on(bool stops) {
  if (!crew_) return !stops;
  const Crew::Next next = crew_->next(stops);
  if (next == Crew::Next::balance && crew_->balance().divide()) {
    costs_before_ = costs();
    step_ = std::make_unique<Step>(*world_);
  }
  return next != Crew::Next::stop;
}

std::vector<SystemCost> Simulation::costs() const { return added(costs_before_, step_->costs()); }

void Simulation::observe() {
  if (!crew_) return workers_.run([&] { step_->observe(); });
  const Order order = crew_->fetch_sample(observers_->looks_at());
  crew_->tell(order);
  do_observe(order);
}

void Simulation::do_observe(const Order& order) {
  workers_.run([&] {
    step_->observe();
    crew_->fetch(order);
    if (observers_) observers_->run();
  });
}

void Simulation::move() {
  if (crew_) crew_->tell({Order::Kind::move});
  workers_.run([&] { step_->move(); });
}

void Simulation::run_steps(std::int64_t count) {
  workers_.run([&] {
    for (std::int64_t i = 0; i < count; ++i) step_->run();
  });
}

void Simulation::fetch_rows() {
  if (crew_) tell(crew_->fetch_rows());
}
void Simulation::leave() {
  if (crew_) crew_->drop();
}

void Simulation::visit_mesh(std::size_t field, const ValueSink& take) {
  if (!crew_) return visit_all(*world_, mesh_values(*world_).at(field), take);
  Order order{Order::Kind::particles};
  order.field = field;
  crew_->tell(order);
  crew_->visit_particles(order, take);
}

std::string Simulation::state_hash() {
  if (!crew_) return state_hash_text(*world_);
  crew_->tell({Order::Kind::total});
  crew_->total();
  return state_hash_text(
      pulvis::state_hash(whole(), [this](std::size_t number, const ValueSink& take) {
        const Order order = crew_->hashed(number);
        crew_->tell(order);
        crew_->visit_particles(order, take);
      }));
}

void Simulation::write_from_root() {
  if (crew_) crew_->write_from_root();
}

void Simulation::order_write(Order order) {
  crew_->tell(order);
  crew_->write(order);
}

FieldWriters Simulation::field_writers(const std::filesystem::path& folder) {
  if (!crew_) return {};
  return {[this, folder](std::size_t field) { return crew_->writes_field_in(folder, field); },
          [this](std::size_t field, const FieldRoom& room) {
            Order order{Order::Kind::write_field};
            order.field = field;
            order.room = room;
            order_write(order);
          },
          [this] { order_write({Order::Kind::flush}); }};
}

ColumnVisit Simulation::visit(const std::filesystem::path& folder) {
  if (!crew_) return {};
  ColumnVisit visit;
  visit.write = [this, folder](const ColumnBase& column, const ColumnVisit::MakeRoom& make_room) {
    const std::optional<std::uint64_t> bytes = crew_->bytes_written_in(folder, column);
    if (!bytes) return false;
    Order order{Order::Kind::write_column, 0, {crew_->number_of(column)}};
    order.room.at = make_room(*bytes);
    order_write(order);
    return true;
  };
  visit.flush = [this] { order_write({Order::Kind::flush}); };
  visit.fetch = [this](const ColumnBase& column) {
    if (is_by_chunk(column) || is_of_contacts(column))
      tell({Order::Kind::fetch, 0, {crew_->number_of(column)}});
  };
  visit.leave = [this](const ColumnBase& column) { crew_->drop(column); };
  return visit;
}

void Simulation::restore(const Checkpoint& checkpoint) {
  if (!crew_) return checkpoint.restore(*world_);
  crew_->tell(
      {Order::Kind::restore, 0, {}, false, std::filesystem::absolute(checkpoint.file()).string()});
  restore_share(checkpoint, *world_);
  crew_->restore_findings(checkpoint);
}

void Simulation::follow() {
  while (true) {
    const Order order = crew_->listen();
    try {
      switch (order.kind) {
        case Order::Kind::run:
          do_run(order.time, {});
          break;
        case Order::Kind::observe:
          do_observe(order);
          break;
        case Order::Kind::move:
          workers_.run([&] { step_->move(); });
          break;
        case Order::Kind::fetch:
          crew_->fetch(order);
          break;
        case Order::Kind::particles:
          crew_->visit_particles(order);
          break;
        case Order::Kind::write_field:
        case Order::Kind::write_column:
        case Order::Kind::flush:
          crew_->write(order);
          break;
        case Order::Kind::total:
          crew_->total();
          break;
        case Order::Kind::restore:
          restore_share(Checkpoint::verified(order.file), *world_);
          break;
        case Order::Kind::leave:
          return;
      }
    } catch (const RunFailure&) {  // the root has the same failure and reports it
    }
  }
}

}  // namespace pulvis
