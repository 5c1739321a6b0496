// Stick-slip in a friction curve: amplitude and period of its sawtooth.
//
// How      The straight line through the curve is subtracted. Turning points are those from which the
//          curve returns by more than a threshold: six times the noise of the load cell at
//          standstill, and at least 0.5 % of the mean. A slip is a drop from a peak to the next trough.
//            amplitude   mean drop from the straight line through the stick before the slip, where that begins,
//                        to the line through the next stick, where the slip ends
//            period      mean distance from peak to peak
//          It counts as stick-slip when there are at least three slips, the periods scatter by less
//          than half of their mean, and the strongest line of the spectrum (Lomb 1976, Scargle 1982:
//          samples need not be evenly spaced) lies within a quarter of that period. Otherwise the
//          fluctuation is random, and only its standard deviation is reported.
// Bias     Noise raises the highest of many samples and lowers the lowest, but not a fitted line: the lines are
//          fitted to all samples of a stick, extremes or not. A slip begins and ends in the middle between the last
//          sample that is on one line and the first that is not. A stick that curves adds the deviation of its ends
//          from its line. A stick of one or two samples has no line that averages noise; `resolution`, the mean
//          rise of a stick from one sample to the next, is then no longer small beside the amplitude.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace pulvis::lab {

struct StickSlip {
  std::size_t slips = 0;
  double amplitude = 0, amplitude_deviation = 0;  // -, over the slips
  double resolution = 0;                          // -
  double force = 0;                               // N, mean drop of the shear force
  double period = 0, period_deviation = 0;        // m
  double period_time = 0;                         // s
  double spectral_period = 0;                     // m
};

struct FrictionCurve {
  std::span<const double> distance;     // m
  std::span<const double> time;         // s
  std::span<const double> coefficient;  // -
  std::span<const double> force;        // N, shear force
};

// `noise`: standard deviation of the coefficient at standstill.
std::optional<StickSlip> find_stick_slip(const FrictionCurve& curve, double noise);

// Indices of alternating peaks and troughs from which the values return by more than `threshold`.
struct TurningPoint {
  std::size_t at = 0;
  bool is_peak = false;
};
std::vector<TurningPoint> turning_points(std::span<const double> values, double threshold);

// Period of the strongest line of the spectrum, between half of the range and two samples.
double spectral_period(std::span<const double> x, std::span<const double> y);

}  // namespace pulvis::lab
