// Wedge calibration of lateral force: friction and the detector's sensitivity from friction loops in volts on
// slopes that are known.
//
// Source   several loads: Ogletree, Carpick & Salmeron (1996); one load: Varenberg, Etsion & Halperin (2003).
//          With load L, adhesion A, slope theta, s = sin theta, c = cos theta, D = c^2 - mu^2 s^2, the lateral
//          force draws a loop of half-width W = mu (L + A c)/D and offset Delta = [(1 + mu^2) L s c +
//          mu^2 A s]/D. Of the ratio Delta/W the sensitivity drops out; it leaves a quadratic for mu.
//          Of several loads the ratio is that of the slopes dDelta/dL and dW/dL: neither adhesion nor a
//          constant offset of the detector matters, and A follows from where the line of W crosses zero.
//          A flat facet tells what the detector sees of the load itself (crosstalk); it is taken off.
// Uncertainty  of one standard deviation each: from the loops' own, or from the scatter about the lines (the
//          larger), and that of the slope, propagated by differences; facets are averaged with weights, and
//          where they disagree by more than that, their disagreement counts (Birge 1932). The error of the
//          crosstalk is the same for all facets: slopes of both signs take it off each other.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pulvis::wedge {

// mu <= 1, from the ratio Delta/W; nothing where no mu fits.
std::optional<double> friction_of_ratio(double ratio, double load, double adhesion, double slope);

struct Loop {
  double slope = 0;                                      // rad, > 0: the trace is uphill
  double load = 0;                                       // N
  double half_width = 0, offset = 0;                     // V
  std::optional<double> half_width_error, offset_error;  // V
};

struct Known {
  double adhesion = 0;     // N, used where a slope was seen at one load only
  double slope_error = 0;  // rad
  double load_error = 0;   // -, of all loads together: of the normal calibration
};

struct Value {
  double value = 0;
  std::optional<double> error;  // absent: nothing is known of it
};

struct Facet {
  double slope = 0;                            // rad
  int loops = 0, loads = 0;                    // how many, and how many different loads
  Value half_width, offset;                    // V/N, by load
  std::optional<Value> adhesion;               // N, where there are several loads
  std::optional<Value> friction, sensitivity;  // -, N/V; not of a flat facet
};

struct Calibration {
  std::vector<Facet> facets;
  std::optional<Value> crosstalk;       // V/N, by the flat facet
  Value friction, sensitivity;          // of all inclined facets
  std::optional<double> flat_friction;  // with that sensitivity: a check
  std::vector<double> weights;          // of the inclined facets in the mean sensitivity
  double disagreement = 0;              // of their sensitivities: square of the factor of Birge
};

// Throws std::runtime_error with what is wrong and what is allowed.
Calibration calibrate(const std::vector<Loop>& loops, const Known& known);

}  // namespace pulvis::wedge
