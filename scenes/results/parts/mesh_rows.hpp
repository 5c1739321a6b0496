// The fields of nodes and elements, as rows of both dimensions.
#pragma once

#include <vector>

#include "scenes/results/parts/particle_values.hpp"

namespace pulvis {

// How the values of the elements are read.
struct ElementReaders {
  ParticleValues effective, pressure, stress;
  ParticleValues plastic_strain;  // empty if no material yields
};

template <class D>
std::vector<MeshField> mesh_rows(ElementReaders elements);

}  // namespace pulvis
