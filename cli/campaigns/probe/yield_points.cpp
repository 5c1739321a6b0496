#include "cli/campaigns/probe/yield_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/portable_math.hpp"

namespace pulvis {
namespace {

// Total strain minus elastic strain.
Mandel plastic_strain(const ProbeCurve& curve, const PowderModuli& moduli, std::size_t i) {
  return curve.strain[i] - moduli.elastic_strain(curve.stress[i] - curve.stress[0]);
}

// Which probe directions have a point.
class Presence {
 public:
  Presence(const std::vector<YieldPoint*>& points, int directions)
      : present_(static_cast<std::size_t>(directions), false) {
    for (const YieldPoint* point : points) present_[place(*point)] = true;
  }
  // Between two points that follow each other on the surface. Near a vertex they may follow in another order than their
  // directions, so both ways round the circle are possible; the one that passes fewer points is theirs.
  bool gap(const YieldPoint& from, const YieldPoint& to) const {
    const Passed forwards = passed(place(from), place(to));
    const Passed backwards = passed(place(to), place(from));
    return (forwards.points <= backwards.points ? forwards : backwards).missing > 0;
  }

 private:
  struct Passed {
    int points = 0, missing = 0;
  };
  std::size_t place(const YieldPoint& point) const {
    const double turns = point.direction.angle / (2 * std::numbers::pi);
    const auto n = static_cast<double>(present_.size());
    return static_cast<std::size_t>(std::lround((turns - std::floor(turns)) * n)) % present_.size();
  }
  Passed passed(std::size_t from, std::size_t to) const {
    Passed all;
    for (std::size_t k = (from + 1) % present_.size(); k != to && k != from;
         k = (k + 1) % present_.size())
      ++(present_[k] ? all.points : all.missing);
    return all;
  }
  std::vector<bool> present_;
};

// The sample before which `measure` first reaches `bound`, and the fraction of that interval.
struct Passing {
  std::size_t after;
  double share;
};
template <class Measure>
std::optional<Passing> first_passing(std::size_t samples, double bound, const Measure& measure) {
  double before = 0;
  for (std::size_t i = 1; i < samples; ++i) {
    const double now = measure(i);
    if (now >= bound) return Passing{i, now > before ? (bound - before) / (now - before) : 1.0};
    before = now;
  }
  return std::nullopt;
}

YieldPoint point_at(const ProbeCurve& curve, const PowderModuli& moduli, const Passing& at) {
  YieldPoint point;
  point.direction = curve.direction;
  point.axis = axis_of(moduli.in_space());
  point.stress = (1 - at.share) * curve.stress[at.after - 1] + at.share * curve.stress[at.after];
  const Mandel now = plastic_strain(curve, moduli, at.after);
  // Its direction: from the increment until it has grown by half.
  const double wanted = 1.5 * now.norm();
  std::size_t end = at.after;
  Mandel later = now;
  while (end + 1 < curve.strain.size() && later.norm() < wanted)
    later = plastic_strain(curve, moduli, ++end);
  const Mandel grown = end == at.after ? now : Mandel(later - now);
  if (grown.norm() > 0) point.plastic = grown.normalized();
  return point;
}

}  // namespace

double YieldPoint::pressure() const { return pressure_of(stress); }
double YieldPoint::deviatoric() const {
  const double across = axis == Axis::y ? stress[0] : 0.5 * (stress[0] + stress[1]);
  return std::copysign(von_mises_of(stress), across - stress[static_cast<int>(axis)]);
}
double YieldPoint::plane_pressure() const { return -0.5 * (stress[0] + stress[1]); }
double YieldPoint::plane_shear() const { return 0.5 * (stress[0] - stress[1]); }
double YieldPoint::opening_pressure() const {
  return axis == Axis::y ? plane_pressure() : pressure();
}

std::optional<YieldPoint> offset_yield(const ProbeCurve& curve, const PowderModuli& moduli,
                                       double offset) {
  const auto at = first_passing(curve.strain.size(), offset, [&](std::size_t i) {
    return plastic_strain(curve, moduli, i).norm();
  });
  if (!at) return std::nullopt;
  return point_at(curve, moduli, *at);
}

std::optional<YieldPoint> dissipation_yield(const ProbeCurve& curve, const PowderModuli& moduli,
                                            double energy) {
  const auto at = first_passing(curve.dissipated.size(), energy,
                                [&](std::size_t i) { return curve.dissipated[i]; });
  if (!at) return std::nullopt;
  return point_at(curve, moduli, *at);
}

void find_normality(std::vector<YieldPoint>& points, const Mandel& centre, int directions) {
  std::vector<YieldPoint*> round;
  for (YieldPoint& point : points)
    if (point.direction.set == ProbeDirection::Set::axial) round.push_back(&point);
  const std::size_t n = round.size();
  if (n < 3) return;
  const AxialPlane plane = axial_plane(round.front()->axis);
  const auto in_plane = [&](const Mandel& of) {
    return Eigen::Vector2d(of.dot(plane.across), of.dot(plane.along));
  };
  std::ranges::sort(round, {}, [&](const YieldPoint* point) {
    const Eigen::Vector2d from = in_plane(point->stress - centre);
    return portable::atan2(from[1], from[0]);
  });
  const Presence presence(round, directions);
  for (std::size_t i = 0; i < n; ++i) {
    const YieldPoint &previous = *round[(i + n - 1) % n], &next = *round[(i + 1) % n];
    YieldPoint& mine = *round[i];
    if (presence.gap(previous, mine) || presence.gap(mine, next)) continue;
    const Eigen::Vector2d tangent = in_plane(next.stress - previous.stress),
                          plastic = in_plane(mine.plastic);
    const double sizes = tangent.norm() * plastic.norm();
    if (sizes == 0) continue;
    // Outward normal of a surface traversed counter-clockwise: (ty, -tx).
    const double cosine = (tangent[1] * plastic[0] - tangent[0] * plastic[1]) / sizes;
    mine.normality = portable::acos(std::clamp(cosine, -1.0, 1.0));
  }
}

}  // namespace pulvis
