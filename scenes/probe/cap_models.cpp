#include "scenes/probe/cap_models.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <unsupported/Eigen/LevenbergMarquardt>
#include <unsupported/Eigen/NumericalDiff>

namespace pulvis {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double transition = cap_transition;
constexpr double open = 0.1;  // of the largest pressure in the plane
using Values = Eigen::VectorXd;

struct Model {
  const char* name;
  std::vector<const char*> parameters;
  bool in_plane;
  // Parameters at the start, all > 0; of the largest pressure and shear.
  std::function<Values(double p, double q)> start;
  std::function<bool(const Values& x, double p, double q)> elastic;
};

// Abaqus Theory Guide, modified Drucker-Prager/Cap: shear failure q = d + p tan(beta); cap an ellipse about p_a of radius
// R (d + p_a tan(beta)); between them an arc.
bool in_cap(const Values& x, double p, double q) {
  const double d = x[0], slope = std::tan(x[1]), r = x[2], p_b = x[3];
  const double p_a = std::max((p_b - r * d) / (1 + r * slope), -d / slope);
  const double strength = d + p_a * slope, cosine = std::cos(x[1]);
  if (p >= p_a) {
    const double scaled = r * q / (1 + transition - transition / cosine);
    return std::hypot(p - p_a, scaled) <= r * strength;
  }
  if (q > d + p * slope) return false;
  const double foot = (1 - transition / cosine) * strength;
  const bool below_the_arc = p_a - p > transition * std::sin(x[1]) * strength || q <= foot;
  return below_the_arc || std::hypot(p - p_a, q - foot) <= transition * strength;
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
  return shear * shear + 2 * f * std::cosh(1.5 * p / x[0]) <= 1 + f * f;
}

// Contacts over all directions, those that close bear c: sigma = c int n n over them. With closing ones within theta of the
// axis, p = c theta and tau = c/2 sin(2 theta).
bool in_fleck_plane(const Values& x, double p, double tau) {
  return p >= 0 && p <= x[0] && tau <= x[0] / pi * std::sin(pi * p / x[0]);
}
// The others bear -c.
bool in_fleck_plane_cohesive(const Values& x, double p, double tau) {
  return std::abs(p) <= x[0] && tau <= 2 * x[0] / pi * std::cos(0.5 * pi * p / x[0]);
}

std::vector<Model> models(double density) {
  const double f = std::max(1 - density, 1e-6);
  return {{"drucker_prager_cap",
           {"d", "beta", "R", "p_b"},
           false,
           [](double p, double q) {
             Values x(4);
             x << 0.1 * q, std::atan(q / (0.6 * p)), 0.6, p;
             return x;
           },
           in_cap},
          {"modified_cam_clay",
           {"M", "p_c"},
           false,
           [](double p, double q) {
             Values x(2);
             x << 2 * q / p, p;
             return x;
           },
           in_cam_clay},
          {"fleck_kuhn_mcmeeking",
           {"p_y"},
           false,
           [](double p, double) { return Values::Constant(1, p).eval(); },
           in_fleck_kuhn_mcmeeking},
          {"gurson",
           {"sigma_y"},
           false,
           [f](double p, double q) {
             const double limit = 2.0 / 3 * std::acosh((1 + f * f) / (2 * f));
             return Values::Constant(1, std::max(q, p / limit)).eval();
           },
           [f](const Values& x, double p, double q) { return in_gurson(x, f, p, q); }},
          {"fleck_plane",
           {"p_y"},
           true,
           [](double p, double) { return Values::Constant(1, p).eval(); },
           in_fleck_plane},
          {"fleck_plane_cohesive",
           {"p_y"},
           true,
           [](double p, double) { return Values::Constant(1, p).eval(); },
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

// Residuals over the logarithms of the parameters, which keeps them above 0.
struct Misfit : Eigen::DenseFunctor<double> {
  const Model& model;
  const std::vector<Plane>& points;
  double centre, scale;
  Misfit(const Model& m, const std::vector<Plane>& all, double c, double s, int parameters)
      : DenseFunctor(parameters, static_cast<int>(all.size())),
        model(m),
        points(all),
        centre(c),
        scale(s) {}
  int operator()(const Values& logarithms, Values& residuals) const {
    const Values x = logarithms.array().exp();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double dp = points[i].p - centre, q = points[i].q, away = std::hypot(dp, q);
      residuals[static_cast<Eigen::Index>(i)] =
          (radius(model, x, centre, dp / away, q / away) - away) / scale;
    }
    return 0;
  }
};

FittedModel fitted(const Model& model, const std::vector<Plane>& points) {
  double p_max = 0, q_max = 0;
  for (const Plane& point : points) {
    p_max = std::max(p_max, point.p);
    q_max = std::max(q_max, point.q);
  }
  const double centre = 0.5 * p_max;
  Values x = model.start(p_max, std::max(q_max, 1e-3 * p_max)).array().log();
  const Misfit misfit(model, points, centre, p_max, static_cast<int>(x.size()));
  Eigen::NumericalDiff<Misfit> differences(misfit, 1e-10);
  Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Misfit>> search(differences);
  search.setMaxfev(2000);
  if (points.size() >= static_cast<std::size_t>(x.size())) search.minimize(x);
  Values residuals(static_cast<Eigen::Index>(points.size()));
  misfit(x, residuals);

  FittedModel fit;
  fit.name = model.name;
  fit.in_plane = model.in_plane;
  const Values values = x.array().exp();
  for (std::size_t k = 0; k < model.parameters.size(); ++k)
    fit.parameters.emplace_back(model.parameters[k], values[static_cast<Eigen::Index>(k)]);
  fit.misfit = std::sqrt(residuals.squaredNorm() / static_cast<double>(points.size()));
  constexpr int steps = 90;
  for (int i = 0; i <= steps; ++i) {
    const double angle = pi * i / steps, c = std::cos(angle), s = std::sin(angle);
    const double r = radius(model, values, centre, c, s);
    fit.surface.emplace_back(centre + r * c, r * s);
  }
  return fit;
}

}  // namespace

double FittedModel::parameter(const std::string& of) const {
  for (const auto& [key, value] : parameters)
    if (key == of) return value;
  throw std::out_of_range(of);
}

std::vector<FittedModel> fit_caps(const std::vector<YieldPoint>& points, double relative_density) {
  std::vector<Plane> all, in_plane;
  double largest = 0;
  for (const YieldPoint& point : points) largest = std::max(largest, point.plane_pressure());
  for (const YieldPoint& point : points) {
    if (point.plane_pressure() < open * largest) continue;
    all.push_back({point.pressure(), std::abs(point.deviatoric())});
    in_plane.push_back({point.plane_pressure(), std::abs(point.plane_shear())});
  }
  std::vector<FittedModel> fits;
  if (all.size() < 5) return fits;
  for (const Model& model : models(relative_density)) {
    FittedModel fit = fitted(model, model.in_plane ? in_plane : all);
    if (fit.name == "drucker_prager_cap") {
      const double slope = std::tan(fit.parameter("beta")), r = fit.parameter("R");
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
