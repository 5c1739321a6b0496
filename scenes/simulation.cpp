#include "scenes/simulation.hpp"

#include <algorithm>
#include <limits>

#include "components/servo.hpp"
#include "scenes/build.hpp"
#include "scenes/checks/bond_checks.hpp"
#include "scenes/initial_state.hpp"

namespace pulvis {

Simulation::Simulation(const Scene& scene, int threads)
    : world_(build_world(scene)), workers_(threads) {
  workers_.run([&] {
    step_ = std::make_unique<Step>(*world_);
    step_->start();
  });
  require_initial_bonds(scene, *world_);
  begin_with_state(*world_, scene);
}

Simulation::~Simulation() {
  workers_.run([&] { step_.reset(); });
}

double Simulation::end() const {
  const bool may_end_early = world_->has<StageEnds>();
  return std::min(clock().end, may_end_early ? world_->resource<StageEnds>().run_end
                                             : std::numeric_limits<double>::infinity());
}

void Simulation::run_until(double time, const std::function<bool()>& stop) {
  workers_.run([&] {
    while (clock().time < std::min(time, end())) {
      step_->run();
      if (stop && stop()) return;
    }
  });
}

void Simulation::observe() {
  workers_.run([&] { step_->observe(); });
}

void Simulation::move() {
  workers_.run([&] { step_->move(); });
}

void Simulation::run_steps(std::int64_t count) {
  workers_.run([&] {
    for (std::int64_t i = 0; i < count; ++i) step_->run();
  });
}

}  // namespace pulvis
