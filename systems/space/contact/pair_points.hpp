// The points of a pair of particles that may touch in this step, collected from its rows: usually a few per face.
// They are processed eight at a time, whatever faces they belong to, sorted by the face that they were closest to: most of
// the eight then share the same face, and so the data that projection needs.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "components/space/contact.hpp"
#include "engine/lane.hpp"
#include "systems/laws/normal_contact.hpp"

namespace pulvis::space {

// A point while its pair is processed: rows of eight numbers, which become lanes by transposing.
struct alignas(64) PairPoint {
  std::array<double, 8> motion;  // position, velocity, weight, 1/size of the face
  std::array<double, 8> state;
  enum State {
    kappa,  // as in contact_law.hpp
    damping,
    travel,    // m, RowTravel
    pressure,  // Hardness of the sampled face, where surfaces indent
    left,
    indented,  // m
    spring_z   // m, with the others in `kept`
  };
  double* indentation;  // in the column: PointIndentation, or null
  double* kept;         // ContactPoint numbers in the columns
  float* activation;    // in the column: when it becomes active again
  double* lost;         // in the column: SlipWeakening, or null
  double* force;        // in the column: ContactPointForce, or null
  std::int32_t row;     // of FaceContact
  std::int16_t place;   // Gauss point of that row
  bool touches;         // valid once processed: `motion` then starts with the force
};

// Eight points, all bonded or none; unused lanes repeat the last one.
struct PointLanes {
  std::array<PairPoint*, lane_count> point;
  std::array<std::int32_t, lane_count> face;  // of the other particle, with the closest point
  unsigned real = 0;                          // bit l: lane l holds a point that is not a repeat
  bool bonded = false;
};

// A buffer of points processed together: the touching points of a pair usually fit; large faces take several batches.
class PairPoints {
 public:
  static constexpr int capacity = 96;

  bool is_full() const { return count_ + face_points > capacity; }
  PairPoint& add(int face, bool bonded) {
    if (bonded) bonded_ += 1;
    entry(order_, count_) = (bonded ? bonded_last : 0) | std::int64_t{face} << 32 | count_;
    return entry(points_, count_++);
  }

  // visit(eight points)
  template <class Visit>
  void for_eights(const Visit& visit) {
    std::sort(order_.begin(), order_.begin() + count_);
    eights_between(0, count_ - bonded_, false, visit);
    if (bonded_ > 0) eights_between(count_ - bonded_, count_, true, visit);
  }
  // visit(each point), in the order in which they were added; then clears the buffer.
  template <class Visit>
  void take_out(const Visit& visit) {
    for (int i = 0; i < count_; ++i) visit(entry(points_, i));
    count_ = bonded_ = 0;
  }

 private:
  static constexpr std::int64_t bonded_last = std::int64_t{1} << 62;

  template <class Visit>
  void eights_between(int begin, int end, bool bonded, const Visit& visit) {
    for (int first = begin; first < end; first += lane_count) {
      PointLanes eight;
      eight.bonded = bonded;
      for (int l = 0; l < lane_count; ++l) {
        const std::int64_t at = entry(order_, std::min(first + l, end - 1));
        entry(eight.point, l) = &entry(points_, static_cast<std::int32_t>(at & 0xffffffff));
        entry(eight.face, l) = static_cast<std::int32_t>((at & ~bonded_last) >> 32);
      }
      eight.real = 0xffU >> std::max(first + lane_count - end, 0);
      visit(eight);
    }
  }

  std::array<PairPoint, capacity> points_;
  std::array<std::int64_t, capacity> order_;  // bonded or not, face, then index in points
  int count_ = 0, bonded_ = 0;
};

}  // namespace pulvis::space
