#include "cli/campaigns/probe/cap_models.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "engine/portable_math.hpp"
#include "scenes/solve/lab_statistics.hpp"
#include "scenes/solve/least_squares.hpp"

namespace pulvis {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double transition = cap_transition;
constexpr double open = 0.1;         // fraction of the largest in-plane pressure
constexpr double other_side = 0.05;  // q below 0 by this fraction of the largest pressure
// Weight of the logarithms' distance from the start, relative to distances over the largest pressure: it decides where the
// points do not, such as for the cohesion of a cohesionless powder.
constexpr double prior = 0.005;
using Values = Eigen::VectorXd;

double cosh_of(double x) { return 0.5 * (portable::exp(x) + portable::exp(-x)); }
double acosh_of(double x) { return portable::log(x + std::sqrt(x * x - 1)); }
Values exp_of(Values x) {
  for (double& one : x) one = portable::exp(one);
  return x;
}
Values log_of(Values x) {
  for (double& one : x) one = portable::log(one);
  return x;
}

struct Model {
  const char* name;
  std::vector<const char*> parameters;
  bool in_plane;
  // Initial parameters, all > 0; from the largest pressure and shear. The best fit is taken.
  std::function<std::vector<Values>(double p, double q)> starts;
  std::function<bool(const Values& x, double p, double q)> elastic;
};

// Abaqus Theory Guide, modified Drucker-Prager/Cap: shear failure q = d + p tan(beta); cap an ellipse at p_a with radius
// R (d + p_a tan(beta)); a transition arc between them.
bool in_cap(const Values& x, double p, double q) {
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

bool in_cam_clay(const Values& x, double p, double q) {
  return q * q <= x[0] * x[0] * p * (x[1] - p);
}

bool in_fleck_kuhn_mcmeeking(const Values& x, double p, double q) {
  const double hydrostatic = std::sqrt(5.0) * p / (3 * x[0]);
  const double shear = 5 * q / (18 * x[0]) + 2.0 / 3;
  return hydrostatic * hydrostatic + shear * shear <= 1;
}

bool in_gurson(const Values& x, double f, double p, double q) {
  const double shear = q / x[0];
  return shear * shear + 2 * f * cosh_of(1.5 * p / x[0]) <= 1 + f * f;
}

// Contacts in all directions; closing ones carry c: sigma = c int n n over them. If those within theta of the axis close,
// p = c theta and tau = c/2 sin(2 theta).
bool in_fleck_plane(const Values& x, double p, double tau) {
  return p >= 0 && p <= x[0] && tau <= x[0] / pi * portable::sin(pi * p / x[0]);
}
// The other contacts carry -c.
bool in_fleck_plane_cohesive(const Values& x, double p, double tau) {
  return std::abs(p) <= x[0] && tau <= 2 * x[0] / pi * portable::cos(0.5 * pi * p / x[0]);
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

std::vector<Values> one_start(double value) { return {Values::Constant(1, value)}; }

std::vector<Model> models(double density) {
  const double f = std::max(1 - density, 1e-6);
  return {
      {"drucker_prager_cap", {"d", "beta", "R", "p_b"}, false, cap_starts, in_cap},
      {"modified_cam_clay",
       {"M", "p_c"},
       false,
       [](double p, double q) {
         Values x(2);
         x << 2 * q / p, p;
         return std::vector{x};
       },
       in_cam_clay},
      {"fleck_kuhn_mcmeeking",
       {"p_y"},
       false,
       [](double p, double) { return one_start(p); },
       in_fleck_kuhn_mcmeeking},
      {"gurson",
       {"sigma_y"},
       false,
       [f](double p, double q) {
         const double limit = 2.0 / 3 * acosh_of((1 + f * f) / (2 * f));
         return one_start(std::max(q, p / limit));
       },
       [f](const Values& x, double p, double q) { return in_gurson(x, f, p, q); }},
      {"fleck_plane", {"p_y"}, true, [](double p, double) { return one_start(p); }, in_fleck_plane},
      {"fleck_plane_cohesive",
       {"p_y"},
       true,
       [](double p, double) { return one_start(p); },
       in_fleck_plane_cohesive}};
}

struct Plane {
  double p, q;
};

// Distance from (centre, 0) to the model's surface along a direction, Pa. All surfaces are convex.
double radius(const Model& model, const Values& x, double centre, double cosine, double sine) {
  const auto elastic = [&](double r) { return model.elastic(x, centre + r * cosine, r * sine); };
  if (!elastic(0)) return 0;
  double low = 0, high = centre;
  while (elastic(high) && high < 1e6 * centre) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (elastic(middle) ? low : high) = middle;
  }
  return low;
}

// Residuals as functions of the logarithms of the parameters, which keeps them positive: of the points, then the prior.
struct Misfit {
  const Model& model;
  const std::vector<Plane>& points;
  double centre, scale;
  Values start;
  Misfit(const Model& m, const std::vector<Plane>& all, double p_max, Values from)
      : model(m), points(all), centre(0.5 * p_max), scale(p_max), start(std::move(from)) {}
  Eigen::Index values() const { return static_cast<Eigen::Index>(points.size()) + start.size(); }
  void operator()(const Values& logarithms, Values& residuals) const {
    const Values x = exp_of(logarithms);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double dp = points[i].p - centre, q = points[i].q, away = portable::hypot(dp, q);
      residuals[static_cast<Eigen::Index>(i)] =
          (radius(model, x, centre, dp / away, q / away) - away) / scale;
    }
    residuals.tail(start.size()) = prior * (logarithms - start);
  }
};

struct Fit {
  Values start, parameters;
  double cost, misfit;
};

Fit fit_from(const Model& model, const std::vector<Plane>& points, double p_max,
             const Values& start) {
  Values x = log_of(start);
  const Misfit misfit(model, points, p_max, x);
  levenberg_marquardt(misfit, misfit.values(), {.evaluations = 2000, .difference = 1e-10}, x);
  Values residuals(misfit.values());
  misfit(x, residuals);
  double squares = 0, n = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].p == 0 && points[i].q == 0) continue;  // not a probe's point
    const double one = residuals[static_cast<Eigen::Index>(i)];
    squares += one * one, n += 1;
  }
  return {start, exp_of(x), residuals.squaredNorm(), std::sqrt(squares / n)};
}

