// Contact point of two convex particles, or their distance.
//
// Minkowski portal refinement (Snethen, XenoCollide, in: Game Programming Gems 7, 2008): two bodies A and B overlap if the
// vector d between their centres lies in C = A - B. The face of C through which the ray along d leaves is approached by
// triangles of points of C; its normal n is the contact normal. Any n gives
//
//   gap(n) = n.d - h_C(n) <= distance of A and B, h_C(n) = h_A(n) + h_B(-n), h: support function,
//
// so that a gap above 0 proves that there is no overlap; the minimum overlap is at most -gap(n).
#pragma once

#include <array>
#include <optional>

#include "scenes/packing/solids/rigid_shape.hpp"

namespace pulvis::space {

struct RigidPose {
  V3 at;  // centre of volume
  Turn turn;
};

struct RigidTouch {
  V3 point;        // between the two
  V3 normal;       // from the first to the second, unit vector
  double gap = 0;  // lower bound, negative if they overlap
};

class RigidPair {
 public:
  RigidPair(const RigidShape& a, const RigidPose& at_a, const RigidShape& b, const RigidPose& at_b)
      : a_(a),
        b_(b),
        turn_a_(at_a.turn),
        turn_b_(at_b.turn),
        from_(at_a.at),
        apart_(at_b.at - at_a.at) {}

  // The contact, if its gap is less than `range`. `normal`: initial guess; on return that of the last gap. `flat`: how
  // much farther C may extend beyond the triangle that is accepted as its face.
  std::optional<RigidTouch> touch(double range, V3& normal, double flat = 5e-5) const;
  double gap_along(const V3& normal) const;
  // The largest gap along any normal near this one: their distance, or minus the minimum separating translation.
  double distance(V3 normal) const;

 private:
  struct Vertex {
    V3 at;    // of C
    V3 of_a;  // relative to A's centre
  };
  using Portal =
      std::array<Vertex,
                 3>;  // the ray crosses it before leaving C; counter-clockwise as seen from outside

  Vertex support(const V3& n) const;
  std::optional<RigidTouch> touch_of_balls(double range) const;
  bool open_portal(const V3& along,
                   Portal& portal) const;  // false if the first point is on the ray
  RigidTouch touch_at(const V3& along, const V3& normal, double gap, const Portal& portal) const;

  const RigidShape &a_, &b_;
  const Turn &turn_a_, &turn_b_;
  V3 from_, apart_;
};

}  // namespace pulvis::space
