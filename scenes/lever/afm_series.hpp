// The history of a lever's programme as one table: every series is a row with its description and how it is read.
#pragma once

#include <vector>

#include "engine/files/record.hpp"
#include "scenes/lever/mesh/solid_draft.hpp"

namespace pulvis {

// What an increment of the programme leaves in the history.
struct AfmIncrement {
  Vec3 scanner = Vec3::Zero();                      // m, travel of the sample
  Vec3 force = Vec3::Zero(), clamp = Vec3::Zero();  // N, on the probe; on the lever
  Vec3 end = Vec3::Zero();                          // m, displacement of the tip's end
  double foot = 0, twist = 0;                       // m, rad: of the lever above the tip, lateral
  double slope_normal = 0, slope_lateral = 0;       // rad, at the laser spot
  double volts_normal = 0, volts_lateral = 0;       // V, of the detector
  double points = 0, sliding = 0;                   // in contact; share that slides
  double radius = 0, pressure = 0;                  // m, Pa, of the contact of a ball
  double elastic = 0, released = 0, pulling = 0;    // J
  int iterations = 0;
  double lowest_force = 0;  // N, vertical
};

std::vector<SeriesInfo> afm_series();
// One value per series.
std::vector<double> afm_row(const AfmIncrement& increment);

}  // namespace pulvis
