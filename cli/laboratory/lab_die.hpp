// Wall friction and stress ratio from an instrumented die, or from a simulated one, by the slice method.
//
// Source   Janssen (1895), Walker (1966): a slice of the compact that slides on walls under K times its axial stress
//            d sigma/dz = -mu K sigma/l        sigma(z) = sigma_t exp(-mu K z/l), z from the top punch
//            mu K = (l/h) ln(sigma_t/sigma_b)
//            K = sigma_r/sigma(z of the gauge), or sigma_r ln(sigma_t/sigma_b)/(sigma_t - sigma_b) for a gauge that
//            measures the mean over the height
//          l: area over the rubbing perimeter: D/4 of a round die, W/2 of a slot with two walls
// Symbols  sigma_t, sigma_b axial stress at top and bottom punch, sigma_r radial stress on the wall (Pa), h height (m)
// Validity one K and one mu over the height, sliding along the whole wall; uniform axial stress over the section.
//          mu is the mobilised friction: a wall without sliding shows less than its coefficient
//
// Evaluated at steps of the relative density: a straight line over density is fitted to the samples within half a
// step, and evaluated in the middle. Interval: scatter about the line (correlated neighbours count as fewer),
// and the effect of one standard uncertainty of each instrument.
#pragma once

#include "cli/laboratory/lab_press.hpp"
#include "cli/laboratory/lab_uncertainty.hpp"

namespace pulvis::lab {

struct DieCurve {  // a loading, one value per sample
  std::string name;
  std::vector<double> density, top, bottom, radial, height;  // -, Pa, Pa, Pa, m
  double wall_length = 0;                                    // m, l
  std::optional<double> radial_height;                       // m; empty: the mean over the height
  std::optional<double> friction;  // -, the coefficient at the walls of a simulation
};

struct SliceStep {
  double density = 0;          // -, at the middle of the samples
  double top = 0, bottom = 0;  // Pa, means
  std::size_t samples = 0;
  Measured stress_ratio, friction;  // K, mu
};

DieCurve die_curve(const DieRecord& record, const TransmissionSpec& spec, const Settings& settings,
                   const Compliance& machine);

// From a run in a die of four plane tools; rejected where there is none.
DieCurve simulated_die(const std::filesystem::path& run_folder);

// Instrument errors are taken from `settings`, none for a simulation.
std::vector<SliceStep> slice_steps(const DieCurve& curve, const Settings& settings,
                                   bool is_measured);

}  // namespace pulvis::lab
