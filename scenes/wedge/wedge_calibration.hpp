// Wedge calibration of lateral force: friction and detector sensitivity from friction loops in volts on
// known slopes.
//
// Source   several loads: Ogletree, Carpick & Salmeron (1996); one load: Varenberg, Etsion & Halperin (2003).
//          With load L, adhesion A, slope theta, s = sin theta, c = cos theta, D = c^2 - mu^2 s^2, the lateral
//          force draws a loop of half-width W = mu (L + A c)/D and offset Delta = [(1 + mu^2) L s c +
//          mu^2 A s]/D. The sensitivity cancels in the ratio Delta/W, which leaves a quadratic for mu.
//          Its roots are mu and, without adhesion, 1/mu: each slope alone fits both. An upper root that would
//          lock the tip on a slope (D <= 0) is excluded; otherwise the loops together choose (wedge_roots.hpp),
//          or both are given. The roots meet where Delta/W is smallest, near mu = 1: within three
//          standard uncertainties of there the value is the double root, and its uncertainty reaches both.
//          With several loads the ratio is that of the slopes dDelta/dL and dW/dL: neither adhesion nor a
//          constant offset of the detector matters, and A follows from where the line of W crosses zero.
//          A flat facet shows the detector's response to the load itself (crosstalk), which is subtracted. At one
//          load that contains a constant offset: the other facets are then evaluated at the same load, where
//          it cancels; their line of Delta at zero load gives its size.
// Uncertainty  one standard deviation each: from the stated errors of the loops, or the scatter about the
//          lines (the larger), and that of the slope, propagated by finite differences; facets are averaged
//          with weights. Where they disagree by more, this is included (Birge 1932). The error of the
//          crosstalk is common to all facets: it cancels between slopes of opposite sign. That of the flat
//          facet's own slope adds (1 + mu^2) slope_error/sensitivity to it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pulvis::wedge {

enum class Root { lower, upper };

struct Roots {
  double lower = 0;
  std::optional<double> upper;  // > 0; empty where A <= -L c
};
// Of the quadratic for mu, from the ratio Delta/W; empty where no mu fits.
std::optional<Roots> roots_of_ratio(double ratio, double load, double adhesion, double slope);

// mu tan theta >= 1: no force moves the tip uphill.
bool locks(double friction, double slope);
// Volts times sensitivity: W of a loop. Not where the tip locks.
double half_width(double load, double adhesion, double friction, double slope);

struct Loop {
  double slope = 0;                                      // rad, > 0: the trace is uphill
  double load = 0;                                       // N
  double half_width = 0, offset = 0;                     // V
  std::optional<double> half_width_error, offset_error;  // V
};

struct Known {
  double adhesion = 0;                  // N, used where a slope was measured at one load only
  double slope_error = 0;               // rad
  double load_error = 0;                // -, common to all loads: from the normal calibration
  std::optional<double> expected = {};  // -, friction: decides where the loops do not
};

struct Value {
  double value = 0;
  std::optional<double> error;  // empty: unknown
};

struct Facet {
  double slope = 0;                            // rad
  int loops = 0, loads = 0;                    // number of loops, and of different loads
  Value half_width, offset;                    // V/N, per unit load
  std::optional<Value> adhesion;               // N, where there are several loads
  std::optional<Value> friction, sensitivity;  // -, N/V; not for a flat facet
};

enum class Choice {
  only,       // the other root would lock the tip, or is negative
  agreement,  // the loops contradict the other one
  expected,   // nearer to Known::expected, the loops fit both
  given,      // by the caller
  undecided,  // the loops fit both: this is the lower one
  meeting     // the roots cannot be told from the double root between them
};

struct OtherRoot {
  Value friction, sensitivity;
};

struct Calibration {
  Root root = Root::lower;
  Choice choice = Choice::only;
  std::optional<OtherRoot> other;  // where it does not lock the tip
  std::vector<Facet> facets;
  std::optional<Value> crosstalk;       // V/N, from the flat facet
  Value friction, sensitivity;          // over all inclined facets
  std::optional<double> flat_friction;  // from that sensitivity: a check
  std::vector<double> weights;          // of the inclined facets in the mean sensitivity
  double disagreement = 0;              // of their sensitivities: Birge ratio squared
};

// Throws std::runtime_error with what is wrong and what is allowed.
Calibration calibrate(const std::vector<Loop>& loops, const Known& known);

// With this root on every slope, as close to the double root as it may be: for draws of the loops, which have
// their own scatter.
Calibration calibrate_at(const std::vector<Loop>& loops, const Known& known, Root root);

}  // namespace pulvis::wedge
