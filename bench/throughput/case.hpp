// Benchmark case: a packing that is pressed until it is plastic everywhere, and then further at the speed
// of the thesis.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "components/run_state.hpp"
#include "engine/workers.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::bench {

struct Case {
  std::string name;
  const char* scene;  // path below scenes/; its first move presses from above, the die starts at y = 0
  int rows = 0,
      columns = 0;  // of the first packing and its die; 0: as in the scene
  double compression = 0.03;  // of the height, before timing starts
  int batch = 0;  // steps per timed batch; the stable time step is checked every 8
  Formulation formulation = Formulation::one_point;
};

const std::vector<Case>& cases();
const Case& case_called(const std::string& name);

// The scene of the case with two stages: fast crushing, then pressing as slowly as in the thesis.
Scene scene_of(const Case& c);

// A world in the state for timing.
//
// A fast punch alone would crush the upper rows and leave the rest untouched, and a slow one takes minutes.
// So the particles move with it, each at the punch speed times its height over that of the punch: all rows
// are crushed uniformly, in as many steps for 10,000 particles as for 100. Then all velocities are reduced
// uniformly, without a shock, and 600 steps are run at the final speed.
class State {
 public:
  State(const Case& c, int threads);

  const Case& of() const { return case_; }
  World& world() { return *world_; }
  std::int64_t elements() const { return elements_; }
  std::int64_t steps() const { return world_->resource<Clock>().step; }
  double startup() const {
    return startup_;
  }  // s, from the scene file to the end of the first step

 private:
  const Case& case_;
  Scene scene_;
  std::unique_ptr<World> world_;
  std::int64_t elements_ = 0;
  double startup_ = 0;
};

}  // namespace pulvis::bench
