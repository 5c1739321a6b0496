// The processor: which variant of the core library the dynamic loader chose for it, and the floating-point mode of a thread.
#pragma once

#include <cstdint>

#ifdef __x86_64__
#include <xmmintrin.h>
#endif

namespace pulvis {

// "AVX-512", "AVX2" or "portable". All three give bitwise identical results.
const char* instruction_set();

// Rounding, exceptions, and whether denormals are flushed to zero; of x86-64 and aarch64.
using FloatingMode = std::uint64_t;

#ifdef __x86_64__
inline constexpr FloatingMode denormals_to_zero = 0x8040;  // MXCSR: FTZ and DAZ
inline FloatingMode floating_mode() { return _mm_getcsr(); }
inline void set_floating_mode(FloatingMode mode) { _mm_setcsr(static_cast<unsigned>(mode)); }
#else
inline constexpr FloatingMode denormals_to_zero = FloatingMode{1} << 24U;  // FPCR: FZ
inline FloatingMode floating_mode() {
  FloatingMode mode;
  asm volatile("mrs %0, fpcr" : "=r"(mode));
  return mode;
}
inline void set_floating_mode(FloatingMode mode) { asm volatile("msr fpcr, %0" ::"r"(mode)); }
#endif

}  // namespace pulvis
