// Slopes of a lever's side, from the deflections of its nodes.
//
// Source   patch recovery after Zienkiewicz & Zhu (1992): a quadratic is fitted to the nodes of the elements around each
//          node, its slope there is that of the node; between nodes slopes are interpolated as deflections are
// Validity exact where the deflection is quadratic, otherwise the error falls with the square of the element size; the
//          slope is continuous over the side. The slope of an element's own interpolation is neither.
#pragma once

#include <optional>

#include "scenes/lever/mesh/lever_mesh.hpp"

namespace pulvis {

class SurfaceSlope {
 public:
  explicit SurfaceSlope(const LeverLevel& level);

  struct Gauges {
    Gauge along, across;  // 1/m
  };
  // Empty outside the side.
  std::optional<Gauges> at(const Vec2& point) const;

 private:
  // Weights of the patch's points for the two slopes at one of them.
  struct Patch {
    std::vector<int> points;
    Eigen::Matrix2Xd weights;  // 1/m
  };
  Patch patch_of(int point) const;
  std::vector<int> grown(const std::vector<int>& points) const;

  const LeverLevel& level_;
  std::vector<std::vector<int>> elements_;     // points of each element
  std::vector<std::vector<int>> elements_of_;  // [points] elements around each
};

}  // namespace pulvis
