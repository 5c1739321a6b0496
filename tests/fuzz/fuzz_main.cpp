// libFuzzer's entry to the target that the build names (PULVIS_FUZZ_TARGET).
#include <algorithm>
#include <string_view>

#include "targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto& target = *std::ranges::find_if(pulvis::fuzz::targets(), [](const auto& t) {
    return std::string_view(t.name) == PULVIS_FUZZ_TARGET;
  });
  target.run({data, size});
  return 0;
}
