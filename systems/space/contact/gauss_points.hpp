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

[[gnu::always_inline]] inline kernels::Vector<Lane> sampled_points(const PatchNumbers& face,
                                                                   int half) {
  kernels::Vector<Lane> x{Lane{}, Lane{}, Lane{}};
  for (int p = 0; p < patch_points; ++p) {
    const Lane n = Lane::load(entry(entry(basis_at_points, half), p).data());
    x = {fma(n, Lane(face(0, p)), x.x), fma(n, Lane(face(1, p)), x.y),
         fma(n, Lane(face(2, p)), x.z)};
  }
  return x;
}
// Both halves at once: the numbers of the face are read only once.
[[gnu::always_inline]] inline std::array<kernels::Vector<Lane>, 2> sampled_points(
    const PatchNumbers& face) {
  std::array<kernels::Vector<Lane>, 2> x{};
  for (int p = 0; p < patch_points; ++p) {
    const Lane at_x(face(0, p)), at_y(face(1, p)), at_z(face(2, p));
    for (int half = 0; half < 2; ++half) {
      const Lane n = Lane::load(entry(entry(basis_at_points, half), p).data());
      kernels::Vector<Lane>& sum = entry(x, half);
      sum = {fma(n, at_x, sum.x), fma(n, at_y, sum.y), fma(n, at_z, sum.z)};
    }
  }
  return x;
}

}  // namespace pulvis::space
