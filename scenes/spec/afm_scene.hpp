// A scene of the family "afm" as it was read: a lever, its tip, what it is held against and what is done
// with it. Plain values in SI units; scenes/lever/afm_build.* makes the solid of it.
//
// Axes before the chip is tilted: x along the lever from the clamp to its end, y across it, z up, away
// from the sample. z = 0 is the lever's middle plane (of its own material, without the coating).
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
  double arm_width = 0;              // m, V: square across an arm
  std::optional<double> half_angle;  // rad, V: between an arm and the axis
  std::optional<double> base_width;  // m, V: over both arms at the clamp, instead of the angle
  double apex_width = 0;             // m, V: of its blunt end; 0: it ends in a point
  double tilt = 0;                 // rad, of the chip: the end of the lever is lower than the clamp
  std::optional<int> coating;      // material of the layer on its back
  double coating_thickness = 0;    // m
  double aspect = 6;               // -, edge of an element in the plane over the lever's thickness
  double side_aspect = 0.5;        // -, the same square to a free side, at it
  double foot_edge = 0.03;         // -, at the rim of the tip's foot, over its width
  std::optional<int> foot_layers;  // of solid elements there, 0: plates; absent: by foot_aspect
  double coarser = 1;              // -, all those edges: for an estimate of their error
  int layers = 1;                  // of elements through the thickness
  int along = 0, across = 0;       // elements of a beam, evenly; 0: graded
  HexFormulation element = HexFormulation::plate;
  std::string file;                         // mesh: of Gmsh
  double unit = 1;                          // m, of the file's lengths
  std::shared_ptr<const LeverSolid> solid;  // what it holds; length and thickness are its own
  SourceMark mark;
};

struct TipSolid;  // scenes/lever/mesh/meshed_tip.hpp

struct TipSpec {
  enum class Shape { none, block, pyramid, cone, sphere, mesh } shape = Shape::none;
  int material = 0;
  double height = 0;      // m, from the lever's lower face to the tip's end; not of a sphere
  double foot = 0;        // m, width (cone: diameter) where it stands on the lever
  double end = 0;         // m, the same at its end
  double end_radius = 0;  // m, rounding of the end against the sample; not of a sphere
  double radius = 0;      // m, sphere
  double neck_radius = 0, neck_height = 0;  // m, glue between the lever and the sphere's top
  std::optional<int> glue;                  // material of the neck; absent: that of the tip
  std::string file;                         // mesh: of Gmsh; empty: the tip is in the lever's
  double unit = 1;                          // m, of the file's lengths
  std::shared_ptr<const TipSolid> solid;    // what it holds
  double set_back = 0;                      // m, its axis from the lever's end
  double offset = 0;                        // m, its axis from the lever's axis, along y
  int elements = 4;                         // across it
  std::optional<double> contact_edge;       // m, of a ball's elements where it touches
  std::optional<double>
      contact_reach;  // m, how far around its pole; absent: eight edges, half the radius at most
  SourceMark mark;
};

struct LaserSpec {
  std::optional<double> position;  // m, of the spot's middle from the clamp; absent: above the tip
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
  double height = 0;      // m, bump, step; of a sinusoid: peak to valley
  double slope = 0;       // -, flanks of a bump, edge of a step
  double plateau = 0;     // m, top of a bump
  double position = 0;    // m, where the first flank begins, from under the tip
  double wavelength = 0;  // m, sinusoid
  std::string file;       // map: heights in m, rows along +y, columns along +x
  std::string dataset;    // in it, where it is HDF5
  double spacing = 0;     // m, of the map's points
  double friction = 0;    // -
  enum class Adhesion { dmt, jkr } adhesion = Adhesion::dmt;
  double pull_off = 0;  // N, DMT
  double range = 1e-9;  // m, of adhesion, DMT
  double work = 0;      // J/m^2, JKR
};

// One part of the programme, in `increments` steps at most as long as the path.
struct ActionSpec {
  enum class Kind { press, scan, retract, hold, raster } kind = Kind::press;
  std::string name;
  double distance = 0;          // m, of the scanner: up (press, retract: down) or sideways (scan)
  std::optional<double> force;  // N, press: the height follows until the target pushes with this
  TargetSpec::Direction direction = TargetSpec::Direction::lateral;  // scan, raster: of the probe
  bool retrace = true;                                               // scan: and the retrace
  bool servo = false;  // scan, hold: the height follows so that the force stays
  int increments = 20;
  double width = 0;  // m, raster: extent along the slow axis, square to the fast one
  int lines = 0;     // raster
  SourceMark mark;

  std::size_t samples() const {  // of the history
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
