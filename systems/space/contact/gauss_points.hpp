// The Gauss points of a face, eight at a time: u first, v of the halves 0 1 and 2 3.
#pragma once

#include "components/space/contact.hpp"
#include "systems/space/contact/patch_kernel.hpp"

namespace pulvis::space {

// [half][Bezier point][Gauss point]
inline constexpr auto basis_at_points = [] {
  std::array<std::array<std::array<double, lane_count>, 16>, 2> n{};
  for (std::size_t g = 0; g < face_points; ++g) {
    const auto u = kernels::bernstein(kernels::gauss_at[g % 4]);
    const auto v = kernels::bernstein(kernels::gauss_at[g / 4]);
    for (std::size_t p = 0; p < 16; ++p) n[g / 8][p][g % 8] = u[p % 4] * v[p / 4];
  }
  return n;
}();

[[gnu::always_inline]] inline kernels::Vector<Lane> sampled_points(const double* face, int half) {
  kernels::Vector<Lane> x{Lane{}, Lane{}, Lane{}};
  for (std::size_t p = 0; p < 16; ++p) {
    const Lane n = Lane::load(basis_at_points[static_cast<std::size_t>(half)][p].data());
    x = {fma(n, Lane(face[p]), x.x), fma(n, Lane(face[16 + p]), x.y),
         fma(n, Lane(face[32 + p]), x.z)};
  }
  return x;
}

}  // namespace pulvis::space
