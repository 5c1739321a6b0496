// Hardness of the faces of a pair of particles (SurfaceHardness), where surfaces indent.
#pragma once

#include <array>

#include "components/space/contact.hpp"
#include "engine/prefetch.hpp"
#include "systems/laws/normal_contact.hpp"
#include "systems/space/contact/pair_points.hpp"

namespace pulvis::space {

class PairHardness {
 public:
  using Column = Optional<Read<SurfaceHardness<ThreeD>>>;
  PairHardness() = default;
  PairHardness(const Column& of, int sampled, int other) {
    if (!of) return;
    const double* all = of->values().data();
    own_ = all + Number::count * first_row(of->table(), sampled);
    its_ = all + Number::count * first_row(of->table(), other);
  }
  explicit operator bool() const { return own_ != nullptr; }

  void fetch_own(int face) const {
    if (own_ != nullptr) prefetch(own_ + Number::count * face);
  }
  void fetch_other(int face) const {
    if (its_ != nullptr) prefetch(its_ + Number::count * face);
  }
  pulvis::kernels::Hardness<double> of_own(int face) const { return at(own_, face); }
  // Of the softer surface of eight points. `state`: theirs.
  pulvis::kernels::Hardness<Lane> softer(const std::array<Lane, 8>& state,
                                         const PointLanes& eight) const {
    if (eight.bonded) return {pulvis::kernels::no_hardness, 1.0};
    alignas(64) std::array<double, lane_count> pressure, left;
    for (int l = 0; l < lane_count; ++l) {
      const auto its = at(its_, entry(eight.face, l));
      entry(pressure, l) = its.pressure;
      entry(left, l) = its.left;
    }
    return {min(state[PairPoint::pressure], Lane::load(pressure.data())),
            min(state[PairPoint::left], Lane::load(left.data()))};
  }

 private:
  using Number = SurfaceHardness<ThreeD>;
  static pulvis::kernels::Hardness<double> at(const double* faces, int face) {
    if (faces == nullptr) return {pulvis::kernels::no_hardness, 1};
    const double* number = faces + Number::count * face;
    return {number[Number::pressure], number[Number::left]};
  }

  const double *own_ = nullptr,
               *its_ = nullptr;  // of the first faces; null: surfaces do not indent
};

}  // namespace pulvis::space
