// summary.json of an AFM run, and the same figures for the terminal.
#pragma once

#include <string>

#include "cli/summary.hpp"
#include "scenes/afm_simulation.hpp"
#include "scenes/read.hpp"

namespace pulvis {

struct AfmRunCost {
  int threads = 1;
  double wall_seconds = 0;
  std::string outcome;
};

std::string afm_summary(const LoadedScene& loaded, const AfmSimulation& simulation,
                        const Calibration& calibration, const AfmRunCost& cost);
std::string calibration_text(const Calibration& calibration);

}  // namespace pulvis