// Sum of squares over the points if parameter k has this logarithm and the others fit best. x is the start of the search,
// and its end.
double squares_with(const Misfit& misfit, Eigen::Index k, double logarithm, Values& x) {
  const Eigen::Index others = x.size() - 1;
  const auto whole = [&](const Values& of_others) {
    Values all(others + 1);
    all << of_others.head(k), logarithm, of_others.tail(others - k);
    return all;
  };
  const auto residuals_of = [&](const Values& of_others, Values& residuals) {
    misfit(whole(of_others), residuals);
    residuals[static_cast<Eigen::Index>(misfit.points.size()) + k] = 0;  // no prior of its own
  };
  Values free(others);
  free << x.head(k), x.tail(others - k);
  if (others > 0)
    levenberg_marquardt(residuals_of, misfit.values(),
                        {.evaluations = 200, .tolerance = 1e-6, .difference = 1e-10}, free);
  x = whole(free);
  Values residuals(misfit.values());
  misfit(x, residuals);
  return residuals.head(static_cast<Eigen::Index>(misfit.points.size())).squaredNorm();
}

// How far the logarithm of parameter k can move in a direction before the squares exceed the limit; infinity: farther
// than `farthest`.
double reach(const Misfit& misfit, const Values& best, Eigen::Index k, double direction,
             double farthest, double limit) {
  Values x = best;
  double inside = 0, step = 0.02;
  const auto fits = [&](double distance) {
    Values from = x;
    if (squares_with(misfit, k, best[k] + direction * distance, from) > limit) return false;
    x = std::move(from);
    return true;
  };
  double outside = std::min(step, farthest);
  while (fits(outside)) {
    if (outside >= farthest) return std::numeric_limits<double>::infinity();
    inside = outside;
    outside = std::min(inside + (step *= 1.7), farthest);
  }
  for (int i = 0; i < 4; ++i) {
    const double middle = 0.5 * (inside + outside);
    (fits(middle) ? inside : outside) = middle;
  }
  return outside;
}

constexpr double steepest = 89.0 / 180 * pi;  // of beta

bool is_determined(const std::string& name, double value, double low, double high, double p_max) {
  if (name == "d" && high - low <= 0.1 * p_max) return true;
  if (name != "beta") return high - low <= value;
  return high < steepest && portable::tan(high) - portable::tan(low) <= portable::tan(value);
}

// Profiles of the sum of squares, which are exact where the parameters act together: a linear estimate at the best fit is
// not. The limit is that of Student's distribution for the scatter of the points around the surface, at least 1e-4.
std::vector<ParameterRange> ranges_of(const Model& model, const std::vector<Plane>& points,
                                      double p_max, const Values& best, const Values& start) {
  const Misfit misfit(model, points, p_max, log_of(start));
  const Values logarithms = log_of(best);
  Values residuals(misfit.values());
  misfit(logarithms, residuals);
  const auto n = static_cast<double>(points.size());
  const auto head = residuals.head(static_cast<Eigen::Index>(points.size()));
  const int degrees = std::max(1, static_cast<int>(points.size()) - static_cast<int>(best.size()));
  const double t = lab::student_quantile(0.95, degrees);
  const double limit = std::max(head.squaredNorm(), 1e-8 * n) * (1 + t * t / degrees);
  std::vector<ParameterRange> ranges;
  for (Eigen::Index k = 0; k < best.size(); ++k) {
    const std::string name = model.parameters[static_cast<std::size_t>(k)];
    const double factor = std::numbers::ln10;
    double up = factor;
    if (name == "beta") up = std::max(0.0, portable::log(steepest) - logarithms[k]);
    if (name == "d")
      up = std::max(up, portable::log(p_max) - logarithms[k]);  // from next to nothing
    const double below = reach(misfit, logarithms, k, -1, factor, limit);
    const double above = reach(misfit, logarithms, k, 1, up, limit);
    ParameterRange range{name, std::isinf(below) ? 0 : best[k] * portable::exp(-below),
                         best[k] * portable::exp(above)};
    if (std::isinf(above)) range.high = name == "beta" ? 0.5 * pi : above;
    range.determined = is_determined(name, best[k], range.low, range.high, p_max);
    ranges.push_back(range);
  }
  return ranges;
}

