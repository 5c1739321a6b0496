#include "engine/instruction_set.hpp"

#include "engine/register.hpp"

namespace pulvis {

const char* instruction_set() { return simd::instruction_set; }

}  // namespace pulvis
