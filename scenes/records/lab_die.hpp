// Wall friction and stress ratio from an instrumented die, or from a simulated one, by the balance of a slice.
//
// Source   Janssen (1895), Walker (1966): a slice of the compact whose walls carry K times its axial stress and slide
//            d sigma/dz = -mu K sigma/l        sigma(z) = sigma_t exp(-mu K z/l), z from the top punch
//            mu K = (l/h) ln(sigma_t/sigma_b)
//            K = sigma_r/sigma(z of the gauge), or sigma_r ln(sigma_t/sigma_b)/(sigma_t - sigma_b) of a gauge that
//            measures the mean over the height
//          l: area over the perimeter that rubs: D/4 of a round die, W/2 of a slot with two walls
// Symbols  sigma_t, sigma_b axial stress at top and bottom punch, sigma_r radial stress on the wall (Pa), h height (m)
// Validity one K and one mu over the height, sliding along the whole wall; the axial stress uniform over the section.
//          mu is the friction that is mobilised: a wall at which nothing slides has less than its coefficient
//
// Told at steps of the relative density: samples within half a step are laid on a straight line by density, and its
// value in the middle is taken. Interval: scatter about the line (neighbours that follow each other count as fewer),
// and what one standard uncertainty of each instrument changes.
#pragma once

#include "scenes/records/lab_press.hpp"
#include "scenes/records/lab_uncertainty.hpp"

namespace pulvis::lab {

struct DieCurve {  // a loading, one value a sample
  std::string name;
  std::vector<double> density, top, bottom, radial, height;  // -, Pa, Pa, Pa, m
  double wall_length = 0;                                    // m, l
  std::optional<double> radial_height;                       // m; none: the mean over the height
  std::optional<double> friction;  // -, that a simulation has at its walls
};

struct SliceStep {
  double density = 0;          // -, of the middle of the samples
  double top = 0, bottom = 0;  // Pa, means
  std::size_t samples = 0;
  Measured stress_ratio, friction;  // K, mu
};

DieCurve die_curve(const DieRecord& record, const TransmissionSpec& spec, const Settings& settings,
                   const Compliance& machine);

// Of a run in a die of four plane tools; refused where there is none.
DieCurve simulated_die(const std::filesystem::path& run_folder);

// Errors of instruments are those of `settings`, none of a simulation.
std::vector<SliceStep> slice_steps(const DieCurve& curve, const Settings& settings,
                                   bool is_measured);

}  // namespace pulvis::lab
