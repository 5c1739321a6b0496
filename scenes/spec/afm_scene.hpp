// A scene of the family "afm" as read: a lever, its tip, the target surface and the programme
// of actions. Plain values in SI units; scenes/lever/afm_build.* builds the solid from it.
//
// Axes before the chip is tilted: x along the lever from the clamp to its end, y across it, z up, away
// from the sample. z = 0 is the mid-plane of the lever (of its own material, without the coating).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "components/solid.hpp"
#include "scenes/language/source_mark.hpp"

namespace pulvis {

struct LeverSolid;  // scenes/lever/mesh/meshed_lever.hpp

struct LeverSpec {
  enum class Shape { beam, v, mesh } shape = Shape::beam;
  int material = 0;
  double length = 0;                 // m, clamp to end
  double width = 0;                  // m, beam
  double thickness = 0;              // m
  double arm_width = 0;              // m, V: arm width, perpendicular to the arm
  std::optional<double> half_angle;  // rad, V: between an arm and the axis
  std::optional<double> base_width;  // m, V: across both arms at the clamp, instead of the angle
  double apex_width = 0;             // m, V: of its blunt end; 0: ends in a point
  double tilt = 0;                 // rad, of the chip: the end of the lever is lower than the clamp
  std::optional<int> coating;      // material of the layer on its back
  double coating_thickness = 0;    // m
  double aspect = 6;               // -, in-plane element edge over the lever's thickness
  double side_aspect = 0.5;        // -, the same perpendicular to a free side, next to it
  double foot_edge = 0.03;         // -, at the rim of the tip's foot, over its width
  std::optional<int> foot_layers;  // of solid elements there; 0: plates; absent: from foot_aspect
  double coarser = 1;              // -, factor on all those edges, to estimate their error
  int layers = 1;                  // of elements through the thickness
  int along = 0, across = 0;       // elements of a beam, uniform; 0: graded
  HexFormulation element = HexFormulation::plate;
  std::string file;                         // mesh: a Gmsh file
  double unit = 1;                          // m, unit of length of the file
  std::shared_ptr<const LeverSolid> solid;  // its contents; length and thickness are taken from it
  SourceMark mark;
};

struct TipSolid;  // scenes/lever/mesh/meshed_tip.hpp

struct TipSpec {
  enum class Shape { none, block, pyramid, cone, sphere, mesh } shape = Shape::none;
  int material = 0;
  double height = 0;      // m, from the lever's lower face to the tip's end; not for a sphere
  double foot = 0;        // m, width (cone: diameter) where it meets the lever
  double end = 0;         // m, the same at its end
  double end_radius = 0;  // m, rounding of the end facing the sample; not for a sphere
  double radius = 0;      // m, sphere
  double neck_radius = 0, neck_height = 0;  // m, glue between the lever and the sphere's top
  std::optional<int> glue;                  // material of the neck; absent: that of the tip
  std::string file;                         // mesh: a Gmsh file; empty: the tip is in the lever's file
  double unit = 1;                          // m, unit of length of the file
  std::shared_ptr<const TipSolid> solid;    // its contents
  double set_back = 0;                      // m, of its axis from the lever's end
  double offset = 0;                        // m, of its axis from the lever's axis, along y
  int elements = 4;                         // across it
  std::optional<double> contact_edge;       // m, of a sphere's elements at the contact
  std::optional<double>
      contact_reach;  // m, radius around its pole; absent: eight edges, at most half the radius
  SourceMark mark;
};

struct LaserSpec {
  std::optional<double> position;  // m, of the spot's centre from the clamp; absent: above the tip
  double offset = 0;               // m, from the axis
  double radius = 0;               // m, of the spot; 0: a point
};

struct DetectorSpec {
  double normal_gain = 0, lateral_gain = 0;  // V/rad
};

// The sample: rigid, moved by the scanner. Profiles rise along one horizontal direction.
struct TargetSpec {
  enum class Shape { plane, bump, step, sinusoid, map } shape = Shape::plane;
  enum class Direction { lateral, along } direction = Direction::lateral;
  double incline = 0;     // rad, plane: rises towards + of the direction
  double height = 0;      // m, bump, step; sinusoid: peak to valley
  double slope = 0;       // -, of a bump's flanks or a step's edge
  double plateau = 0;     // m, top of a bump
  double position = 0;    // m, where the first flank begins, measured from below the tip
  double wavelength = 0;  // m, sinusoid
  std::string file;       // map: heights in m, rows along +y, columns along +x
  std::string dataset;    // in that file, if it is HDF5
  double spacing = 0;     // m, between the map's points
  double friction = 0;    // -
  enum class Adhesion { dmt, jkr } adhesion = Adhesion::dmt;
  double pull_off = 0;  // N, DMT
  double range = 1e-9;  // m, of adhesion, DMT
  double work = 0;      // J/m^2, JKR
};

// One action of the programme; its path is divided into `increments` steps.
struct ActionSpec {
  enum class Kind { press, scan, retract, hold, raster } kind = Kind::press;
  std::string name;
  double distance = 0;          // m, of the scanner: up (press), down (retract) or sideways (scan)
  std::optional<double> force;  // N, press: the scanner rises until the target exerts this force
  TargetSpec::Direction direction = TargetSpec::Direction::lateral;  // scan, raster: of the probe
  bool retrace = true;                                               // scan: with a retrace
  bool servo = false;  // scan, hold: the height is controlled to keep the force constant
  int increments = 20;
  double width = 0;  // m, raster: extent along the slow axis, perpendicular to the fast one
  int lines = 0;     // raster
  SourceMark mark;

  std::size_t samples() const {  // rows in the history
    const int lines_scanned = kind == Kind::raster            ? 2 * lines
                              : kind == Kind::scan && retrace ? 2
                                                              : 1;
    return static_cast<std::size_t>(increments) * static_cast<std::size_t>(lines_scanned);
  }
};

struct AfmScene {
  LeverSpec lever;
  TipSpec tip;
  LaserSpec laser;
  DetectorSpec detector;
  std::optional<TargetSpec> target;  // [surface]
  std::vector<ActionSpec> actions;   // [[action]]
};

}  // namespace pulvis
