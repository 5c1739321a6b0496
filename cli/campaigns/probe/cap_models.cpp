#include "cli/campaigns/probe/cap_models.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
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
constexpr double open = 0.1;         // fraction of the largest opening pressure
constexpr double other_side = 0.05;  // q below 0 by this fraction of the largest pressure
// Weight of the logarithms' distance from the start, relative to distances over the largest pressure: it decides where the
// points do not, such as for the cohesion of a cohesionless powder.
constexpr double prior = 0.005;
using Values = Eigen::VectorXd;
using Terms = YieldModel::Terms;

Values exp_of(Values x) {
  for (double& one : x) one = portable::exp(one);
  return x;
}
Values log_of(Values x) {
  for (double& one : x) one = portable::log(one);
  return x;
}

// The points in the terms of a model, and where its rays begin.
struct Cloud {
  std::vector<Mandel> points;
  Mandel centre = Mandel::Zero();
  double p_max = 0, q_max = 0;  // Pa
  double scale = 1;             // Pa, length that stands for the largest pressure
};

// Distance from the centre to the model's surface along a unit vector, Pa. All surfaces are convex.
double radius(const YieldModel& model, const Values& x, const Cloud& cloud, const Mandel& along) {
  const auto elastic = [&](double r) { return model.elastic(x, cloud.centre + r * along); };
  if (!elastic(0)) return 0;
  double low = 0, high = 0.5 * cloud.scale;
  while (elastic(high) && high < 1e6 * cloud.scale) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (elastic(middle) ? low : high) = middle;
  }
  return low;
}

// Residuals as functions of the logarithms of the parameters, which keeps them positive: of the points, then the prior.
struct Misfit {
  const YieldModel& model;
  const Cloud& cloud;
  Values start;
  Misfit(const YieldModel& m, const Cloud& all, Values from)
      : model(m), cloud(all), start(std::move(from)) {}
  Eigen::Index points() const { return static_cast<Eigen::Index>(cloud.points.size()); }
  Eigen::Index values() const { return points() + start.size(); }
  void operator()(const Values& logarithms, Values& residuals) const {
    const Values x = exp_of(logarithms);
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
      const Mandel from = cloud.points[i] - cloud.centre;
      const double away = from.norm();
      residuals[static_cast<Eigen::Index>(i)] =
          (radius(model, x, cloud, from / away) - away) / cloud.scale;
    }
    residuals.tail(start.size()) = prior * (logarithms - start);
  }
};

struct Fit {
  Values start, parameters;
  double cost, misfit;
};

Fit fit_from(const YieldModel& model, const Cloud& cloud, const Values& start) {
  Values x = log_of(start);
  const Misfit misfit(model, cloud, x);
  levenberg_marquardt(misfit, misfit.values(), {.evaluations = 2000, .difference = 1e-10}, x);
  Values residuals(misfit.values());
  misfit(x, residuals);
  double squares = 0, n = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.points[i].isZero(0)) continue;  // not a probe's point
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
    residuals[misfit.points() + k] = 0;  // no prior of its own
  };
  Values free(others);
  free << x.head(k), x.tail(others - k);
  if (others > 0)
    levenberg_marquardt(residuals_of, misfit.values(),
                        {.evaluations = 200, .tolerance = 1e-6, .difference = 1e-10}, free);
  x = whole(free);
  Values residuals(misfit.values());
  misfit(x, residuals);
  return residuals.head(misfit.points()).squaredNorm();
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
  // M and alpha act together: an ellipsoid that is not turned has any small alpha.
  if (name == "alpha") return high - low <= std::max(0.1, value);
  if (name == "p_t" && high - low <= 0.1 * p_max) return true;
  if (name != "beta") return high - low <= value;
  return high < steepest && portable::tan(high) - portable::tan(low) <= portable::tan(value);
}

// Profiles of the sum of squares, which are exact where the parameters act together: a linear estimate at the best fit is
// not. The limit is that of Student's distribution for the scatter of the points around the surface, at least 1e-4.
std::vector<ParameterRange> ranges_of(const YieldModel& model, const Cloud& cloud,
                                      const Values& best, const Values& start) {
  const Misfit misfit(model, cloud, log_of(start));
  const Values logarithms = log_of(best);
  Values residuals(misfit.values());
  misfit(logarithms, residuals);
  const auto n = static_cast<double>(misfit.points());
  const auto head = residuals.head(misfit.points());
  const int degrees = std::max(1, static_cast<int>(misfit.points() - best.size()));
  const double t = lab::student_quantile(0.95, degrees);
  const double limit = std::max(head.squaredNorm(), 1e-8 * n) * (1 + t * t / degrees);
  std::vector<ParameterRange> ranges;
  for (Eigen::Index k = 0; k < best.size(); ++k) {
    const std::string& name = model.parameters[static_cast<std::size_t>(k)];
    const double factor = std::numbers::ln10;
    double up = factor;
    if (name == "beta") up = std::max(0.0, portable::log(steepest) - logarithms[k]);
    // From next to nothing.
    if (name == "d" || name == "p_t") up = std::max(up, portable::log(cloud.p_max) - logarithms[k]);
    if (name == "alpha") up = std::max(up, -logarithms[k]);
    const double below = reach(misfit, logarithms, k, -1, factor, limit);
    const double above = reach(misfit, logarithms, k, 1, up, limit);
    ParameterRange range{name, std::isinf(below) ? 0 : best[k] * portable::exp(-below),
                         best[k] * portable::exp(above)};
    if (std::isinf(above)) range.high = name == "beta" ? 0.5 * pi : above;
    range.determined = is_determined(name, best[k], range.low, range.high, cloud.p_max);
    ranges.push_back(range);
  }
  return ranges;
}

