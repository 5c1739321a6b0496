// The points of a pair of particles that may touch in this step, gathered from its rows: a few of each face as a rule.
// Eight of them are worked on at a time, whatever faces they are of, in the order of the faces that they stood against: these
// are the same for most of the eight then, and so are the numbers that projection needs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "components/space/contact.hpp"
#include "engine/lane_memory.hpp"
#include "systems/space/contact/vector.hpp"

namespace pulvis::space {

using VectorLanes = kernels::Vector<Lane>;

// A point as it is kept while its pair is worked on: two rows of eight numbers, which become lanes by transposing.
struct alignas(64) PairPoint {
  std::array<double, 8> motion;  // x y z, velocity, u v of the closest point so far
  std::array<double, 8>
      law;              // of contact_law.hpp: kappa, mu, damping, 1/size, weight; spring x y z
  std::int32_t face;    // of the other particle, which has the closest point
  std::int32_t row;     // of FaceContact
  std::int32_t number;  // of the row's points
};

// How a row keeps its closest points: face + u of all, then v.
struct PackedSpot {
  static constexpr double last = 1 - 1e-12;  // an end belongs to its own face
  static void unpack(const double* closest, int g, PairPoint& point) {
    const double number = closest[g];
    point.face = static_cast<std::int32_t>(number);
    point.motion[6] = number - point.face;
    point.motion[7] = closest[face_points + g];
  }
  static void pack(double* closest, int g, std::int32_t face, double u, double v) {
    closest[g] = face + std::min(u, last);
    closest[face_points + g] = v;
  }
};

// Eight of them; the last one stands in the lanes that are left over.
struct PointLanes {
  std::array<const PairPoint*, lane_count> point;
  unsigned real = 0;  // bit l: lane l is a point of its own

  VectorLanes x, velocity;
  Lane u, v;

  void set_motion() {
    std::array<const double*, lane_count> row;
    for (int l = 0; l < lane_count; ++l) entry(row, l) = entry(point, l)->motion.data();
    const auto c = columns_of(row);
    x = {c[0], c[1], c[2]};
    velocity = {c[3], c[4], c[5]};
    u = c[6];
    v = c[7];
  }
  std::array<Lane, 8> law() const {
    std::array<const double*, lane_count> row;
    for (int l = 0; l < lane_count; ++l) entry(row, l) = entry(point, l)->law.data();
    return columns_of(row);
  }
};

// As many points as are worked on at once: what touches of a pair fits in, of large faces in many turns.
class PairPoints {
 public:
  static constexpr int capacity = 96;

  bool is_full() const { return count_ + face_points > capacity; }
  PairPoint& add() { return entry(points_, count_++); }

  // visit(eight of them)
  template <class Visit>
  void for_eights(const Visit& visit) {
    for (int i = 0; i < count_; ++i) entry(order_, i) = {entry(points_, i).face, i};
    std::sort(order_.begin(), order_.begin() + count_);
    for (int first = 0; first < count_; first += lane_count) {
      PointLanes eight;
      for (int l = 0; l < lane_count; ++l)
        entry(eight.point, l) = &entry(points_, entry(order_, std::min(first + l, count_ - 1))[1]);
      eight.real = 0xffU >> std::max(first + lane_count - count_, 0);
      visit(eight);
    }
    count_ = 0;
  }

 private:
  std::array<PairPoint, capacity> points_;
  std::array<std::array<std::int32_t, 2>, capacity> order_;  // face, place
  int count_ = 0;
};

}  // namespace pulvis::space
