// The C library of HDF5 with the interface of 1.10: later versions (tried: 1.14) keep it, but their default is another one, with
// other structs behind the same names.
#pragma once

#define H5_USE_110_API
#include <hdf5.h>
