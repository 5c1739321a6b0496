// HDF5 over a JournaledFile: every H5Fflush is a commit, and a program that is killed leaves the file as it
// was after the last one. The file takes no lock, so that others may read it while it is written. Seen by
// hdf5.cpp only.
#pragma once

#include <hdf5.h>

namespace pulvis::hdf5 {

// For H5Pset_driver on an access property list.
hid_t journal_driver();

}  // namespace pulvis::hdf5
