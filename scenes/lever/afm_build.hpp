// The solid of an AFM scene, and where results are read: tip, foot, laser spot, clamp.
#pragma once

#include <array>
#include <memory>

#include "engine/world.hpp"
#include "scenes/lever/mesh/tip_mesh.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis {

// A place on the lever's back and its surface slope: differences of displacements along the lever
// and across it.
struct SlopeGauge {
  Gauge along, across;  // 1/m
};

struct AfmModel {
  std::unique_ptr<World> world;
  Vec3 axis, side, up;           // of the lever at rest, in the frame of the sample; side = y
  Gauge end;                     // the end of the tip
  Gauge foot;                    // middle plane of the lever above the tip
  SlopeGauge foot_slope;         // at the foot
  std::vector<SlopeGauge> spot;  // points of the laser spot, on the lever's back
  TipMesh tip;
  int contact_node = 0;         // the middle node of a sharp tip's end
  double normal_stiffness = 0;  // N/m, at rest; 0 until calibrated
  std::size_t nodes = 0, elements = 0;
};

AfmModel build_afm(const Scene& scene);

Vec3 clamp_force(const AfmModel& model);       // N, exerted by the clamp on the lever
double elastic_energy(const AfmModel& model);  // J

// Mean of a nodal field [3 nodes].
Vec3 read(const Gauge& gauge, const double* field);

// Rotations of the lever's back in rad: normal > 0 where its end has moved up (+z), lateral > 0
// where it has rotated about +x (its +y side moved up).
struct Slopes {
  double normal = 0, lateral = 0;
};
Slopes slopes(const AfmModel& model, const std::vector<SlopeGauge>& gauges,
              const double* displacement);

}  // namespace pulvis
