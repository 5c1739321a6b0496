// Axis-aligned boxes of contact surfaces.
#pragma once

#include <algorithm>

#include "components/space/contact.hpp"
#include "systems/contact/box.hpp"

namespace pulvis::space {

using Box = BoxOf<ThreeD>;

// Of the Bezier points of a face, whose hull contains the face (convex hull property).
inline Box face_box(const PatchNumbers& face) {
  Box box{};
  for (int k = 0; k < 3; ++k) {
    double &low = entry(box.low, k), &high = entry(box.high, k);
    low = high = face(k, 0);
    for (int p = 1; p < patch_points; ++p) {
      low = std::min(low, face(k, p));
      high = std::max(high, face(k, p));
    }
  }
  return box;
}

}  // namespace pulvis::space
