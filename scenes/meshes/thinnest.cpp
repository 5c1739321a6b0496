#include "scenes/meshes/thinnest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pulvis {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();
constexpr int max_samples = 20000;  // of a chain
constexpr std::size_t block = 16;   // segments that share a box

// A convex quad lies between two lines whose distance is at least its area over its diameter.
double width_of(const std::array<Vec2, 4>& corner) {
  const Vec2 p = corner[2] - corner[0], q = corner[3] - corner[1];
  double longest = std::max(p.norm(), q.norm());
  for (std::size_t k = 0; k < 4; ++k)
    longest = std::max(longest, (corner[(k + 1) % 4] - corner[k]).norm());
  return 0.5 * std::abs(p.x() * q.y() - p.y() * q.x()) / longest;
}

struct Segment {
  Vec2 begin, direction, normal;  // out of the tool
  double at, length;              // m: from the start of the chain
};

// A starting point of the search for the other flank.
struct Sample {
  Vec2 point, normal;
  double at;
};

class Chain {
 public:
  Chain(const std::vector<Vec2>& points, double resolution) : resolution_(resolution) {
    double at = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const Vec2 d = points[i + 1] - points[i];
      const double length = d.norm();
      if (length == 0) continue;
      const Vec2 direction = d / length;
      segments_.push_back({points[i], direction, {-direction.y(), direction.x()}, at, length});
      at += length;
    }
    length_ = at;
    make_boxes();
  }

  double thinnest(double maximum) const {
    double minimum = maximum;
    const double apart = std::max(0.5 * resolution_, length_ / max_samples);
    for (const Segment& s : segments_) {
      const int count = static_cast<int>(std::ceil(s.length / apart));
      for (int k = 0; k < count; ++k) {
        const double along = s.length * (k + 0.5) / count;
        look_from({s.begin + along * s.direction, s.normal, s.at + along}, minimum);
      }
    }
    return minimum < maximum ? minimum : endless;
  }

 private:
  struct Box {
    Vec2 low = Vec2::Constant(endless), high = Vec2::Constant(-endless);
    void add(const Vec2& p) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    bool near(const Vec2& p, double reach) const {
      return ((p - low).array() > -reach).all() && ((high - p).array() > -reach).all();
    }
  };

  void make_boxes() {
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      if (i % block == 0) boxes_.emplace_back();
      boxes_.back().add(segments_[i].begin);
      boxes_.back().add(segments_[i].begin + segments_[i].length * segments_[i].direction);
    }
  }

  void look_from(const Sample& from, double& minimum) const {
    for (std::size_t b = 0; b < boxes_.size(); ++b) {
      if (!boxes_[b].near(from.point, minimum)) continue;
      const std::size_t end = std::min(segments_.size(), (b + 1) * block);
      for (std::size_t i = b * block; i < end; ++i) look_at(segments_[i], from, minimum);
    }
  }

  // The nearest point of the segment, restricted to points so far along the chain that a ridge larger than
  // the resolution lies between; and only through the tool's body.
  void look_at(const Segment& s, const Sample& from, double& minimum) const {
    double low = 0, high = s.length;
    if (s.at >= from.at)
      low = std::max(low, from.at + 2 * resolution_ - s.at);
    else
      high = std::min(high, from.at - 2 * resolution_ - s.at);
    if (low > high) return;
    const double along = std::clamp((from.point - s.begin).dot(s.direction), low, high);
    const Vec2 through = s.begin + along * s.direction - from.point;
    if (through.dot(from.normal) < 0 && through.dot(s.normal) > 0)
      minimum = std::min(minimum, through.norm());
  }

  double resolution_, length_ = 0;
  std::vector<Segment> segments_;
  std::vector<Box> boxes_;
};

}  // namespace

double thinnest_part(const Shape& shape) {
  double minimum = endless;
  for (const auto& quad : shape.quads) {
    std::array<Vec2, 4> corner;
    for (std::size_t k = 0; k < 4; ++k) {
      const Point& p = shape.nodes[static_cast<std::size_t>(quad[k].value)];
      corner[k] = {p[0], p[1]};
    }
    minimum = std::min(minimum, width_of(corner));
  }
  return minimum;
}

double thinnest_part(const std::vector<Vec2>& chain, double resolution, double maximum) {
  return Chain(chain, resolution).thinnest(maximum);
}

}  // namespace pulvis
