// Contact points, or closest points, of two rigid particles.
#pragma once

#include "scenes/packing/outlines/rigid_shape.hpp"

namespace pulvis {

struct RigidPose {
  portable::V2 at;  // centroid
  portable::Turn turn;
};

struct RigidTouch {
  portable::V2 point;
  portable::V2 normal;  // from the first particle to the second
  double gap;           // negative where they overlap
};

// The contacts of two particles whose gap is below `range`: two where straight sides face each other,
// otherwise one, for each pair of pieces. Their smallest gap is the particles' distance; where pieces
// overlap, minus the minimum translation that separates them (separating axes, Gottschalk 1996).
class RigidContacts {
 public:
  const std::vector<RigidTouch>& between(const RigidShape& a, const RigidPose& at_a,
                                         const RigidShape& b, const RigidPose& at_b, double range);

 private:
  void pieces(const RigidPiece& a, const RigidPiece& b, double range);
  void sides(const RigidPiece& leader, const RigidPiece& other, std::size_t side,
             std::size_t corner, double range);
  void nearest(const RigidPiece& a, const RigidPiece& b, portable::V2 out, double range);
  void add(portable::V2 point, portable::V2 normal, double gap);

  RigidPiece other_;  // the second particle's piece in the first one's frame
  double normals_sign_ = 1;
  std::vector<RigidTouch> found_;
};

}  // namespace pulvis
