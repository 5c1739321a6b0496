#include "scenes/space/packing/place.hpp"

namespace pulvis::space {

std::vector<BodySpec> place_bodies(const Scene& scene) { return scene.space->bodies; }

}  // namespace pulvis::space
