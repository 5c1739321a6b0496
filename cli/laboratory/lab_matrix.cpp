#include "cli/laboratory/lab_matrix.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "scenes/solve/least_squares.hpp"

namespace pulvis::lab {
namespace {

// The level of a run as text, and the number that it is sorted by.
struct Level {
  double order = 0;
  std::string text;
};
using LevelOf = std::function<std::optional<Level>(const RunSpec&)>;

LevelOf quantity_level(std::optional<double> RunSpec::*member, double factor, const char* unit) {
  return [=](const RunSpec& run) -> std::optional<Level> {
    const std::optional<double>& value = run.*member;
    if (!value) return std::nullopt;
    return Level{*value, fmt::format("{:.6g} {}", *value * factor, unit)};
  };
}

std::vector<std::pair<std::string, LevelOf>> known_factors() {
  return {{"load", quantity_level(&RunSpec::load, 1, "N")},
          {"roughness", quantity_level(&RunSpec::roughness, 1e6, "um")},
          {"direction",
           [](const RunSpec& run) -> std::optional<Level> {
             if (run.direction.empty()) return std::nullopt;
             return Level{0, run.direction};
           }},
          {"speed", quantity_level(&RunSpec::speed, 1e3, "mm/s")},
          {"powder", [](const RunSpec& run) -> std::optional<Level> {
             if (!run.powder) return std::nullopt;
             return Level{static_cast<double>(*run.powder), powder_name(*run.powder)};
           }}};
}

std::size_t position_of(std::vector<Level>& levels, const Level& level) {
  const auto found = std::ranges::find(levels, level.text, &Level::text);
  if (found != levels.end()) return static_cast<std::size_t>(found - levels.begin());
  levels.push_back(level);
  return levels.size() - 1;
}

Factor factor_of(const std::string& name, const LevelOf& level_of,
                 const std::vector<RunSpec>& runs) {
  std::vector<Level> levels;
  for (const RunSpec& run : runs)
    if (const auto level = level_of(run)) position_of(levels, *level);
  std::ranges::stable_sort(levels, {}, &Level::order);
  Factor factor{name, {}, {}};
  for (const Level& level : levels) factor.levels.push_back(level.text);
  for (const RunSpec& run : runs)
    if (const auto level = level_of(run)) factor.of_run.push_back(position_of(levels, *level));
  return factor;
}

// Effect coding: a factor of n levels has n - 1 columns; the last level is minus their sum.
struct Design {
  Eigen::MatrixXd matrix;              // runs, columns
  std::vector<const Factor*> factors;  // those with more than one level
  std::vector<Eigen::Index> begin;     // the first column of each
};

Design design_of(const std::vector<Factor>& factors, std::size_t runs) {
  Design design;
  Eigen::Index columns = 1;
  for (const Factor& factor : factors) {
    if (factor.levels.size() < 2) continue;
    design.factors.push_back(&factor);
    design.begin.push_back(columns);
    columns += static_cast<Eigen::Index>(factor.levels.size()) - 1;
  }
  design.matrix = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(runs), columns);
  design.matrix.col(0).setOnes();
  for (std::size_t f = 0; f < design.factors.size(); ++f) {
    const auto last = static_cast<Eigen::Index>(design.factors[f]->levels.size()) - 1;
    for (std::size_t run = 0; run < runs; ++run) {
      const auto row = static_cast<Eigen::Index>(run);
      const auto level = static_cast<Eigen::Index>(design.factors[f]->of_run[run]);
      if (level == last)
        design.matrix.block(row, design.begin[f], 1, last).setConstant(-1);
      else
        design.matrix(row, design.begin[f] + level) = 1;
    }
  }
  return design;
}

double residual_of(const Eigen::MatrixXd& design, const Eigen::VectorXd& y) {
  if (design.cols() == 0) return y.squaredNorm();
  const Eigen::VectorXd fit = design * least_squares(design, y);
  return (y - fit).squaredNorm();
}

struct PureError {
  double squares = 0;
  int freedom = 0;
};
PureError pure_error(const std::vector<Condition>& conditions, const std::vector<double>& values) {
  PureError error;
  for (const Condition& condition : conditions) {
    double mean = 0;
    for (const std::size_t run : condition.runs)
      mean += values[run] / static_cast<double>(condition.runs.size());
    for (const std::size_t run : condition.runs)
      error.squares += (values[run] - mean) * (values[run] - mean);
    error.freedom += static_cast<int>(condition.runs.size()) - 1;
  }
  return error;
}

FactorTest test_of(const std::string& factor, double squares, int freedom, const Effects& found) {
  const double f = squares / freedom / (found.deviation * found.deviation);
  const boost::math::fisher_f distribution(freedom, found.freedom);
  return {factor, f, freedom, boost::math::cdf(boost::math::complement(distribution, f))};
}

class EffectsFinder {
 public:
  EffectsFinder(const std::vector<Factor>& factors, const std::vector<Condition>& conditions,
                const std::vector<double>& values, double confidence)
      : conditions_(conditions),
        design_(design_of(factors, values.size())),
        y_(Eigen::Map<const Eigen::VectorXd>(values.data(),
                                             static_cast<Eigen::Index>(values.size()))),
        pure_(pure_error(conditions, values)),
        confidence_(confidence) {}

