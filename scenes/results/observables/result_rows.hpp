// The groups of results: each adds its rows to the table of a scene, if the scene has it. Series in the order of history.csv,
// fields in the order of the frames.
#pragma once

#include "scenes/results/parts/frame_fields.hpp"
#include "scenes/results/parts/observables.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

void add_tool_series(const Scene& scene, Observables& all);
void add_die_series(const Scene& scene, Observables& all);   // of the space between the tools
void add_cell_series(const Scene& scene, Observables& all);  // of a periodic cell, or driven walls
void add_energy_series(const Scene& scene, Observables& all);
void add_contact_series(const Scene& scene, Observables& all);
void add_bond_series(const Scene& scene, Observables& all);
void add_stress_series(const Scene& scene, Observables& all);
void add_network_series(const Scene& scene, Observables& all);
void add_density_series(const Scene& scene, Observables& all);
void add_shear_series(const Scene& scene, Observables& all);

void add_cell_fields(const Scene& scene, FrameFields& all);
void add_stress_fields(const Scene& scene, FrameFields& all);
void add_network_fields(const Scene& scene, FrameFields& all);
void add_density_fields(const Scene& scene, FrameFields& all);
void add_bond_fields(const Scene& scene, FrameFields& all);
void add_shear_fields(const Scene& scene, FrameFields& all);

// Linear, then angular about the origin; not in the history.
void add_momentum(const Scene& scene, Observables& all);

}  // namespace pulvis
