#include "scenes/lever/loop_plateau.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "scenes/lever/adhesion.hpp"
#include "scenes/lever/afm_loop.hpp"
#include "scenes/lever/mesh/solid_draft.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis {
namespace {

constexpr double turned_angle = 0.04;  // rad: within 0.08% of the full force
constexpr double longer = 1.25;        // than the minimum that the estimate gives

struct Sample {
  double progress;              // -, completed share of the half loop
  double along;                 // N, on the probe, along the scan
  double slides;                // -
  double friction, limit;       // N, along the scan in the surface; its limit
  std::optional<double> angle;  // rad, between friction and the scan
};

class HalfLoop {
 public:
  HalfLoop(const Scene& scene, const AfmHistory& history, std::size_t action, bool retrace)
      : target_(*scene.afm->target),
        action_(scene.afm->actions[action]),
        adhesion_(pull_off_force(scene)),
        lateral_(action_.direction == TargetSpec::Direction::lateral) {
    constexpr double tolerance = 1e-9;
    const double start = static_cast<double>(action) + (retrace ? 0.5 : 0);
    for (std::size_t i = 0; i < history.rows.size(); ++i) {
      const double progress = 2 * (history.times[i] - start);
      if (progress > -tolerance && progress < 1 + tolerance)
        samples_.push_back(sample(history, i, progress));
    }
  }

  Plateau plateau() const {
    Plateau p;
    double first = 0, second = 0;
    int firsts = 0, seconds = 0, angles = 0;
    double cosines = 0;
    for (const Sample& s : samples_) {
      if (s.progress < 0.5) continue;
      p.slides += s.slides;
      if (s.angle) cosines += std::abs(std::cos(*s.angle)), ++angles;
      if (s.progress < 0.75)
        first += s.along, ++firsts;
      else
        second += s.along, ++seconds;
    }
    if (firsts + seconds > 0) p.slides /= firsts + seconds;
    if (angles > 0) p.turned = cosines / angles;
    // The force on a profile has no plateau.
    if (plane() && firsts > 0 && seconds > 0) p.drift = second / seconds - first / firsts;
    p.needed =
        longer * 2 * std::abs(action_.distance) * std::max(until_it_slides(), until_turned());
    return p;
  }

 private:
  bool plane() const { return target_.shape == TargetSpec::Shape::plane; }

  // Of the surface, where it is uniform; a profile's is tilted about the other axis.
  Vec3 normal() const {
    const double rise = plane() ? target_.incline : 0;
    return target_.direction == TargetSpec::Direction::lateral
               ? Vec3(0, -std::sin(rise), std::cos(rise))
               : Vec3(-std::sin(rise), 0, std::cos(rise));
  }

  Sample sample(const AfmHistory& history, std::size_t i, double progress) const {
    const Vec3 force(history.value(i, "probe/force_x"), history.value(i, "probe/force_y"),
                     history.value(i, "probe/force_z"));
    const Vec3 n = normal(), scan = lateral_ ? Vec3(Vec3::UnitY()) : Vec3(Vec3::UnitX());
    const Vec3 tangent = force - n.dot(force) * n;
    const Vec3 e = (scan - n.dot(scan) * n).normalized();
    Sample s{progress,
             scan.dot(force),
             history.value(i, "contact/slides"),
             tangent.dot(e),
             target_.friction * std::max(0.0, n.dot(force) + adhesion_),
             {}};
    const double across = tangent.dot(n.cross(e));
    if (plane()) {
      if (tangent.norm() > 0) s.angle = std::atan2(std::abs(across), std::abs(s.friction));
    } else if (target_.shape != TargetSpec::Shape::map && target_.direction == action_.direction) {
      // The profile has no slope across the scan: friction alone acts there. From |F|^2 = N^2 + mu^2 (N + A)^2.
      const double mu = target_.friction, a = adhesion_, m = 1 + mu * mu;
      const double root = force.squaredNorm() * m - mu * mu * a * a;
      const double size = mu * ((std::sqrt(std::max(0.0, root)) - mu * mu * a) / m + a);
      if (size > 0) s.angle = std::asin(std::min(1.0, std::abs(across) / size));
    }
    return s;
  }

  // Share of the half loop, possibly above 1, where sliding begins. Friction rises linearly till then.
  double until_it_slides() const {
    constexpr double all = 1 - 1e-3;
    for (const Sample& s : samples_)
      if (s.slides >= all && s.progress > 0) return s.progress;
    if (samples_.size() < 2) return 0;
    const Sample& first = samples_.front();
    const Sample& last = samples_.back();
    const double rate = (last.friction - first.friction) / (last.progress - first.progress);
    return rate == 0 ? 0 : last.progress + std::abs((last.limit + std::abs(last.friction)) / rate);
  }

  double until_turned() const {
    const auto g = [](double angle) { return std::log(std::tan(0.5 * angle)) + std::cos(angle); };
    std::vector<const Sample*> slid;
    for (const Sample& s : samples_)
      if (s.slides > 0 && s.angle && *s.angle > turned_angle) slid.push_back(&s);
    if (slid.empty()) return 0;
    const Sample& last = *slid.back();
    if (&last != &samples_.back()) return last.progress;  // has turned
    // Over the last half of the sliding samples: the load has settled by then.
    const Sample& first = *slid[slid.size() / 2];
    const double unwound = g(*first.angle) - g(*last.angle);
    if (!(unwound > 0)) return 0;
    return last.progress +
           (last.progress - first.progress) * (g(*last.angle) - g(turned_angle)) / unwound;
  }

  const TargetSpec& target_;
  const ActionSpec& action_;
  double adhesion_;
  bool lateral_;
  std::vector<Sample> samples_;
};

}  // namespace

Plateau plateau_of(const Scene& scene, const AfmHistory& history, std::size_t action,
                   bool retrace) {
  return HalfLoop(scene, history, action, retrace).plateau();
}

}  // namespace pulvis
