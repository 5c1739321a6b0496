// Calibration of a cantilever: its response to small forces on its tip, compared with closed forms.
//
// Forces act at the tip's end in the frame of the sample: z normal to it, y lateral, x along. Stiffness is
// force over the displacement of that end along the force.
#pragma once

#include "scenes/lever/afm_build.hpp"
#include "scenes/lever/afm_closed_forms.hpp"

namespace pulvis {

// The response to a force of 1 N at the tip's end.
struct UnitResponse {
  Vec3 end;        // m/N, of the tip's end
  Vec3 foot;       // m/N, of the middle plane above the tip
  Slopes spot;     // rad/N, of the laser spot
  Slopes at_foot;  // rad/N
  Vec3 clamp_force,
      clamp_moment;  // N per N, N m per N (about the clamp's middle): of the clamp on the lever
  double error = 0;  // -, of the solution: last correction and energy error
};

// -, by how much the mesh overestimates the stiffnesses: scenes/lever/mesh_error.hpp.
struct MeshError {
  double normal = 0, lateral = 0, longitudinal = 0;
};

struct Calibration {
  UnitResponse normal, lateral, longitudinal;  // to forces along z, y, x
  double arm = 0;                              // m, h: from the middle plane to the tip's end
  double normal_stiffness = 0, lateral_stiffness = 0, longitudinal_stiffness = 0;  // N/m
  double torsional_stiffness = 0;  // N m/rad, of the foot, for the lateral force's moment about it
  // -, of the end's lateral displacement: bending of the lever, twist of the foot, tip compliance.
  double bending_share = 0, twist_share = 0, tip_share = 0;
  double normal_invols = 0, lateral_invols = 0;  // m/V, tip displacement per detector signal
  double imbalance = 0;                          // -, |clamp force + applied force| over the latter
  double error = 0;                              // -, the largest of the three
  bool extended = false;                         // stiffness factorised in long double
  bool stable = true;                            // all pivots of the stiffness are positive
  std::optional<MeshError> mesh_error;           // empty where it was not estimated
  std::vector<ClosedForm> closed_forms;

  bool good(double tolerance) const { return stable && error <= tolerance; }
};

// The world's solver must have been linearised at rest.
class StaticSolver;
Calibration calibrate(const Scene& scene, AfmModel& model, StaticSolver& solver);

// Displacements [3 nodes] due to a force of 1 N at the tip's end.
std::vector<double> unit_displacements(AfmModel& model, StaticSolver& solver,
                                       const Vec3& direction);

}  // namespace pulvis
