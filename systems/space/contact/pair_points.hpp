// The points of a pair of particles that may touch in this step, gathered from its rows: a few of each face as a rule.
// Eight of them are worked on at a time, whatever faces they are of, in the order of the faces that they stood against: these
// are the same for most of the eight then, and so are the numbers that projection needs.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "components/space/contact.hpp"
#include "engine/lane.hpp"

namespace pulvis::space {

// A point while its pair is worked on: rows of eight numbers, which become lanes by transposing.
struct alignas(64) PairPoint {
  std::array<double, 8> motion;  // position, velocity, weight, 1/size of the face
  double kappa, damping;         // of contact_law.hpp
  double* kept;                  // in the columns: ContactPoint's numbers
  float* activation;             // there: when it is active again
  double* lost;                  // there: SlipWeakening, or null
  double* force;                 // there: ContactPointForce, or null
  std::int32_t row;              // of FaceContact
  bool touches;                  // once it was worked on: `motion` begins with the force then
};

// Eight of them; the last one stands in the lanes that are left over.
struct PointLanes {
  std::array<PairPoint*, lane_count> point;
  std::array<std::int32_t, lane_count> face;  // of the other particle, which has the closest point
  unsigned real = 0;                          // bit l: lane l is a point of its own
};

// As many points as are worked on at once: what touches of a pair fits in, of large faces in many turns.
class PairPoints {
 public:
  static constexpr int capacity = 96;

  bool is_full() const { return count_ + face_points > capacity; }
  PairPoint& add(int face) {
    entry(order_, count_) = std::int64_t{face} << 32 | count_;
    return entry(points_, count_++);
  }

  // visit(eight of them)
  template <class Visit>
  void for_eights(const Visit& visit) {
    std::sort(order_.begin(), order_.begin() + count_);
    for (int first = 0; first < count_; first += lane_count) {
      PointLanes eight;
      for (int l = 0; l < lane_count; ++l) {
        const std::int64_t at = entry(order_, std::min(first + l, count_ - 1));
        entry(eight.point, l) = &entry(points_, static_cast<std::int32_t>(at & 0xffffffff));
        entry(eight.face, l) = static_cast<std::int32_t>(at >> 32);
      }
      eight.real = 0xffU >> std::max(first + lane_count - count_, 0);
      visit(eight);
    }
  }
  // visit(each of them), in the order in which they were added; then there are none.
  template <class Visit>
  void take_out(const Visit& visit) {
    for (int i = 0; i < count_; ++i) visit(entry(points_, i));
    count_ = 0;
  }

 private:
  std::array<PairPoint, capacity> points_;
  std::array<std::int64_t, capacity> order_;  // face, then place in points
  int count_ = 0;
};

}  // namespace pulvis::space
