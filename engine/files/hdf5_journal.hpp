// HDF5 on top of a JournaledFile: every H5Fflush is a commit, and a killed program leaves the file as it
// was after the last one. The file is not locked, so that others may read it while it is written. Used by
// hdf5.cpp and hdf5_change.cpp only.
#pragma once

#include "engine/files/hdf5_api.hpp"

#include <cstdint>

namespace pulvis::hdf5 {

constexpr std::uint64_t page_bytes = 4096;  // written by a single write

// For H5Pset_driver on an access property list.
hid_t journal_driver();

}  // namespace pulvis::hdf5
