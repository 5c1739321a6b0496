// Estimated discretisation error of a lever's stiffness.
//
// Source   the drop in stiffness relative to a mesh with edges 1.6 times as long. Meshes of fully integrated
//          elements are too stiff, and the error scales with the edge to the power 1 (at the rim of a stiff foot) to
//          2, so that the remaining error is 0.6 to 1.7 times that drop; docs/accuracy.md has converged references.
//          A uniform mesh resolves neither the strips at the sides nor the rim of the foot, so that a coarser one is
//          hardly stiffer: it is compared with the graded mesh instead
// Judged    the largest of the three. From `doubtful_mesh` on it is a warning: more than careful calibrations of real levers
//          disagree by (5 to 10%), and ten times that of any default mesh of a usual lever. From `unusable_mesh` on the
//          warning says that it is no stiffness of the lever: should the error fall no faster than the edge, it is then
//          100% itself. The run goes on: locking elements may be what is looked at.
#pragma once

#include <optional>
#include <string>

#include "scenes/lever/afm_calibration.hpp"

namespace pulvis {

// Empty where the user supplies the mesh in a file, or where the graded mesh would be too large.
std::optional<MeshError> mesh_error(const Scene& scene, const Calibration& calibration,
                                    int threads);

inline constexpr double doubtful_mesh = 0.05, unusable_mesh = 0.6;  // -

// One line; empty for a small error.
std::string mesh_warning(const MeshError& error);

}  // namespace pulvis
