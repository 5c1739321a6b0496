// Numbering order of the particles: that of the tables that place them, in two and three dimensions.
#pragma once

#include <algorithm>
#include <vector>

#include "scenes/language/source_mark.hpp"

namespace pulvis {

template <class Body, class Packing>
struct Placing {  // one [[body]] or [[packing]]; the other is null
  SourceMark mark;
  const Body* body;
  const Packing* packing;
};

template <class Body, class Packing>
std::vector<Placing<Body, Packing>> in_file_order(const std::vector<Body>& bodies,
                                                  const std::vector<Packing>& packings) {
  std::vector<Placing<Body, Packing>> placings;
  for (const Body& body : bodies) placings.push_back({body.mark, &body, nullptr});
  for (const Packing& packing : packings) placings.push_back({packing.mark, nullptr, &packing});
  std::ranges::stable_sort(placings, written_before, &Placing<Body, Packing>::mark);
  return placings;
}

}  // namespace pulvis
