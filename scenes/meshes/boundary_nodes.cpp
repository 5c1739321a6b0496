#include "scenes/meshes/boundary_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pulvis {
namespace {

constexpr double max_turn = std::numbers::pi / 8;  // of an edge
// Growth of edge lengths along the outline: 1.35 between neighbours; where there are too few edges, up
// to 2.2, as on a rounded rectangle.
constexpr double usual_growth = 0.3, max_growth = 0.75;
constexpr double unlimited = std::numeric_limits<double>::max();

int up_to_multiple_of_4(double edges) {
  constexpr double maximum = 1e6;  // beyond any mesh; rejected later
  return 4 * static_cast<int>(std::ceil(std::min(edges, maximum) / 4 - 1e-6));
}

int fewest_of(double edges) { return std::max(8, up_to_multiple_of_4(edges)); }

// Requested edge lengths at the samples of a smooth closed curve.
class EdgeLengths {
 public:
  explicit EdgeLengths(const OutlineCurve& curve) : samples_(curve.samples()) {
    turned_.push_back(0);
    for (const auto& sample : samples_) turned_.push_back(turned_.back() + std::abs(sample.turn));
    turned_.pop_back();
    for (std::size_t k = 0; k < samples_.size(); ++k) by_turn_.push_back(longest(samples_[k].s));
  }

  // Number of edges up to each sample, when none is longer than `size` and they grow by `growth`.
  std::vector<double> count(double size, double growth) const {
    std::vector<double> length = by_turn_;
    for (double& h : length) h = std::min(h, size);
    limit(length, growth);
    std::vector<double> edges{0};
    for (std::size_t k = 0; k + 1 < length.size(); ++k)
      edges.push_back(edges.back() + 2 * step(k) / (length[k] + length[k + 1]));
    return edges;
  }

 private:
  double step(std::size_t k) const { return samples_[k + 1].s - samples_[k].s; }

  // The sample before s, or the last but one; looked for only where it is not `near`.
  std::size_t before(double s, std::size_t near) const {
    const std::size_t last = samples_.size() - 2;
    if ((near == 0 || samples_[near].s <= s) && (near == last || s < samples_[near + 1].s))
      return near;
    const auto after = std::upper_bound(
        samples_.begin() + 1, samples_.end() - 1, s,
        [](double value, const OutlineCurve::Sample& sample) { return value < sample.s; });
    return static_cast<std::size_t>(after - samples_.begin()) - 1;
  }

  // Absolute turning angle from the start to s, which may lie up to a lap outside the range. `k`: a guess at the sample
  // before s; becomes that sample.
  double turned(double s, std::size_t& k) const {
    const double length = samples_.back().s, laps = std::floor(s / length);
    s -= laps * length;
    k = before(s, k);
    const double share = (s - samples_[k].s) / step(k);
    return laps * turned_.back() + turned_[k] + share * (turned_[k + 1] - turned_[k]);
  }

  // The longest edge around s that does not turn too much: averaged over a length, since the curvature may
  // have peaks that no edge resolves.
  double longest(double s) const {
    double low = 0, high = samples_.back().s;
    std::size_t ahead = 0, behind = 0;
    for (int i = 0; i < 40; ++i) {
      const double h = 0.5 * (low + high);
      const double turn = turned(s + 0.5 * h, ahead) - turned(s - 0.5 * h, behind);
      (turn <= max_turn ? low : high) = h;
    }
    return low;
  }

  // Two laps, forwards and backwards; first and last are the same point.
  void limit(std::vector<double>& length, double growth) const {
    const std::size_t n = length.size() - 1;
    for (int lap = 0; lap < 2; ++lap) {
      for (std::size_t k = 0; k < n; ++k)
        length[k + 1] = std::min(length[k + 1], length[k] + growth * step(k));
      length[0] = length[n] = std::min(length[0], length[n]);
    }
    for (int lap = 0; lap < 2; ++lap) {
      for (std::size_t k = n; k-- > 0;)
        length[k] = std::min(length[k], length[k + 1] + growth * step(k));
      length[0] = length[n] = std::min(length[0], length[n]);
    }
  }

