// Ears are cut off the polygon, best-shaped first; then cuts not needed by a reflex corner go.
#include <algorithm>

#include "scenes/packing/outlines/convex_pieces.hpp"

namespace pulvis {
namespace {

using portable::V2;
using Corners = std::vector<int>;  // indices in the polygon

class Cutter {
 public:
  explicit Cutter(const std::vector<V2>& polygon) : polygon_(polygon) {}

  std::vector<Corners> triangles() const {
    Corners left;
    for (int i = 0; i < static_cast<int>(polygon_.size()); ++i) left.push_back(i);
    std::vector<Corners> result;
    while (left.size() > 3) {
      const std::size_t ear = best_ear(left);
      result.push_back({before(left, ear), left[ear], after(left, ear)});
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    result.push_back(left);
    return result;
  }

  // Piece b merged with piece a along a common side, or empty if the result is not convex.
  Corners joined(const Corners& a, const Corners& b) const {
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t k = 0; k < b.size(); ++k) {
        if (a[i] != after(b, k) || after(a, i) != b[k]) continue;
        Corners both;
        for (std::size_t n = 1; n <= a.size(); ++n) both.push_back(a[(i + n) % a.size()]);
        for (std::size_t n = 2; n < b.size(); ++n) both.push_back(b[(k + n) % b.size()]);
        return convex(both) ? both : Corners{};
      }
    return {};
  }

  bool convex(const Corners& piece) const {
    for (std::size_t i = 0; i < piece.size(); ++i)
      if (turn(before(piece, i), piece[i], after(piece, i)) < 0) return false;
    return true;
  }

 private:
  static int before(const Corners& c, std::size_t i) { return c[(i + c.size() - 1) % c.size()]; }
  static int after(const Corners& c, std::size_t i) { return c[(i + 1) % c.size()]; }
  V2 at(int i) const { return polygon_[static_cast<std::size_t>(i)]; }
  double turn(int a, int b, int c) const { return portable::cross(at(b) - at(a), at(c) - at(b)); }

  bool holds_another(const Corners& left, int a, int b, int c) const {
    return std::ranges::any_of(left, [&](int p) {
      return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 &&
             turn(c, a, p) >= 0;
    });
  }

  // Area over the square of the longest side; negative if the corner is not an ear.
  double quality(const Corners& left, std::size_t i) const {
    const int a = before(left, i), b = left[i], c = after(left, i);
    const double area = turn(a, b, c);
    if (area <= 0 || holds_another(left, a, b, c)) return -1;
    const double longest = std::max({portable::dot(at(b) - at(a), at(b) - at(a)),
                                     portable::dot(at(c) - at(b), at(c) - at(b)),
                                     portable::dot(at(a) - at(c), at(a) - at(c))});
    return area / longest;
  }

  std::size_t best_ear(const Corners& left) const {
    std::size_t best = 0;
    double maximum = -2;
    for (std::size_t i = 0; i < left.size(); ++i)
      if (const double q = quality(left, i); q > maximum) {
        maximum = q;
        best = i;
      }
    return best;
  }

  const std::vector<V2>& polygon_;
};

bool join_two(const Cutter& cutter, std::vector<Corners>& pieces) {
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (std::size_t k = i + 1; k < pieces.size(); ++k)
      if (Corners both = cutter.joined(pieces[i], pieces[k]); !both.empty()) {
        pieces[i] = std::move(both);
        pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(k));
        return true;
      }
  return false;
}

}  // namespace

std::vector<std::vector<V2>> convex_pieces(const std::vector<V2>& polygon) {
  const Cutter cutter(polygon);
  Corners all;
  for (int i = 0; i < static_cast<int>(polygon.size()); ++i) all.push_back(i);
  std::vector<Corners> pieces{all};
  if (!cutter.convex(all)) {
    pieces = cutter.triangles();
    while (join_two(cutter, pieces)) {
    }
  }
  std::vector<std::vector<V2>> result;
  for (const Corners& piece : pieces) {
    result.emplace_back();
    for (const int i : piece) result.back().push_back(polygon[static_cast<std::size_t>(i)]);
  }
  return result;
}

}  // namespace pulvis
