// Which variant of the core library the dynamic loader took for this processor.
#pragma once

namespace pulvis {

// "AVX-512", "AVX2" or "portable". All three give the same bits.
const char* instruction_set();

}  // namespace pulvis