constexpr int steps = 90;  // of a surface over half a turn

std::vector<std::pair<double, double>> surface_of(const YieldModel& model, const Values& x,
                                                  const Cloud& cloud) {
  std::vector<std::pair<double, double>> surface;
  for (int i = 0; i <= steps; ++i) {
    const double angle = pi * i / steps, c = portable::cos(angle), s = portable::sin(angle);
    const double r = radius(model, x, cloud, c * Mandel::Unit(0) + s * Mandel::Unit(1));
    surface.emplace_back(cloud.centre[0] + r * c, r * s);
  }
  return surface;
}

Mandel isotropic_pressure() { return -Mandel(1, 1, 1, 0, 0, 0) / std::sqrt(3.0); }  // unit

// Of a model in terms of the stresses: where the plane of the axis and the pressure cuts it, on both sides.
std::vector<std::pair<double, double>> cut_of(const YieldModel& model, const Values& x, Cloud cloud,
                                              Axis axis) {
  // In plane strain zz is about the mean of the others.
  const Mandel deviator =
      axis == Axis::z ? unit_deviator(0) : Mandel(Mandel(1, -1, 0, 0, 0, 0) / std::sqrt(2.0));
  cloud.centre = cloud.centre.dot(isotropic_pressure()) * isotropic_pressure() +
                 cloud.centre.dot(deviator) * deviator;
  std::vector<std::pair<double, double>> surface;
  for (int i = 0; i <= 2 * steps; ++i) {
    const double angle = pi * i / steps;
    const Mandel along =
        portable::cos(angle) * isotropic_pressure() + portable::sin(angle) * deviator;
    const Mandel at = cloud.centre + radius(model, x, cloud, along) * along;
    surface.emplace_back(pressure_of(at), std::sqrt(1.5) * at.dot(deviator));
  }
  return surface;
}

// The same in the space of xx, yy and zz, without shear: rows from the axis of pressures outwards and back to it.
std::vector<std::vector<std::array<double, 3>>> shell_of(const YieldModel& model, const Values& x,
                                                         Cloud cloud) {
  cloud.centre.tail<3>().setZero();
  constexpr int rows = 16, columns = 24;
  std::vector<std::vector<std::array<double, 3>>> shell;
  for (int i = 0; i <= rows; ++i) {
    const double polar = pi * i / rows;
    auto& row = shell.emplace_back();
    for (int k = 0; k < columns; ++k) {
      const Mandel along = portable::cos(polar) * isotropic_pressure() +
                           portable::sin(polar) * unit_deviator(2 * pi * k / columns);
      const Mandel at = cloud.centre + radius(model, x, cloud, along) * along;
      row.push_back({at[0], at[1], at[2]});
    }
  }
  return shell;
}

FittedModel fitted(const YieldModel& model, const Cloud& cloud, const ProbedPowder& powder) {
  std::vector<Fit> fits;
  for (const Values& start : model.starts(cloud.p_max, std::max(cloud.q_max, 1e-3 * cloud.p_max)))
    fits.push_back(fit_from(model, cloud, start));
  const Fit& best = *std::ranges::min_element(fits, {}, &Fit::cost);

  FittedModel fit;
  fit.name = model.name;
  fit.terms = model.terms;
  fit.misfit = best.misfit;
  fit.ranges = ranges_of(model, cloud, best.parameters, best.start);
  for (std::size_t k = 0; k < model.parameters.size(); ++k)
    fit.parameters.emplace_back(model.parameters[k], best.parameters[static_cast<Eigen::Index>(k)]);
  if (model.terms != Terms::stress) {
    fit.surface = surface_of(model, best.parameters, cloud);
    return fit;
  }
  fit.surface = cut_of(model, best.parameters, cloud, powder.axis);
  if (powder.axis == Axis::z) fit.shell = shell_of(model, best.parameters, cloud);
  return fit;
}

