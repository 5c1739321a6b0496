// Particles made of grains.
#pragma once

#include <vector>

#include "scenes/language/problem.hpp"
#include "scenes/language/schema.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Divides every class that asks for it: ParticleSpec::tessellations and Scene::grains. Called after the packings are
// filled, whose particles may have individual sizes.
void make_grains(Scene& scene, const schema::Origins& origins, Problems& problems);

// Every grain as a body, in the order of the particles; a particle without grains is one body. BodySpec::parent is
// the number of the particle.
std::vector<BodySpec> grains_of(const Scene& scene, const std::vector<BodySpec>& particles);

}  // namespace pulvis
