#include "cli/campaigns/probe/yield_models.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/portable_math.hpp"

namespace pulvis {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double transition = cap_transition;
using Values = Eigen::VectorXd;
using Terms = YieldModel::Terms;

double cosh_of(double x) { return 0.5 * (portable::exp(x) + portable::exp(-x)); }
double acosh_of(double x) { return portable::log(x + std::sqrt(x * x - 1)); }

// Abaqus Theory Guide, modified Drucker-Prager/Cap: shear failure q = d + p tan(beta); cap an ellipse at p_a with radius
// R (d + p_a tan(beta)); a transition arc between them.
bool in_cap(const Values& x, const Mandel& at) {
  const double p = at[0], q = at[1];
  const double d = x[0], slope = portable::tan(x[1]), r = x[2], p_b = x[3];
  const double p_a = std::max((p_b - r * d) / (1 + r * slope), -d / slope);
  const double strength = d + p_a * slope, cosine = portable::cos(x[1]);
  if (p >= p_a) {
    const double scaled = r * q / (1 + transition - transition / cosine);
    return portable::hypot(p - p_a, scaled) <= r * strength;
  }
  if (q > d + p * slope) return false;
  const double foot = (1 - transition / cosine) * strength;
  const bool below_the_arc = p_a - p > transition * portable::sin(x[1]) * strength || q <= foot;
  return below_the_arc || portable::hypot(p - p_a, q - foot) <= transition * strength;
}

bool in_cam_clay(const Values& x, const Mandel& at) {
  const double p = at[0], q = at[1];
  return q * q <= x[0] * x[0] * p * (x[1] - p);
}

// 3/2 |s - p alpha|^2 <= (M^2 - alpha^2) p (p_c - p), with the tensor alpha = sqrt(2/3) alpha n along the unit deviator n
// of loading: 3/2 |alpha|^2 = alpha^2. All pressures from -p_t.
bool in_s_clay(const Values& x, const Mandel& n, const Mandel& stress) {
  const double shift = x.size() > 3 ? x[3] : 0, p = pressure_of(stress) + shift;
  const Mandel off = deviator_of(stress) - p * std::sqrt(2.0 / 3) * x[2] * n;
  const double slopes = x[0] * x[0] - x[2] * x[2];
  return slopes > 0 && 1.5 * off.squaredNorm() <= slopes * p * (x[1] + shift - p);
}

bool in_fleck_kuhn_mcmeeking(const Values& x, const Mandel& at) {
  const double hydrostatic = std::sqrt(5.0) * at[0] / (3 * x[0]);
  const double shear = 5 * at[1] / (18 * x[0]) + 2.0 / 3;
  return hydrostatic * hydrostatic + shear * shear <= 1;
}

bool in_gurson(const Values& x, double f, const Mandel& at) {
  const double shear = at[1] / x[0];
  return shear * shear + 2 * f * cosh_of(1.5 * at[0] / x[0]) <= 1 + f * f;
}

// Contacts in all directions; closing ones carry c: sigma = c int n n over them. If those within theta of the axis close,
// p = c theta and tau = c/2 sin(2 theta).
bool in_fleck_plane(const Values& x, const Mandel& at) {
  const double p = at[0];
  return p >= 0 && p <= x[0] && at[1] <= x[0] / pi * portable::sin(pi * p / x[0]);
}
// The other contacts carry -c.
bool in_fleck_plane_cohesive(const Values& x, const Mandel& at) {
  const double p = at[0];
  return std::abs(p) <= x[0] && at[1] <= 2 * x[0] / pi * portable::cos(0.5 * pi * p / x[0]);
}

std::vector<Values> cap_starts(double p, double q) {
  std::vector<Values> all;
  for (const double beta : {0.3, 0.6, 0.9})
    for (const double r : {0.3, 0.7, 1.2}) {
      Values x(4);
      x << 0.05 * q, beta, r, p;
      all.push_back(x);
    }
  return all;
}

std::vector<Values> clay_starts(double p, double q) {
  Values x(2);
  x << 2 * q / p, p;
  return {x};
}

std::vector<Values> turned_starts(double p, double q, bool bonded) {
  std::vector<Values> all;
  for (const double alpha : {0.02, 0.3}) {
    Values x(bonded ? 4 : 3);
    x.head<3>() << 2 * q / p + alpha, p, alpha;
    if (bonded) x[3] = 0.05 * p;
    all.push_back(x);
  }
  return all;
}

std::vector<Values> one_start(double value) { return {Values::Constant(1, value)}; }

// Unit deviator of loading; of a state without any the one along the axis.
Mandel deviator_of_loading(const ProbedPowder& powder) {
  constexpr double none = 1e-9;  // of the pressure
  const Mandel s = deviator_of(powder.loaded);
  if (s.norm() > none * std::abs(pressure_of(powder.loaded))) return s.normalized();
  return -deviator_of(Mandel::Unit(static_cast<int>(powder.axis))).normalized();
}

YieldModel s_clay(const ProbedPowder& powder) {
  std::vector<std::string> names{"M", "p_c", "alpha"};
  if (powder.bonded) names.emplace_back("p_t");
  return {"s_clay", names, Terms::stress,
          [bonded = powder.bonded](double p, double q) { return turned_starts(p, q, bonded); },
          [n = deviator_of_loading(powder)](const Values& x, const Mandel& stress) {
            return in_s_clay(x, n, stress);
          }};
}

YieldModel gurson(double relative_density) {
  const double f = std::max(1 - relative_density, 1e-6);
  return {"gurson",
          {"sigma_y"},
          Terms::invariants,
          [f](double p, double q) {
            const double limit = 2.0 / 3 * acosh_of((1 + f * f) / (2 * f));
            return one_start(std::max(q, p / limit));
          },
          [f](const Values& x, const Mandel& at) { return in_gurson(x, f, at); }};
}

}  // namespace

std::vector<YieldModel> yield_models(const ProbedPowder& powder) {
  const auto largest_pressure = [](double p, double) { return one_start(p); };
  std::vector<YieldModel> all{
      {"drucker_prager_cap", {"d", "beta", "R", "p_b"}, Terms::invariants, cap_starts, in_cap},
      {"modified_cam_clay", {"M", "p_c"}, Terms::invariants, clay_starts, in_cam_clay},
      s_clay(powder),
      {"fleck_kuhn_mcmeeking",
       {"p_y"},
       Terms::invariants,
       largest_pressure,
       in_fleck_kuhn_mcmeeking},
      gurson(powder.relative_density)};
  if (powder.axis == Axis::y) {
    all.push_back({"fleck_plane", {"p_y"}, Terms::plane, largest_pressure, in_fleck_plane});
    all.push_back(
        {"fleck_plane_cohesive", {"p_y"}, Terms::plane, largest_pressure, in_fleck_plane_cohesive});
  }
  return all;
}

}  // namespace pulvis
