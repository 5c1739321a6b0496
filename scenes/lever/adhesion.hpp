// The adhesion of an AFM scene.
#pragma once

#include <optional>

#include "components/probe.hpp"
#include "scenes/lever/mesh/solid_draft.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

AdhesiveBall adhesive_ball(const Scene& scene);  // work of adhesion 0 unless JKR is requested
double pull_off_force(const Scene& scene);       // N, for either law; 0 without a surface

// Surface normal of the sample under an adhesive ball, in the frame of the lever at rest; `turn`
// transforms from there to the sample's frame. Empty without an adhesive ball.
std::optional<Vec3> adhesive_normal(const Scene& scene, const Eigen::Matrix3d& turn);

}  // namespace pulvis
