// Which variant of the core library the dynamic loader chose for this processor.
#pragma once

namespace pulvis {

// "AVX-512", "AVX2" or "portable". All three give bitwise identical results.
const char* instruction_set();

}  // namespace pulvis
