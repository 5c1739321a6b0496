#include "scenes/outlines/outline_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/portable_math.hpp"

namespace pulvis {
namespace {

// Gauss-Legendre on [0, 1].
constexpr std::array<double, 4> gauss_at{0.06943184420297371, 0.33000947820757187,
                                         0.66999052179242813, 0.93056815579702629};
constexpr std::array<double, 4> gauss_weight{0.17392742256872693, 0.32607257743127307,
                                             0.32607257743127307, 0.17392742256872693};

// Enough for arc lengths of smooth pieces to round-off, and for the corners of a superellipse.
constexpr std::size_t samples_wanted = 2048, fewest_a_piece = 8;

// Angle between tangents, for less than half a turn.
double turn_between(const Vec2& a, const Vec2& b) { return portable::atan2(cross(a, b), a.dot(b)); }

}  // namespace

// A piece may be slow to evaluate, as an arc of another curve is: evaluated once, for both tables.
struct OutlineCurve::Taken {
  Vec2 slope, next_slope;                      // where a sample begins and ends
  std::array<Point, gauss_at.size()> between;  // at the Gauss points
};

OutlineCurve::OutlineCurve(std::vector<Piece> pieces, bool sharp, double scale)
    : pieces_(std::move(pieces)), sharp_(sharp) {
  const std::vector<Taken> taken = take();
  tabulate(taken);
  origin_ = centroid(taken);
  scale_ = scale;
  tabulate(taken);
}

OutlineCurve::Point OutlineCurve::placed(const Point& p) const {
  return {scale_ * (p.at - origin_), scale_ * p.slope};
}

OutlineCurve::Point OutlineCurve::point(std::size_t piece, double t) const {
  return placed(pieces_[piece](t));
}

std::size_t OutlineCurve::samples_of_a_piece() const {
  return std::max(samples_wanted / pieces_.size(), fewest_a_piece);
}

std::vector<OutlineCurve::Taken> OutlineCurve::take() const {
  const std::size_t each = samples_of_a_piece();
  std::vector<Taken> all;
  all.reserve(each * pieces_.size());
  for (const Piece& piece : pieces_) {
    Vec2 slope = piece(0).slope;
    for (std::size_t k = 0; k < each; ++k) {
      const double t = static_cast<double>(k) / static_cast<double>(each);
      const double next = static_cast<double>(k + 1) / static_cast<double>(each);
      Taken& one = all.emplace_back();
      one.slope = slope;
      one.next_slope = slope = piece(next).slope;
      for (std::size_t g = 0; g < gauss_at.size(); ++g)
        one.between[g] = piece(t + gauss_at[g] * (next - t));
    }
  }
  return all;
}

void OutlineCurve::tabulate(const std::vector<Taken>& taken) {
  const std::size_t each = samples_of_a_piece();
  samples_.clear();
  double s = 0, swept = 0;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    const Taken& one = taken[i];
    const double t = static_cast<double>(i % each) / static_cast<double>(each);
    const double next = static_cast<double>(i % each + 1) / static_cast<double>(each);
    const double turn = turn_between(scale_ * one.slope, scale_ * one.next_slope);
    samples_.push_back({s, swept, turn, i / each, t, next});
    for (std::size_t g = 0; g < gauss_at.size(); ++g) {
      const Point p = placed(one.between[g]);
      s += gauss_weight[g] * (next - t) * p.slope.norm();
      swept += 0.5 * gauss_weight[g] * (next - t) * cross(p.at, p.slope);
    }
  }
  samples_.push_back({s, swept, 0, pieces_.size() - 1, 1, 1});
}

// Green's theorem: the area's first moment is a third of the boundary integral of x (x cross dx).
Vec2 OutlineCurve::centroid(const std::vector<Taken>& taken) const {
  Vec2 moment = Vec2::Zero();
  for (std::size_t i = 0; i < taken.size(); ++i)
    for (std::size_t g = 0; g < gauss_at.size(); ++g) {
      const double width = samples_[i].next_t - samples_[i].t;
      const Point p = placed(taken[i].between[g]);
      moment += gauss_weight[g] * width / 3 * cross(p.at, p.slope) * p.at;
    }
  return moment / area();
}

Vec2 OutlineCurve::extent() const {
  Vec2 low = point(0, 0).at, high = low;
  for (const Sample& sample : samples_) {
    const Vec2 at = point(sample.piece, sample.t).at;
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  return high - low;
}

OutlineCurve::Place OutlineCurve::at(double s) const {
  const auto after =
      std::upper_bound(samples_.begin() + 1, samples_.end() - 1, s,
                       [](double value, const Sample& sample) { return value < sample.s; });
  const Sample& from = *(after - 1);
  double share = std::clamp((s - from.s) / (after->s - from.s), 0.0, 1.0);
  const double width = from.next_t - from.t;
  double swept = 0;
  Point p;
  for (int iteration = 0; iteration < 3; ++iteration) {  // Newton on the arc length
    double length = from.s;
    swept = from.swept;
    for (std::size_t g = 0; g < gauss_at.size(); ++g) {
      const Point q = point(from.piece, from.t + gauss_at[g] * share * width);
      length += gauss_weight[g] * share * width * q.slope.norm();
      swept += 0.5 * gauss_weight[g] * share * width * cross(q.at, q.slope);
    }
    p = point(from.piece, from.t + share * width);
    if (iteration < 2)
      share = std::clamp(share + (s - length) / (width * p.slope.norm()), 0.0, 1.0);
  }
  return {p.at, Vec2(p.slope.y(), -p.slope.x()).normalized(), swept};
}

std::vector<Vec2> OutlineCurve::polygon(double deviation) const {
  // Where a chord between two samples sees no inflection, the curve is farthest from it near the middle;
  // five points find that distance to within a few percent.
  const auto leaves = [&](std::size_t piece, double from, double to) {
    const Vec2 a = point(piece, from).at, b = point(piece, to).at;
    const Vec2 along = (b - a).normalized();
    double maximum = 0;
    for (const double share : {0.25, 0.4, 0.5, 0.6, 0.75})
      maximum = std::max(maximum,
                         std::abs(cross(along, point(piece, from + share * (to - from)).at - a)));
    return maximum > 0.95 * deviation;
  };
  std::vector<Vec2> points;
  const std::function<void(std::size_t, double, double, int)> divide =
      [&](std::size_t piece, double from, double to, int depth) {
        if (depth < 24 && leaves(piece, from, to)) {
          divide(piece, from, 0.5 * (from + to), depth + 1);
          divide(piece, 0.5 * (from + to), to, depth + 1);
        } else {
          points.push_back(point(piece, from).at);
        }
      };
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) divide(piece, 0, 1, 0);
  return points;
}

}  // namespace pulvis
