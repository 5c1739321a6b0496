// What run.h5 has once: the mesh, what its particles are, and the lines around the tools.
#pragma once

#include "engine/files/hdf5.hpp"
#include "engine/files/record.hpp"

namespace pulvis {

// /mesh, and /particles and /tools where the mesh has them.
void write_mesh(hdf5::File& file, const RunMesh& mesh);

}  // namespace pulvis
