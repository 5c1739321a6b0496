#include "scenes/lever/afm_series.hpp"

#include <algorithm>
#include <iterator>

#include "scenes/results/parts/observables.hpp"

namespace pulvis {
namespace {

using Rows = std::vector<Observable<AfmIncrement>>;

Rows rows_of_the_lever() {
  const auto part = [](Vec3 AfmIncrement::*vector, int axis) {
    return [vector, axis](const AfmIncrement& i) { return (i.*vector)[axis]; };
  };
  return {
      {"scanner/x", "m", "scanner $x$", "displacement of the sample along x",
       part(&AfmIncrement::scanner, 0)},
      {"scanner/y", "m", "scanner $y$", "displacement of the sample along y",
       part(&AfmIncrement::scanner, 1)},
      {"scanner/z", "m", "scanner $z$", "rise of the sample from first contact",
       part(&AfmIncrement::scanner, 2)},
      {"probe/force_x", "N", "force on the tip $F_x$", "force of the sample on the probe",
       part(&AfmIncrement::force, 0)},
      {"probe/force_y", "N", "force on the tip $F_y$", "force of the sample on the probe: lateral",
       part(&AfmIncrement::force, 1)},
      {"probe/force_z", "N", "force on the tip $F_z$", "force of the sample on the probe: vertical",
       part(&AfmIncrement::force, 2)},
      {"probe/displacement_x", "m", "displacement of the tip $u_x$", "of the tip's end",
       part(&AfmIncrement::end, 0)},
      {"probe/displacement_y", "m", "displacement of the tip $u_y$", "of the tip's end",
       part(&AfmIncrement::end, 1)},
      {"probe/displacement_z", "m", "displacement of the tip $u_z$", "of the tip's end",
       part(&AfmIncrement::end, 2)},
      {"foot/displacement_y", "m", "lateral displacement of the foot $u_y$",
       "of the lever's middle plane above the tip: lateral bending", &AfmIncrement::foot},
      {"foot/twist", "rad", "twist of the foot $\\varphi$", "of the lever above the tip",
       &AfmIncrement::twist},
      {"clamp/force_x", "N", "force of the clamp $F_x$", "of the clamp on the lever",
       part(&AfmIncrement::clamp, 0)},
      {"clamp/force_y", "N", "force of the clamp $F_y$", "of the clamp on the lever",
       part(&AfmIncrement::clamp, 1)},
      {"clamp/force_z", "N", "force of the clamp $F_z$", "of the clamp on the lever",
       part(&AfmIncrement::clamp, 2)},
      {"slope/normal", "rad", "normal slope $\\theta$",
       "of the lever's back at the laser spot, > 0: its end is up", &AfmIncrement::slope_normal},
      {"slope/lateral", "rad", "lateral slope $\\varphi$",
       "of the lever's back at the laser spot, > 0: its +y side is up",
       &AfmIncrement::slope_lateral},
      {"detector/normal", "V", "normal signal $U_n$", "normal gain times slope",
       &AfmIncrement::volts_normal},
      {"detector/lateral", "V", "lateral signal $U_l$", "lateral gain times slope",
       &AfmIncrement::volts_lateral}};
}

Rows rows_of_the_contact() {
  return {
      {"contact/points", "-", "points in contact", "points of the probe in contact",
       &AfmIncrement::points},
      {"contact/radius", "m", "contact radius $a$",
       "of a ball: square root of 5/2 times the mean square distance of the contact forces from "
       "their centre, equal to the contact radius of Hertz; of an adhesive ball the radius of its "
       "law",
       &AfmIncrement::radius},
      {"contact/pressure", "Pa", "contact pressure $p$",
       "of a ball: the largest nodal value; of an adhesive ball the value at the centre",
       &AfmIncrement::pressure},
      {"contact/slides", "-", "share of sliding points", "share of the contact points that slide",
       &AfmIncrement::sliding},
      {"energy/elastic", "J", "elastic energy $E$", "stored in lever and probe",
       &AfmIncrement::elastic},
      {"energy/released", "J", "released energy $E$",
       "released so far by jumps of the probe onto and off the surface", &AfmIncrement::released},
      {"newton/iterations", "-", "Newton iterations",
       "of the increment, including its subdivisions", &AfmIncrement::iterations},
      {"probe/lowest_force_z", "N", "lowest vertical force $F_z$",
       "lowest vertical force of the increment, including its subdivisions",
       &AfmIncrement::lowest_force},
      {"energy/pulling", "J", "pull-off work $W$",
       "area below the zero-force line so far, over the scanner's way down",
       &AfmIncrement::pulling}};
}

Rows all_rows() {
  Rows all = rows_of_the_lever();
  std::ranges::move(rows_of_the_contact(), std::back_inserter(all));
  return all;
}

}  // namespace

std::vector<SeriesInfo> afm_series() {
  std::vector<SeriesInfo> all;
  for (const auto& row : all_rows()) all.push_back({row.name, row.unit, row.label, row.meaning});
  return all;
}

std::vector<double> afm_row(const AfmIncrement& increment) {
  static const Rows rows = all_rows();
  std::vector<double> values;
  for (const auto& row : rows) values.push_back(row.read(increment));
  return values;
}

}  // namespace pulvis
