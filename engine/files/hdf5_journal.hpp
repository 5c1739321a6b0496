// HDF5 over a JournaledFile: every H5Fflush is a commit, and a program that is killed leaves the file as it
// was after the last one. The file takes no lock, so that others may read it while it is written. Seen by
// hdf5.cpp and hdf5_change.cpp only.
#pragma once

#include <hdf5.h>

#include <cstdint>

namespace pulvis::hdf5 {

constexpr std::uint64_t page_bytes = 4096;  // changes with one write

// For H5Pset_driver on an access property list.
hid_t journal_driver();

}  // namespace pulvis::hdf5