  const std::vector<OutlineCurve::Sample>& samples_;
  std::vector<double> turned_, by_turn_;
};

// The counts that total `edges`: by edge size, or by growth where even the largest size gives too many.
std::vector<double> counts_for(const EdgeLengths& lengths, double perimeter, int edges) {
  const bool by_size = lengths.count(unlimited, usual_growth).back() <= edges;
  double fine = by_size ? perimeter / edges : usual_growth;
  double coarse = by_size ? perimeter : max_growth;
  const auto count = [&](double value) {
    return by_size ? lengths.count(value, usual_growth) : lengths.count(unlimited, value);
  };
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (fine + coarse);
    (count(middle).back() > edges ? fine : coarse) = middle;
  }
  return count(coarse);
}

// Positions where the counts reach equal shares of their sum.
std::vector<double> places(const OutlineCurve& curve, const std::vector<double>& counts,
                           int edges) {
  const auto& samples = curve.samples();
  std::vector<double> at;
  std::size_t k = 0;
  for (int i = 0; i < edges; ++i) {
    const double wanted = counts.back() * i / edges;
    while (counts[k + 1] <= wanted) ++k;
    const double share = (wanted - counts[k]) / (counts[k + 1] - counts[k]);
    at.push_back(samples[k].s + share * (samples[k + 1].s - samples[k].s));
  }
  return at;
}

std::vector<double> side_lengths(const OutlineCurve& curve) {
  std::vector<double> begin;
  for (const auto& sample : curve.samples())
    if (sample.t == 0) begin.push_back(sample.s);
  begin.push_back(curve.length());
  for (std::size_t i = 0; i + 1 < begin.size(); ++i) begin[i] = begin[i + 1] - begin[i];
  begin.pop_back();
  return begin;
}

// Each edge goes to the side whose edges are longest.
std::vector<int> edges_of_sides(const std::vector<double>& sides, int edges) {
  std::vector<int> share(sides.size(), 1);
  for (int left = edges - static_cast<int>(sides.size()); left > 0; --left) {
    std::size_t longest = 0;
    for (std::size_t i = 1; i < sides.size(); ++i)
      // Round-off must not decide between equal sides.
      if (sides[i] / share[i] > sides[longest] / share[longest] * (1 + 1e-9)) longest = i;
    ++share[longest];
  }
  return share;
}

std::vector<double> sharp_places(const OutlineCurve& curve, int edges, std::vector<int>& corners) {
  const std::vector<double> sides = side_lengths(curve);
  const std::vector<int> share = edges_of_sides(sides, edges);
  std::vector<double> at;
  double begin = 0;
  for (std::size_t side = 0; side < sides.size(); ++side) {
    corners.push_back(static_cast<int>(at.size()));
    for (int i = 0; i < share[side]; ++i) at.push_back(begin + sides[side] * i / share[side]);
    begin += sides[side];
  }
  return at;
}

}  // namespace

BoundaryNodes boundary_nodes(const OutlineCurve& curve, int edges) {
  BoundaryNodes nodes;
  const std::vector<double> at =
      curve.sharp() ? sharp_places(curve, edges, nodes.corners)
                    : places(curve, counts_for(EdgeLengths(curve), curve.length(), edges), edges);
  std::vector<OutlineCurve::Place> on_curve;
  for (const double s : at) on_curve.push_back(curve.at(s));
  for (std::size_t i = 0; i < on_curve.size(); ++i) {
    const bool last = i + 1 == on_curve.size();
    const auto &here = on_curve[i], &next = on_curve[last ? 0 : i + 1];
    const double swept = (last ? curve.area() : 0) + next.swept - here.swept;
    nodes.points.push_back({{here.at.x(), here.at.y()},
                            {here.normal.x(), here.normal.y()},
                            curve.sharp() ? 0 : swept - 0.5 * cross(here.at, next.at)});
  }
  return nodes;
}

int fewest_edges(const OutlineCurve& curve) {
  if (curve.sharp()) return fewest_of(static_cast<double>(side_lengths(curve).size()));
  return fewest_of(EdgeLengths(curve).count(unlimited, max_growth).back());
}

int edges_of_size(const OutlineCurve& curve, double size) {
  if (curve.sharp()) {
    const std::vector<double> sides = side_lengths(curve);
    double edges = 0;
    for (const double side : sides) edges += std::max(1.0, std::round(side / size));
    return std::max(up_to_multiple_of_4(edges), fewest_of(static_cast<double>(sides.size())));
  }
  const EdgeLengths lengths(curve);
  return std::max(up_to_multiple_of_4(lengths.count(size, usual_growth).back()),
                  fewest_of(lengths.count(unlimited, max_growth).back()));
}

}  // namespace pulvis
