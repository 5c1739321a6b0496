// What adheres in an AFM scene.
#pragma once

#include <optional>

#include "components/probe.hpp"
#include "scenes/lever/mesh/solid_draft.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

AdhesiveBall adhesive_ball(const Scene& scene);  // work 0 unless the scene asks for JKR
double pull_off_force(const Scene& scene);       // N, of either law; 0 without a surface

// Where an adhesive ball's sample faces, in the frame of the lever at rest, which `turn` turns into that
// of the sample; nothing without one.
std::optional<Vec3> adhesive_normal(const Scene& scene, const Eigen::Matrix3d& turn);

}  // namespace pulvis
