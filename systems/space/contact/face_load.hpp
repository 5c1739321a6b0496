// Load on the sixteen Bezier points of a face, held in registers while points are added one by one.
#pragma once

#include <array>

#include "components/space/contact.hpp"
#include "engine/lane.hpp"
#include "engine/lane_memory.hpp"

namespace pulvis::space {

// One number per Bezier point of a face, in order.
using OfPatch = std::array<Lane, 2>;

// b_i(u) c_j(v), from four values each
[[gnu::always_inline]] inline OfPatch outer(const double* b, const double* c) {
  const Lane along_u = load_halves(b, b);
  return {along_u * halves(c[0], c[1]), along_u * halves(c[2], c[3])};
}

struct FaceLoad {
  std::array<OfPatch, 3> sum;  // N: x, y, z

  void clear() {
    for (OfPatch& of : sum) of = {Lane{}, Lane{}};
  }
  void fetch(const double* face) {
    for (int k = 0; k < 3; ++k)
      entry(sum, k) = {Lane::load(face + 16 * k), Lane::load(face + 16 * k + lane_count)};
  }
  void store(double* face) const {
    for (int k = 0; k < 3; ++k)
      for (int half = 0; half < 2; ++half)
        entry(entry(sum, k), half).store(face + 16 * k + lane_count * half);
  }
  // share * force
  [[gnu::always_inline]] void add(const OfPatch& share, const std::array<double, 3>& force) {
    for (int k = 0; k < 3; ++k) {
      const Lane f(entry(force, k));
      OfPatch& of = entry(sum, k);
      of = {fma(share[0], f, of[0]), fma(share[1], f, of[1])};
    }
  }
};

}  // namespace pulvis::space
