// What the machine itself can do, measured beside the program, and what it is.
#pragma once

#include <string>

namespace pulvis::bench {

// A second, in double precision: fused multiply-adds in the widest registers there are, each two operations
// a lane, from and to registers.
double peak_flops(int threads);

// Bytes a second of a[i] = b[i] + s c[i] over arrays that no cache holds: three doubles an i, as STREAM
// counts. (The line of a that is read before it is written comes on top, unseen.)
double triad_bandwidth(int threads);

std::string compiler();

// Bytes of this process in memory now.
double resident_bytes();

}  // namespace pulvis::bench
