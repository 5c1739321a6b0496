// What a scene says of its results: what is written, within which limits a run goes on, and what must hold of it.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "scenes/language/source_mark.hpp"

namespace pulvis {

struct OutputSpec {
  int frames = 50;                      // fields written over the run, besides the first
  int samples = 1000;                   // history rows over the run, besides the first
  std::array<int, 2> density_cells{};   // columns and rows; 0: no local densities
  std::array<int, 3> density_cells3{};  // in three dimensions, along x, y, z; 0: none
  bool contacts = false;                // the network of contacts
  bool particle_stress = false;

  bool density() const { return density_cells[0] > 0 || density_cells3[0] > 0; }
};

struct LimitSpec {                        // health: a run that passes one of these stops
  double energy_balance = 0.05;           // -, |balance| / largest energy of the run
  double penetration = 0.5;               // -, penetration / boundary edge length
  double unconverged_projections = 1e-3;  // -, share of the closest points of contact
  std::optional<double>
      kinetic_energy;  // -, kinetic / internal energy, where the scene asks for quasi-statics
};

// What must hold of the run; `pulvis run` checks it at its end.
struct ExpectSpec {
  enum class When { end, always, max, min, mean, range };
  struct Bound {
    double number = 0;  // in the SI unit of the series
    std::string
        quantity;  // as written, until the unit of the series is known; empty: a bare number
  };
  std::string series;  // empty: the expectation is one of the outcome
  std::optional<When> when;
  std::optional<Bound> above, below, equals;
  std::optional<double>
      within;  // -, of |equals| or of the other series; absolute where equals is 0
  std::optional<double> from, until;  // -, share of the run
  std::string like;                   // another scene, relative to this one's folder
  double scale = 1;                   // -, the other series times this
  bool stops = false;                 // the run is to be stopped by a health check or limit
  std::string message;                // regular expression that its message must contain
  SourceMark mark;
};

}  // namespace pulvis
