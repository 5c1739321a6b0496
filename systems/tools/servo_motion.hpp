// Speed in the next step of tools that hold a force, or follow behind a spring. The systems of each dimension find what
// touches them.
#pragma once

#include <array>
#include <functional>

#include "systems/tools/servo_kernel.hpp"
#include "systems/tools/systems.hpp"

namespace pulvis {

// Springs and dashpots of what currently presses on a tool.
using Touching = std::function<kernels::TouchSums(int tool)>;

// Over all rows of all ranks.
class TouchSum {
 public:
  void add(const kernels::TouchSums& row, double factor = 1) {
    sums_[0].add(factor * row.stiffness);
    sums_[1].add(factor * row.damping);
  }
  kernels::TouchSums of_ranks(const Link& link) {
    sum_of_ranks(link, std::span(sums_));
    return {sums_[0].value(), sums_[1].value()};
  }

 private:
  std::array<ExactSum, 2> sums_;
};

void drive_tools(const Servos& servos, const Touching& touching);

}  // namespace pulvis
