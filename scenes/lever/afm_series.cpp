#include "scenes/lever/afm_series.hpp"

#include "scenes/results/parts/observables.hpp"

namespace pulvis {
namespace {

std::vector<Observable<AfmIncrement>> rows_of_increments() {
  const auto part = [](Vec3 AfmIncrement::*vector, int axis) {
    return [vector, axis](const AfmIncrement& i) { return (i.*vector)[axis]; };
  };
  return {
      {"scanner/x", "m", "displacement of the sample along x", part(&AfmIncrement::scanner, 0)},
      {"scanner/y", "m", "displacement of the sample along y", part(&AfmIncrement::scanner, 1)},
      {"scanner/z", "m", "rise of the sample from first contact", part(&AfmIncrement::scanner, 2)},
      {"probe/force_x", "N", "force of the sample on the probe", part(&AfmIncrement::force, 0)},
      {"probe/force_y", "N", "force of the sample on the probe: lateral",
       part(&AfmIncrement::force, 1)},
      {"probe/force_z", "N", "force of the sample on the probe: vertical",
       part(&AfmIncrement::force, 2)},
      {"probe/displacement_x", "m", "of the tip's end", part(&AfmIncrement::end, 0)},
      {"probe/displacement_y", "m", "of the tip's end", part(&AfmIncrement::end, 1)},
      {"probe/displacement_z", "m", "of the tip's end", part(&AfmIncrement::end, 2)},
      {"foot/displacement_y", "m", "of the lever's middle plane above the tip: lateral bending",
       &AfmIncrement::foot},
      {"foot/twist", "rad", "of the lever above the tip", &AfmIncrement::twist},
      {"clamp/force_x", "N", "of the clamp on the lever", part(&AfmIncrement::clamp, 0)},
      {"clamp/force_y", "N", "of the clamp on the lever", part(&AfmIncrement::clamp, 1)},
      {"clamp/force_z", "N", "of the clamp on the lever", part(&AfmIncrement::clamp, 2)},
      {"slope/normal", "rad", "of the lever's back at the laser spot, > 0: its end is up",
       &AfmIncrement::slope_normal},
      {"slope/lateral", "rad", "of the lever's back at the laser spot, > 0: its +y side is up",
       &AfmIncrement::slope_lateral},
      {"detector/normal", "V", "normal gain times slope", &AfmIncrement::volts_normal},
      {"detector/lateral", "V", "lateral gain times slope", &AfmIncrement::volts_lateral},
      {"contact/points", "-", "points of the probe in contact", &AfmIncrement::points},
      {"contact/radius", "m",
       "of a ball: square root of 5/2 times the mean square distance of the contact forces from "
       "their centre, equal to the contact radius of Hertz; of an adhesive ball the radius of its "
       "law",
       &AfmIncrement::radius},
      {"contact/pressure", "Pa",
       "of a ball: the largest nodal value; of an adhesive ball the value at the centre",
       &AfmIncrement::pressure},
      {"contact/slides", "-", "share of the contact points that slide", &AfmIncrement::sliding},
      {"energy/elastic", "J", "stored in lever and probe", &AfmIncrement::elastic},
      {"energy/released", "J", "released so far by jumps of the probe onto and off the surface",
       &AfmIncrement::released},
      {"newton/iterations", "-", "of the increment, including its subdivisions",
       &AfmIncrement::iterations},
      {"probe/lowest_force_z", "N",
       "lowest vertical force of the increment, including its subdivisions",
       &AfmIncrement::lowest_force},
      {"energy/pulling", "J", "area below the zero-force line so far, over the scanner's way down",
       &AfmIncrement::pulling}};
}

}  // namespace

std::vector<SeriesInfo> afm_series() {
  std::vector<SeriesInfo> all;
  for (const auto& row : rows_of_increments()) all.push_back({row.name, row.unit, row.meaning});
  return all;
}

std::vector<double> afm_row(const AfmIncrement& increment) {
  static const std::vector<Observable<AfmIncrement>> rows = rows_of_increments();
  std::vector<double> values;
  for (const auto& row : rows) values.push_back(row.read(increment));
  return values;
}

}  // namespace pulvis
