#include "scenes/tools/surfaces/flat_triangles.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <queue>
#include <utility>

namespace pulvis::space {
namespace {

using Corners = std::array<Vec3, 3>;

// Of the largest coordinate: corners closer to a line are in line but for rounding, for instance by the unit of the file.
constexpr double rounding = 1e-13;

using Corner3 = std::array<double, 3>;
Corner3 key_of(const Vec3& p) { return {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0}; }  // -0 is 0

bool has_equal_corners(const Corners& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

double length_of_side(const Corners& t, std::size_t k) { return (t[(k + 1) % 3] - t[k]).norm(); }

// From the corner with this number to the next.
std::size_t longest_side(const Corners& t) {
  std::size_t longest = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (length_of_side(t, k) > length_of_side(t, longest)) longest = k;
  return longest;
}

// A corner that coincides with another but for rounding is not between the two others.
bool is_flat(const Corners& t) {
  double size = 0;
  for (const Vec3& p : t) size = std::max(size, p.cwiseAbs().maxCoeff());
  const double least = rounding * size;
  for (std::size_t k = 0; k < 3; ++k)
    if (!(length_of_side(t, k) > least)) return false;
  return (t[1] - t[0]).cross(t[2] - t[0]).norm() <= least * length_of_side(t, longest_side(t));
}

// Replaces the longest side of each flat triangle by the line from its middle corner to the opposite corner of the
// neighbour, the longest first: the neighbour of that one is not flat, or has the same longest side, and the new line is
// shorter.
class Flips {
 public:
  explicit Flips(std::vector<Corners>& triangles) : triangles_(triangles) {
    for (std::size_t t = 0; t < triangles.size(); ++t) look_at(t);
    if (flat_.empty()) return;
    for (std::size_t t = 0; t < triangles.size(); ++t) enter(t);
    // Each flip ends a flat triangle, unless several with the same line are neighbours.
    for (std::size_t left = 100 + 10 * flat_.size(); left > 0 && !flat_.empty(); --left) {
      const std::size_t t = flat_.top().second;
      flat_.pop();
      if (is_flat(triangles[t])) flip(t);
    }
  }

 private:
  using Side = std::pair<Corner3, Corner3>;
  static Side side(const Corners& t, std::size_t k) {
    return {key_of(t[k]), key_of(t[(k + 1) % 3])};
  }
  void look_at(std::size_t t) {
    const Corners& triangle = triangles_[t];
    if (is_flat(triangle)) flat_.emplace(length_of_side(triangle, longest_side(triangle)), t);
  }
  void enter(std::size_t t) {
    if (has_equal_corners(triangles_[t])) return;
    for (std::size_t k = 0; k < 3; ++k) owner_.emplace(side(triangles_[t], k), t);
  }
  void take_out(std::size_t t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [first, last] = owner_.equal_range(side(triangles_[t], k));
      const auto own = std::find_if(first, last, [&](const auto& of) { return of.second == t; });
      if (own != last) owner_.erase(own);
    }
  }
  void flip(std::size_t t) {
    const Corners flat = triangles_[t];
    const std::size_t k = longest_side(flat);
    const Vec3 &from = flat[k], &to = flat[(k + 1) % 3], &middle = flat[(k + 2) % 3];
    const auto found = owner_.find({key_of(to), key_of(from)});
    if (found == owner_.end()) return;
    const std::size_t n = found->second;
    const Corners neighbour = triangles_[n];
    std::size_t opposite = 0;
    while (neighbour[opposite] == from || neighbour[opposite] == to) ++opposite;
    take_out(t);
    take_out(n);
    triangles_[t] = {to, middle, neighbour[opposite]};
    triangles_[n] = {middle, from, neighbour[opposite]};
    for (const std::size_t changed : {t, n}) {
      enter(changed);
      look_at(changed);
    }
  }

  std::vector<Corners>& triangles_;
  std::multimap<Side, std::size_t> owner_;
  std::priority_queue<std::pair<double, std::size_t>> flat_;  // longest side, triangle
};

}  // namespace

std::vector<Corners> without_flat_triangles(std::vector<Corners> triangles) {
  std::erase_if(triangles, has_equal_corners);
  Flips{triangles};
  std::erase_if(triangles, has_equal_corners);
  return triangles;
}

}  // namespace pulvis::space