  Effects found() {
    const Eigen::MatrixXd& x = design_.matrix;
    if (design_.factors.empty()) return refused("all runs have the same condition");
    if (rank_of(x) < x.cols())
      return refused(
          "levels of different factors always change together: their effects cannot be separated");
    residual_ = residual_of(x, y_);
    const auto left = static_cast<int>(x.rows() - x.cols());
    result_.is_pure_error = pure_.freedom > 0;
    result_.freedom = result_.is_pure_error ? pure_.freedom : left;
    const double squares = result_.is_pure_error ? pure_.squares : residual_;
    if (result_.freedom > 0) result_.deviation = std::sqrt(squares / result_.freedom);
    covariance_ = (x.transpose() * x).inverse();
    const Eigen::VectorXd b = least_squares(x, y_);
    result_.mean = b[0];
    result_.mean_half_width = half_width(covariance_(0, 0));
    for (std::size_t f = 0; f < design_.factors.size(); ++f) add_factor(f, b);
    add_interactions();
    return result_;
  }

 private:
  Effects refused(const std::string& why) {
    result_.not_found = why;
    return result_;
  }

  std::optional<double> half_width(double variance) const {
    if (result_.freedom < 1) return std::nullopt;
    return student_quantile(confidence_, result_.freedom) * result_.deviation * std::sqrt(variance);
  }

  void add_factor(std::size_t f, const Eigen::VectorXd& b) {
    const Factor& factor = *design_.factors[f];
    const Eigen::Index begin = design_.begin[f];
    const auto last = static_cast<Eigen::Index>(factor.levels.size()) - 1;
    for (Eigen::Index level = 0; level <= last; ++level) {
      Eigen::VectorXd weight = Eigen::VectorXd::Zero(b.size());
      if (level == last)
        weight.segment(begin, last).setConstant(-1);
      else
        weight[begin + level] = 1;
      result_.effects.push_back({factor.name, factor.levels[static_cast<std::size_t>(level)],
                                 weight.dot(b), half_width(weight.dot(covariance_ * weight))});
    }
    if (!(result_.deviation > 0)) return;
    const Eigen::MatrixXd& x = design_.matrix;
    Eigen::MatrixXd without(x.rows(), x.cols() - last);
    without << x.leftCols(begin), x.rightCols(x.cols() - begin - last);
    result_.tests.push_back(test_of(factor.name, residual_of(without, y_) - residual_,
                                    static_cast<int>(last), result_));
  }

  // Deviation of the condition means from the sum of the effects, tested against the scatter of repeated runs.
  void add_interactions() {
    const int freedom =
        static_cast<int>(conditions_.size()) - static_cast<int>(design_.matrix.cols());
    if (!result_.is_pure_error || freedom < 1 || !(result_.deviation > 0)) return;
    result_.tests.push_back(
        test_of("interactions", std::max(0.0, residual_ - pure_.squares), freedom, result_));
  }

  const std::vector<Condition>& conditions_;
  Design design_;
  Eigen::VectorXd y_;
  PureError pure_;
  double confidence_;
  double residual_ = 0;
  Eigen::MatrixXd covariance_;
  Effects result_;
};

}  // namespace

std::vector<Factor> factors_of(const std::vector<RunSpec>& runs) {
  std::vector<Factor> factors;
  for (const auto& [name, level_of] : known_factors()) {
    Factor factor = factor_of(name, level_of, runs);
    if (!factor.of_run.empty()) factors.push_back(std::move(factor));
  }
  return factors;
}

std::vector<Condition> conditions_of(const std::vector<Factor>& factors) {
  std::map<std::vector<std::size_t>, std::vector<std::size_t>> by_levels;
  for (std::size_t run = 0; run < factors.front().of_run.size(); ++run) {
    std::vector<std::size_t> levels;
    for (const Factor& factor : factors) levels.push_back(factor.of_run[run]);
    by_levels[levels].push_back(run);
  }
  std::vector<Condition> conditions;
  for (const auto& [levels, runs] : by_levels) conditions.push_back({levels, runs});
  return conditions;
}

Effects effects_of(const std::vector<Factor>& factors, const std::vector<Condition>& conditions,
                   const std::vector<double>& values, double confidence) {
  return EffectsFinder(factors, conditions, values, confidence).found();
}

}  // namespace pulvis::lab
