#include "cli/preview/rims.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace pulvis {
namespace {

double turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Andrew (1979), monotone chain: points sorted by x, then y.
template <class Iterator>
std::vector<PlanePoint> half_hull(Iterator begin, Iterator end) {
  std::vector<PlanePoint> chain;
  for (auto at = begin; at != end; ++at) {
    while (chain.size() > 1 && turn(chain[chain.size() - 2], chain.back(), *at) <= 0)
      chain.pop_back();
    chain.push_back(*at);
  }
  chain.pop_back();  // it starts the other half
  return chain;
}

}  // namespace

std::vector<Loop> rims_of(const std::vector<Face>& faces) {
  std::set<std::pair<std::size_t, std::size_t>> open;
  for (const Face& face : faces)
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::size_t from = face[k], to = face[(k + 1) % face.size()];
      if (open.erase({to, from}) == 0) open.insert({from, to});
    }
  std::vector<Loop> loops;
  while (!open.empty()) {
    Loop loop;
    for (auto at = open.begin(); at != open.end();) {
      const auto [from, to] = *at;
      loop.push_back(from);
      open.erase(at);
      at = open.lower_bound({to, 0});
      if (at != open.end() && at->first != to) at = open.end();
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<PlanePoint> convex_hull(std::vector<PlanePoint> points) {
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<PlanePoint> hull = half_hull(points.begin(), points.end());
  const std::vector<PlanePoint> upper = half_hull(points.rbegin(), points.rend());
  hull.insert(hull.end(), upper.begin(), upper.end());
  return hull;
}

}  // namespace pulvis
