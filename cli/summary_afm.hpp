// summary.json of an AFM run, and the same figures for the terminal.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/summary.hpp"
#include "scenes/expectations.hpp"
#include "scenes/lever/afm_calibration.hpp"
#include "scenes/lever/afm_curve.hpp"
#include "scenes/lever/afm_loop.hpp"
#include "scenes/read.hpp"

namespace pulvis {

struct AfmReport {
  std::optional<Calibration> calibration;  // none if it found no solution
  std::vector<FrictionLoop> loops;
  std::vector<ForceCurveFigures> curves;
  std::vector<ForceCurveFigures> unreleased;  // those that end in contact, without a pull-off
  std::optional<wedge::Calibration> wedge;
  std::map<std::string, double> figures;  // scenes/lever/afm_figures.hpp
  std::vector<Verdict> verdicts;
  std::vector<std::string> warnings;  // one line each
  std::size_t elements = 0, nodes = 0, increments = 0;
  int threads = 1;
  double wall_seconds = 0;
  std::string outcome, state_hash;
};

std::string afm_summary(const LoadedScene& loaded, const AfmReport& report);
std::string calibration_text(const Calibration& calibration);
std::string curve_text(const ForceCurveFigures& curve);
std::string loop_text(const FrictionLoop& loop);
std::string wedge_summary(const wedge::Calibration& calibration);

}  // namespace pulvis
