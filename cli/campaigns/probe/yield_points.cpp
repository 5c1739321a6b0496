#include "cli/campaigns/probe/yield_points.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/portable_math.hpp"

namespace pulvis {
namespace {

double length(double x, double y) { return std::sqrt(x * x + y * y); }

// Total strain minus elastic strain, xx and yy.
std::array<double, 2> plastic_strain(const ProbeCurve& curve, const PowderModuli& m,
                                     std::size_t i) {
  const double sx = curve.stress[i][0] - curve.stress[0][0];
  const double sy = curve.stress[i][1] - curve.stress[0][1];
  const double det = m.c11 * m.c22 - m.c12 * m.c12;
  return {curve.strain[i][0] - (m.c22 * sx - m.c12 * sy) / det,
          curve.strain[i][1] - (m.c11 * sy - m.c12 * sx) / det};
}

// Which probe directions have a point.
class Presence {
 public:
  Presence(const std::vector<YieldPoint>& points, int directions)
      : present_(static_cast<std::size_t>(directions), false) {
    for (const YieldPoint& point : points) present_[place(point)] = true;
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
    const double turns = point.angle / (2 * std::numbers::pi);
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
  point.angle = curve.angle;
  for (std::size_t k = 0; k < 4; ++k)
    point.stress[k] =
        (1 - at.share) * curve.stress[at.after - 1][k] + at.share * curve.stress[at.after][k];
  const auto now = plastic_strain(curve, moduli, at.after);
  // Its direction: from the increment until it has grown by half.
  const double wanted = 1.5 * length(now[0], now[1]);
  std::size_t end = at.after;
  auto later = now;
  while (end + 1 < curve.strain.size() && length(later[0], later[1]) < wanted)
    later = plastic_strain(curve, moduli, ++end);
  const auto start = end == at.after ? std::array<double, 2>{} : now;
  const double dx = later[0] - start[0], dy = later[1] - start[1], size = length(dx, dy);
  if (size > 0) point.plastic = {dx / size, dy / size};
  return point;
}

}  // namespace

double PowderModuli::youngs_modulus() const {
  const double shear = 0.5 * (0.5 * (c11 + c22) - c12);
  return 2 * shear * (1 + poissons_ratio());
}
double PowderModuli::poissons_ratio() const {
  const double shear = 0.5 * (0.5 * (c11 + c22) - c12);
  return c12 / (2 * (c12 + shear));
}
bool PowderModuli::are_of_a_solid() const { return c11 > 0 && c11 * c22 > c12 * c12 && g >= 0; }

double YieldPoint::pressure() const { return -(stress[0] + stress[1] + stress[3]) / 3; }
double YieldPoint::deviatoric() const {
  const auto& [xx, yy, xy, zz] = stress;
  const double squares = (xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx);
  return std::copysign(std::sqrt(0.5 * squares + 3 * xy * xy), xx - yy);
}
double YieldPoint::plane_pressure() const { return -0.5 * (stress[0] + stress[1]); }
double YieldPoint::plane_shear() const { return 0.5 * (stress[0] - stress[1]); }

PowderModuli moduli_of(const std::vector<ProbeCurve>& curves, const ProbeCurve* shear,
                       double elastic_strain) {
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero(), products = Eigen::Matrix2d::Zero();
  for (const ProbeCurve& curve : curves)
    for (std::size_t i = 1; i < curve.strain.size(); ++i) {
      const Eigen::Vector2d strain(curve.strain[i][0], curve.strain[i][1]);
      if (strain.norm() > elastic_strain) break;
      const Eigen::Vector2d stress(curve.stress[i][0] - curve.stress[0][0],
                                   curve.stress[i][1] - curve.stress[0][1]);
      squares += strain * strain.transpose();
      products += stress * strain.transpose();
    }
  const Eigen::Matrix2d c = products * squares.inverse();
  PowderModuli moduli{c(0, 0), 0.5 * (c(0, 1) + c(1, 0)), c(1, 1)};
  if (shear == nullptr) return moduli;
  double square = 0, product = 0;
  for (std::size_t i = 1;
       i < shear->strain.size() && std::abs(shear->strain[i][2]) <= elastic_strain; ++i) {
    square += 2 * shear->strain[i][2] * shear->strain[i][2];
    product += shear->strain[i][2] * (shear->stress[i][2] - shear->stress[0][2]);
  }
  moduli.g = square > 0 ? product / square : 0;
  return moduli;
}

std::optional<YieldPoint> offset_yield(const ProbeCurve& curve, const PowderModuli& moduli,
                                       double offset) {
  const auto at = first_passing(curve.strain.size(), offset, [&](std::size_t i) {
    const auto plastic = plastic_strain(curve, moduli, i);
    return length(plastic[0], plastic[1]);
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

void find_normality(std::vector<YieldPoint>& points, const std::array<double, 2>& centre,
                    int directions) {
  const auto direction = [&](const YieldPoint& p) {
    return portable::atan2(p.stress[1] - centre[1], p.stress[0] - centre[0]);
  };
  std::ranges::sort(points, {}, direction);
  const std::size_t n = points.size();
  if (n < 3) return;
  const Presence presence(points, directions);
  for (std::size_t i = 0; i < n; ++i) {
    const YieldPoint &previous = points[(i + n - 1) % n], &next = points[(i + 1) % n];
    if (presence.gap(previous, points[i]) || presence.gap(points[i], next)) continue;
    const auto &before = previous.stress, &after = next.stress;
    const double tx = after[0] - before[0], ty = after[1] - before[1];
    const double size = length(tx, ty);
    const auto& plastic = points[i].plastic;
    if (size == 0 || (plastic[0] == 0 && plastic[1] == 0)) continue;
    // Outward normal of a surface traversed counter-clockwise: (ty, -tx).
    const double cosine = (ty * plastic[0] - tx * plastic[1]) / size;
    points[i].normality = portable::acos(std::clamp(cosine, -1.0, 1.0));
  }
}

}  // namespace pulvis
