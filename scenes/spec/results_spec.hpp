// A scene's settings for its results: output, the limits within which a run continues, and expectations.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "scenes/language/source_mark.hpp"

namespace pulvis {

struct OutputSpec {
  int frames = 50;                      // field outputs over the run, besides the initial one
  int samples = 1000;                   // history rows over the run, besides the initial one
  std::array<int, 2> density_cells{};   // columns and rows; 0: no local densities
  std::array<int, 3> density_cells3{};  // in three dimensions, along x, y, z; 0: none
  bool contacts = false;                // the contact network
  bool particle_stress = false;

  bool density() const { return density_cells[0] > 0 || density_cells3[0] > 0; }
};

struct LimitSpec {                        // health: a run that exceeds one of these stops
  double energy_balance = 0.05;           // -, |balance| / largest energy of the run
  double penetration = 0.5;               // -, penetration / boundary edge length
  double unconverged_projections = 1e-3;  // -, fraction of the closest-point projections
  std::optional<double>
      kinetic_energy;  // -, kinetic / internal energy, where the scene demands a quasi-static run
};

// What must hold for the run; `pulvis run` checks it at the end.
struct ExpectSpec {
  enum class When { end, always, max, min, mean, range };
  struct Bound {
    double number = 0;  // in the SI unit of the series
    std::string
        quantity;  // as written, until the unit of the series is known; empty: a bare number
  };
  std::string series;  // empty: the expectation concerns the outcome
  std::optional<When> when;
  std::optional<Bound> above, below, equals;
  std::optional<double>
      within;  // -, of |equals| or of the other series; absolute if equals is 0
  std::optional<double> from, until;  // -, fraction of the run
  std::string like;                   // another scene, relative to this one's folder
  double scale = 1;                   // -, factor on the other series
  bool stops = false;                 // a health check or limit is expected to stop the run
  std::string message;                // regular expression that the message must match
  SourceMark mark;
};

}  // namespace pulvis
