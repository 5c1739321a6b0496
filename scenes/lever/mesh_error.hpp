// Estimated discretisation error of a lever's stiffness.
//
// Source   the drop in stiffness relative to a mesh with edges 1.6 times as long. Meshes of fully integrated
//          elements are too stiff, and the error scales with the edge to the power 1 (at the rim of a stiff foot) to
//          2, so that the remaining error is 0.6 to 1.7 times that drop; docs/accuracy.md has converged references.
//          A uniform mesh resolves neither the strips at the sides nor the rim of the foot, so that a coarser one is
//          hardly stiffer: it is compared with the graded mesh instead
#pragma once

#include <optional>

#include "scenes/lever/afm_calibration.hpp"

namespace pulvis {

// Empty where the user supplies the mesh in a file, or where the graded mesh would be too large.
std::optional<MeshError> mesh_error(const Scene& scene, const Calibration& calibration,
                                    int threads);

}  // namespace pulvis
