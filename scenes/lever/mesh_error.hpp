// How far the mesh of a lever leaves its stiffness from the converged one.
//
// Source   by how much the stiffness falls from a mesh whose edges are 1.6 times as long. Meshes of fully integrated
//          elements are too stiff, and the error falls with the edge's power of 1 (the rim of a stiff foot) to 2, so
//          that what is left is 0.6 to 1.7 of that; docs/accuracy.md has it beside converged references
#pragma once

#include <optional>

#include "scenes/lever/afm_calibration.hpp"

namespace pulvis {

// Nothing where the mesh is the user's own.
std::optional<MeshError> mesh_error(const Scene& scene, const Calibration& calibration,
                                    int threads);

}  // namespace pulvis
