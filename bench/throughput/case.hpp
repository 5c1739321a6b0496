// What the throughput is measured on: a packing that is pressed until it is plastic everywhere, and then
// goes on at the speed of the thesis.
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
  const char* scene;  // below scenes/; its first move presses from above, the die starts at y = 0
  int rows = 0,
      columns = 0;  // of its first packing, and of a die around it; 0: as the scene has them
  double compression = 0.03;  // of the height, before anything is timed
  int batch = 0;  // steps that are timed at once; the stable time step is looked at every 8
  Formulation formulation = Formulation::one_point;
};

const std::vector<Case>& cases();
const Case& case_called(const std::string& name);

// The case's scene with two stages: crushing, fast, and then pressing, as slowly as the thesis does.
Scene scene_of(const Case& c);

// A world in the state to be timed.
//
// A fast punch alone would crush the upper rows and leave the rest untouched, and a slow one takes minutes.
// So the particles fall with it, each with the punch's speed times its height over the punch's: all rows are
// crushed alike, in as many steps for 10,000 particles as for 100. Then all velocities are slowed down
// alike, without a shock, and 600 steps pass at the final speed.
class State {
 public:
  State(const Case& c, int threads);

  const Case& of() const { return case_; }
  World& world() { return *world_; }
  std::int64_t elements() const { return elements_; }
  std::int64_t steps() const { return world_->resource<Clock>().step; }
  double startup() const {
    return startup_;
  }  // s, from the scene's file to the end of the first step

 private:
  const Case& case_;
  Scene scene_;
  std::unique_ptr<World> world_;
  std::int64_t elements_ = 0;
  double startup_ = 0;
};

}  // namespace pulvis::bench
