// The undeformed shape of a particle class, or the reason why its mesh cannot be used.
#pragma once

#include "components/space/shape.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

// `particle`: index in Scene::particles. Throws SceneError for the class if its mesh or its smooth surface is folded.
Shape class_shape(const Scene& scene, std::size_t particle);

// Maximum distance of the smooth surface, which contacts use, from the true one, relative to the radius of the sphere of
// equal volume.
double surface_error_share(const Shape& shape);

// One line for each class whose smooth surface, which contacts use, deviates strongly from the true one.
std::vector<std::string> coarse_surface_warnings(const Scene& scene);

}  // namespace pulvis::space
