// Lines fitted to a record, and the bend where one line ends and the next begins.
//
// Source   least squares; the bend is where two lines cross that are fitted to either side of the split
//          that gives the smallest sum of squares (Hudson 1966, two-phase regression)
// Symbols  y = a + b (t - t0), t0 the mean of t; n samples; S = sum (t - t0)^2;
//          s^2 = residual sum of squares / (n1 + n2 - 4)
// Uncertainty of the intersection tau, propagated from that of a1, a2, b1, b2:
//          u^2 = s^2 [1/n1 + 1/n2 + (tau - t01)^2/S1 + (tau - t02)^2/S2] / (b1 - b2)^2
// The records also curve slightly next to the event: the shift of the intersection when the window is halved
// is added to u (event_near), as the root of the sum of squares.
// Exact, to round-off, for samples that lie on two lines.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace pulvis::lab {

struct Line {
  double middle = 0;  // mean of t
  double value = 0;   // at the mean of t
  double slope = 0;
  double spread = 0;      // S
  double residual = 0;    // sum of squares
  std::size_t count = 0;  // n

  double at(double t) const { return value + slope * (t - middle); }
};

// At least two samples with different t.
Line fit_line(std::span<const double> t, std::span<const double> y);

struct Bend {
  Line before, after;
  double time = 0;               // of the intersection
  double uncertainty = 0;        // of the time, one standard deviation
  double noise = 0;              // s
  double slope_uncertainty = 0;  // of the difference of the slopes, one standard deviation

  bool is_significant() const;  // the slopes differ by more than five standard deviations
};

// Empty: fewer than ten samples, or no split with an intersection within the samples.
std::optional<Bend> find_bend(std::span<const double> t, std::span<const double> y);

struct Event {
  double time = 0;         // s, on the instrument's clock
  double uncertainty = 0;  // s, one standard deviation
};

struct BendEvent {
  Bend bend;
  Event event;
};

// The bend, fitted within `window` to either side; the first search is centred on `middle`. Empty
// where no bend is significant.
std::optional<BendEvent> event_near(std::span<const double> t, std::span<const double> y,
                                    double middle, double window);

// The error of a mean of correlated samples is s/sqrt(n_eff), n_eff = n (1 - r)/(1 + r), with r the
// correlation of neighbouring samples.
struct Mean {
  double value = 0;
  double error = 0;  // one standard deviation
};
Mean correlated_mean(std::span<const double> y);
double inflation_of(std::span<const double> rest);  // sqrt(n/n_eff) of the residuals of a fit

// One standard deviation of a line's slope and of its value at t; its residuals may be correlated.
double slope_error(const Line& line, double inflation);
double value_error(const Line& line, double t, double inflation);

// The samples with low <= t <= high, as positions [begin, end).
struct Samples {
  std::size_t begin = 0, end = 0;
  std::size_t count() const { return end - begin; }
};
Samples between(std::span<const double> t, double low, double high);

// Linear between samples; constant beyond the first and the last. t increases.
double interpolated(std::span<const double> t, std::span<const double> y, double at);

}  // namespace pulvis::lab
