// Peak performance of the machine, measured along with the program, and its description.
#pragma once

#include <string>

namespace pulvis::bench {

// Operations per second in double precision: fused multiply-adds in the widest available registers, each
// two operations per lane, register to register.
double peak_flops(int threads);

// Bytes per second of a[i] = b[i] + s c[i] over arrays larger than any cache: three doubles per i, as in
// STREAM. (The write-allocate read of a is not counted.)
double triad_bandwidth(int threads);

std::string compiler();

// Current resident memory of this process in bytes.
double resident_bytes();

}  // namespace pulvis::bench
