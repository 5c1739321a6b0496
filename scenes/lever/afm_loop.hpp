// Friction loops: what the trace and retrace of a scan over the sample show about friction and slope.
//
// Source   wedge calibration, one load: Varenberg et al. (2003); Ogletree et al. (1996) in this form, with
//          the load L vertical, adhesion A along the normal, slope theta uphill on the trace:
//            T_u = [L (sin + mu cos) + mu A]/(cos - mu sin),  T_d = [L (sin - mu cos) - mu A]/(cos + mu sin)
//            W = (T_u - T_d)/2 = mu (L + A cos)/(cos^2 - mu^2 sin^2),  Delta = (T_u + T_d)/2
//          With a = A/L, mu^2 (1 + a/cos) - mu (Delta/W) (1 + a cos)/(sin cos) + 1 = 0 in any unit of W and
//          Delta: friction follows from volts, and the lateral sensitivity from mu. A is the scene's pull-off force.
//          Of its two roots that is taken whose W is the loop's own in newtons: the volts of one slope do not tell
//          them apart.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/lever/afm_series.hpp"
#include "scenes/spec/scene.hpp"
#include "scenes/wedge/wedge_calibration.hpp"

namespace pulvis {

namespace wedge {

double uphill(double load, double adhesion, double mu, double slope);
double downhill(double load, double adhesion, double mu, double slope);
// Both mu of a loop from its offset, half-width and adhesion over load; empty where no mu fits, or slope = 0.
std::optional<Roots> friction(double half_width, double offset, double slope,
                              double adhesion_by_load);

}  // namespace wedge

struct FrictionLoop {
  int action = 0;      // position of the scan in the programme
  double load = 0;     // N, mean vertical force
  double touches = 1;  // -, share of the positions with contact, where the means are taken
  // -, share of the points in contact that slide where the means are taken. Below 1 the scan was too short for
  // full sliding: W does not measure friction, and nothing is recovered from it.
  double slides = 0;
  // What else W depends on, in the same half of each traverse: friction has turned from along the lever to along the
  // scan (the smaller value of both), and the force has become steady.
  double turned = 1;  // -, share of friction along the scan; 1 where the surface does not show it
  double drift = 0;   // -, of the force on a plane, over W
  double needed = 0;  // m, scan length needed, estimated from the force so far; 0: long enough
  double trace = 0, retrace = 0;      // N, mean force along the scan that drags the probe
  double half_width = 0, offset = 0;  // N, W and Delta
  double volts_half_width = 0, volts_offset = 0;  // V, of the lateral detector
  bool on_slope = false;                          // along the scan: a wedge calibration
  std::optional<double> friction;     // recovered from the volts, on a slope along the scan
  std::optional<double> other_root;   // of it, where that would not lock the tip
  std::optional<double> sensitivity;  // N/V, recovered along with it
  bool full() const { return slides > 1 - 1e-3 && turned > 1 - 1e-3 && drift < 0.01; }
};

// Of a programme: a row of afm_series for every sample.
struct AfmHistory {
  std::vector<double> times;
  std::vector<std::vector<double>> rows;
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(times, rows);
  }
  double value(std::size_t sample, const std::string& series) const;
};

// From all loops together, using the detector's volts: several loads where the programme has them (Ogletree).
// Empty without a slope along the scans, or where no friction fits.
std::optional<wedge::Calibration> calibrate_wedge(const Scene& scene,
                                                  const std::vector<FrictionLoop>& loops);

// For every scan that has a trace and a retrace; means over the last half of each traverse.
std::vector<FrictionLoop> friction_loops(const Scene& scene, const AfmHistory& history);

}  // namespace pulvis