FittedModel fitted(const Model& model, const std::vector<Plane>& points) {
  double p_max = 0, q_max = 0;
  for (const Plane& point : points) {
    p_max = std::max(p_max, point.p);
    q_max = std::max(q_max, point.q);
  }
  std::vector<Fit> fits;
  for (const Values& start : model.starts(p_max, std::max(q_max, 1e-3 * p_max)))
    fits.push_back(fit_from(model, points, p_max, start));
  const Fit& best = *std::ranges::min_element(fits, {}, &Fit::cost);

  FittedModel fit;
  fit.name = model.name;
  fit.in_plane = model.in_plane;
  fit.misfit = best.misfit;
  fit.ranges = ranges_of(model, points, p_max, best.parameters, best.start);
  for (std::size_t k = 0; k < model.parameters.size(); ++k)
    fit.parameters.emplace_back(model.parameters[k], best.parameters[static_cast<Eigen::Index>(k)]);
  constexpr int steps = 90;
  for (int i = 0; i <= steps; ++i) {
    const double angle = pi * i / steps, c = portable::cos(angle), s = portable::sin(angle);
    const double r = radius(model, best.parameters, 0.5 * p_max, c, s);
    fit.surface.emplace_back(0.5 * p_max + r * c, r * s);
  }
  return fit;
}

}  // namespace

double FittedModel::parameter(const std::string& of) const {
  for (const auto& [key, value] : parameters)
    if (key == of) return value;
  throw std::out_of_range(of);
}

std::string undetermined(const FittedModel& model) {
  std::string text;
  for (const ParameterRange& range : model.ranges) {
    if (range.determined) continue;
    const bool is_angle = range.name == "beta";
    const bool is_ratio = range.name == "R" || range.name == "M";
    const double unit = is_angle ? pi / 180 : is_ratio ? 1 : 1e6;
    const char* const word = is_angle ? " deg" : is_ratio ? "" : " MPa";
    text +=
        fmt::format("{}{} ({:.3g}{})", text.empty() ? "" : ", ", range.name, range.low / unit,
                    std::isinf(range.high) ? fmt::format("{} and more", word)
                                           : fmt::format(" to {:.3g}{}", range.high / unit, word));
  }
  return text;
}

std::vector<bool> usable(const std::vector<YieldPoint>& points) {
  double largest = 0;
  for (const YieldPoint& point : points) largest = std::max(largest, point.plane_pressure());
  std::vector<bool> found;
  for (const YieldPoint& point : points)
    found.push_back(point.plane_pressure() >= open * largest &&
                    point.deviatoric() >= -other_side * largest);
  return found;
}

std::size_t usable_points(const std::vector<YieldPoint>& points) {
  const std::vector<bool> found = usable(points);
  return static_cast<std::size_t>(std::ranges::count(found, true));
}

std::vector<FittedModel> fit_caps(const std::vector<YieldPoint>& points, double relative_density,
                                  bool bonded) {
  std::vector<Plane> all, in_plane;
  const std::vector<bool> used = usable(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!used[i]) continue;
    const YieldPoint& point = points[i];
    all.push_back({point.pressure(), std::abs(point.deviatoric())});
    in_plane.push_back({point.plane_pressure(), std::abs(point.plane_shear())});
  }
  std::vector<FittedModel> fits;
  if (all.size() < fewest_points) return fits;
  for (const Model& model : models(relative_density)) {
    const bool cap = std::string(model.name) == "drucker_prager_cap";
    std::vector<Plane> mine = model.in_plane ? in_plane : all;
    if (cap && !bonded) mine.push_back({0, 0});
    FittedModel fit = fitted(model, mine);
    if (cap) {
      const double slope = portable::tan(fit.parameter("beta")), r = fit.parameter("R");
      fit.parameters.emplace_back("alpha", transition);
      fit.parameters.emplace_back(
          "p_a", (fit.parameter("p_b") - r * fit.parameter("d")) / (1 + r * slope));
    }
    if (fit.name == "gurson") fit.parameters.emplace_back("f", 1 - relative_density);
    fits.push_back(std::move(fit));
  }
  return fits;
}

bool is_elastic(const std::string& name,
                const std::vector<std::pair<std::string, double>>& parameters, double p, double q) {
  double f = 0;
  for (const auto& [key, value] : parameters)
    if (key == "f") f = value;
  for (const Model& model : models(1 - f)) {
    if (model.name != name) continue;
    Values x(static_cast<Eigen::Index>(model.parameters.size()));
    for (std::size_t k = 0; k < model.parameters.size(); ++k)
      x[static_cast<Eigen::Index>(k)] = parameters[k].second;
    return model.elastic(x, p, q);
  }
  throw std::out_of_range(name);
}

}  // namespace pulvis
