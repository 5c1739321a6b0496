// What run.h5 contains once: the mesh, the properties of its particles, and the tool outlines.
#pragma once

#include "engine/files/hdf5.hpp"
#include "engine/files/record.hpp"

namespace pulvis {

// /mesh, and also /particles and /tools if the mesh has them.
void write_mesh(hdf5::File& file, const RunMesh& mesh);

}  // namespace pulvis