// Rays begin at half of the largest pressure, or where the probes began.
Cloud cloud_of(const std::vector<YieldPoint>& points, const std::vector<bool>& used, Terms terms,
               const ProbedPowder& powder) {
  Cloud cloud;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!used[i]) continue;
    const YieldPoint& point = points[i];
    const bool plane = terms == Terms::plane;
    const double p = plane ? point.plane_pressure() : point.pressure();
    const double q = std::abs(plane ? point.plane_shear() : point.deviatoric());
    cloud.p_max = std::max(cloud.p_max, p);
    cloud.q_max = std::max(cloud.q_max, q);
    cloud.points.push_back(terms == Terms::stress ? point.stress : Mandel(p, q, 0, 0, 0, 0));
  }
  cloud.scale = terms == Terms::stress ? std::sqrt(3.0) * cloud.p_max : cloud.p_max;
  cloud.centre = terms == Terms::stress ? powder.centre : 0.5 * cloud.p_max * Mandel::Unit(0);
  return cloud;
}

// What follows from the fitted parameters.
void complete(FittedModel& fit, const ProbedPowder& powder) {
  if (fit.name == "drucker_prager_cap") {
    const double slope = portable::tan(fit.parameter("beta")), r = fit.parameter("R");
    fit.parameters.emplace_back("alpha", cap_transition);
    fit.parameters.emplace_back("p_a",
                                (fit.parameter("p_b") - r * fit.parameter("d")) / (1 + r * slope));
  }
  if (fit.name == "gurson") fit.parameters.emplace_back("f", 1 - powder.relative_density);
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
    const bool is_ratio = range.name == "R" || range.name == "M" || range.name == "alpha";
    const double unit = is_angle ? pi / 180 : is_ratio ? 1 : 1e6;
    const char* const word = is_angle ? " deg" : is_ratio ? "" : " MPa";
    text +=
        fmt::format("{}{} ({:.3g}{})", text.empty() ? "" : ", ", range.name, range.low / unit,
                    std::isinf(range.high) ? fmt::format("{} and more", word)
                                           : fmt::format(" to {:.3g}{}", range.high / unit, word));
  }
  return text;
}

bool FittedModel::determines(const std::string& of) const {
  const auto open_one = [&](const std::string& parameter) {
    const auto range = std::ranges::find(ranges, parameter, &ParameterRange::name);
    return range != ranges.end() && !range->determined;
  };
  if (of == "p_a") return !open_one("p_b") && !open_one("R") && !open_one("beta");
  return !open_one(of);
}

const FittedModel* model_of(const std::vector<FittedModel>& models, const std::string& name) {
  const auto found = std::ranges::find(models, name, &FittedModel::name);
  return found == models.end() ? nullptr : &*found;
}

std::vector<bool> closed(const std::vector<YieldPoint>& points) {
  double largest = 0;
  for (const YieldPoint& point : points) largest = std::max(largest, point.opening_pressure());
  std::vector<bool> found;
  for (const YieldPoint& point : points)
    found.push_back(point.opening_pressure() >= open * largest);
  return found;
}

std::vector<bool> usable(const std::vector<YieldPoint>& points) {
  double largest = 0;
  for (const YieldPoint& point : points) largest = std::max(largest, point.opening_pressure());
  std::vector<bool> found = closed(points);
  for (std::size_t i = 0; i < points.size(); ++i)
    found[i] = found[i] && points[i].direction.set != ProbeDirection::Set::shear &&
               points[i].deviatoric() >= -other_side * largest;
  return found;
}

std::size_t usable_points(const std::vector<YieldPoint>& points) {
  const std::vector<bool> found = usable(points);
  return static_cast<std::size_t>(std::ranges::count(found, true));
}

std::vector<FittedModel> fit_caps(const std::vector<YieldPoint>& points,
                                  const ProbedPowder& powder) {
  std::vector<FittedModel> fits;
  if (usable_points(points) < fewest_points) return fits;
  const std::vector<bool> one_side = usable(points), all = closed(points);
  for (const YieldModel& model : yield_models(powder)) {
    Cloud cloud =
        cloud_of(points, model.terms == Terms::stress ? all : one_side, model.terms, powder);
    if (model.name == "drucker_prager_cap" && !powder.bonded)
      cloud.points.emplace_back(Mandel::Zero());
    FittedModel fit = fitted(model, cloud, powder);
    complete(fit, powder);
    fits.push_back(std::move(fit));
  }
  return fits;
}

bool is_elastic(const std::string& name,
                const std::vector<std::pair<std::string, double>>& parameters, double p, double q) {
  ProbedPowder powder;
  for (const auto& [key, value] : parameters)
    if (key == "f") powder.relative_density = 1 - value;
  for (const YieldModel& model : yield_models(powder)) {
    if (model.name != name) continue;
    Values x(static_cast<Eigen::Index>(model.parameters.size()));
    for (std::size_t k = 0; k < model.parameters.size(); ++k)
      x[static_cast<Eigen::Index>(k)] = parameters[k].second;
    return model.elastic(x, Mandel(p, q, 0, 0, 0, 0));
  }
  throw std::out_of_range(name);
}

}  // namespace pulvis
