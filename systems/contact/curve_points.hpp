// Points on contact curves, lane by lane (a CurvePoint, components/contact.hpp, is one of them).
#pragma once

#include <array>
#include <cstdint>

#include "engine/entry.hpp"
#include "systems/contact/two_candidates.hpp"

namespace pulvis {

struct CurvePoints {
  // By first control point, counted within the outline. As wide as what they are added to: addresses.
  std::array<std::int64_t, lane_count> edge;
  Lane u;

  // The closest points stored for two candidates.
  template <class Access, class At>
  static CurvePoints of(const Access& closest, const TwoCandidates<At>& two) {
    const Lane number = load_halves(&closest(two[0]).number, &closest(two[1]).number);
    const Lane first = whole(number);
    std::array<double, lane_count> edges;
    first.store(edges.data());
    CurvePoints at;
    for (std::size_t l = 0; l < lane_count; ++l) at.edge[l] = static_cast<std::int64_t>(edges[l]);
    at.u = number - first;
    return at;
  }
  template <class Access, class At>
  void keep(const Access& closest, const TwoCandidates<At>& two) const {
    const Lane first = Lane::from([&](int l) { return static_cast<double>(entry(edge, l)); });
    const Lane number = first + min(u, CurvePoint::last_u);
    for (int half = 0; half < 2; ++half)
      store_half(number, half, &closest(entry(two, half)).number);
  }
};

static_assert(sizeof(PackedCurvePoint) ==
              sizeof(double));  // four of a candidate have the layout of four doubles

}  // namespace pulvis
