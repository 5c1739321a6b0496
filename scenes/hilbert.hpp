// The Hilbert curve through a square: consecutive positions on it are close to each other.
#pragma once

#include <cstdint>

namespace pulvis {

// Index along the curve of the cell (x, y) of 2^order x 2^order, from 0.
inline std::uint64_t hilbert_number(int order, std::uint32_t x, std::uint32_t y) {
  const std::uint32_t last = (std::uint32_t{1} << order) - 1;
  std::uint64_t number = 0;
  for (std::uint32_t half = std::uint32_t{1} << (order - 1); half > 0; half /= 2) {
    const bool right = (x & half) != 0, up = (y & half) != 0;
    number += std::uint64_t{half} * half * ((right ? 3U : 0U) ^ (up ? 1U : 0U));
    if (up) continue;  // the lower quarters are rotated
    if (right) {
      x = last - x;
      y = last - y;
    }
    const std::uint32_t across = x;
    x = y;
    y = across;
  }
  return number;
}

}  // namespace pulvis
