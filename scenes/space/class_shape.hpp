// The undeformed shape of a particle class, or why its mesh cannot be used.
#pragma once

#include "components/space/shape.hpp"
#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

// `particle`: position in SpaceScene::particles. Throws SceneError at the class where its mesh or its smooth surface is folded.
Shape class_shape(const Scene& scene, std::size_t particle);

// Greatest distance of the smooth surface, which contacts see, from the true one, over the radius of the ball of the same
// volume.
double surface_error_share(const Shape& shape);

// One line for each class whose smooth surface, which contacts see, stands far off the true one.
std::vector<std::string> coarse_surface_warnings(const Scene& scene);

}  // namespace pulvis::space
