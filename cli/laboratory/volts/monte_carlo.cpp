#include "cli/laboratory/volts/monte_carlo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "engine/portable_math.hpp"

namespace pulvis::volts {
namespace {

constexpr int bins = 60;
constexpr double round_off = 1e-15;  // of a share of the variance

std::vector<Quantity> quantities_of(const Outcome& outcome) {
  std::vector<Quantity> all;
  const auto add = [&](const std::string& name, const char* unit, double value) {
    Quantity quantity;
    quantity.name = name;
    quantity.unit = unit;
    quantity.value = value;
    all.push_back(quantity);
  };
  add("friction", "-", outcome.friction);
  add("friction_of_loops", "-", outcome.friction_of_loops);
  add("adhesion", "N", outcome.adhesion);
  if (outcome.adhesion_of_line) add("adhesion_of_line", "N", *outcome.adhesion_of_line);
  add("normal_sensitivity", "N/V", outcome.normal);
  add("lateral_sensitivity", "N/V", outcome.lateral);
  for (std::size_t i = 0; i < outcome.friction_of_loop.size(); ++i)
    add(fmt::format("friction_of_loop_{}", i + 1), "-", outcome.friction_of_loop[i]);
  return all;
}

std::vector<double> figures_in(const Outcome& outcome) {
  std::vector<double> all;
  for (const Quantity& quantity : quantities_of(outcome)) all.push_back(quantity.value);
  return all;
}

// Empty where a draw has no solution: a negative stiffness, loops that no friction fits.
std::optional<std::vector<double>> attempt(const Model& model, const std::vector<double>& x) {
  try {
    std::vector<double> figures = figures_in(model.evaluate(x));
    if (std::ranges::all_of(figures, [](double v) { return std::isfinite(v); })) return figures;
  } catch (const std::runtime_error&) {
  }
  return std::nullopt;
}

// Samples the inputs of one group, or of all (-1).
class Drawing {
 public:
  Drawing(const Model& model, std::uint64_t seed, int group) : model_(model) {
    for (std::size_t i = 0; i < model.inputs().size(); ++i) {
      const Input& input = model.inputs()[i];
      if (input.error == 0 || (group >= 0 && input.group != group)) continue;
      drawn_.push_back(i);
      deviates_.emplace_back(seed, i);
    }
  }
  bool empty() const { return drawn_.empty(); }
  std::vector<double> next() {
    std::vector<double> x = model_.values();
    for (std::size_t k = 0; k < drawn_.size(); ++k)
      x[drawn_[k]] += model_.inputs()[drawn_[k]].error * deviates_[k].next();
    return x;
  }

 private:
  const Model& model_;
  std::vector<std::size_t> drawn_;
  std::vector<Deviates> deviates_;
};

// By quantity: the results of all draws with a solution.
std::vector<std::vector<double>> drawn(const Model& model, std::uint64_t seed, int group,
                                       int draws) {
  std::vector<std::vector<double>> columns;
  Drawing drawing(model, seed, group);
  if (drawing.empty()) return columns;
  for (int i = 0; i < draws; ++i) {
    const auto figures = attempt(model, drawing.next());
    if (!figures) continue;
    columns.resize(figures->size());
    for (std::size_t q = 0; q < figures->size(); ++q) columns[q].push_back((*figures)[q]);
  }
  return columns;
}

double variance_of(const std::vector<double>& values, double mean) {
  double squares = 0;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return squares / static_cast<double>(values.size() - 1);
}

double mean_value(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  if (below + 1 >= sorted.size()) return sorted.back();
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[below + 1] - sorted[below]);
}

void describe(Quantity& quantity, std::vector<double> values, double confidence) {
  quantity.mean = mean_value(values);
  quantity.error = std::sqrt(variance_of(values, quantity.mean));
  std::ranges::sort(values);
  quantity.low = quantile(values, (1 - confidence) / 2);
  quantity.high = quantile(values, (1 + confidence) / 2);
  quantity.from = quantile(values, 0.001);
  quantity.until = quantile(values, 0.999);
  quantity.histogram.assign(bins, 0);
  const double wide = (quantity.until - quantity.from) / bins;
  if (!(wide > 0)) return;
  for (const double v : values) {
    const double at = std::floor((v - quantity.from) / wide);
    if (at >= 0 && at < bins) ++quantity.histogram[static_cast<std::size_t>(at)];
  }
}

// Variances by group, for every quantity, with finite-difference steps of a hundredth of each uncertainty.
void add_linear(const Model& model, std::vector<Quantity>& quantities) {
  constexpr double step = 0.01;
  for (std::size_t i = 0; i < model.inputs().size(); ++i) {
    const Input& input = model.inputs()[i];
    if (input.error == 0) continue;
    std::vector<double> up = model.values(), down = up;
    up[i] += step * input.error;
    down[i] -= step * input.error;
    const auto above = attempt(model, up), below = attempt(model, down);
    if (!above || !below) throw std::runtime_error(input.name + " is at the limit of valid values");
    for (std::size_t q = 0; q < quantities.size(); ++q) {
      const double by_error = ((*above)[q] - (*below)[q]) / (2 * step);
      quantities[q].shares[static_cast<std::size_t>(input.group)].linear += by_error * by_error;
    }
  }
  for (Quantity& quantity : quantities) {
    double variance = 0;
    for (const Share& share : quantity.shares) variance += share.linear;
    quantity.linear = std::sqrt(variance);
    for (Share& share : quantity.shares)
      share.linear = share.linear > round_off * variance ? share.linear / variance : 0;
  }
}

void add_shares(const Model& model, const DrawSpec& spec, std::vector<Quantity>& quantities) {
  for (std::size_t g = 0; g < model.groups().size(); ++g) {
    const auto columns = drawn(model, spec.seed, static_cast<int>(g), spec.draws);
    for (std::size_t q = 0; q < columns.size(); ++q) {
      const double all = quantities[q].error * quantities[q].error;
      const double share = all > 0 ? variance_of(columns[q], mean_value(columns[q])) / all : 0;
      if (share > round_off) quantities[q].shares[g].drawn = share;
    }
  }
}

}  // namespace

// Adjacent seeds and inputs are mixed: SplitMix64 from adjacent states would give one shifted sequence.
Deviates::Deviates(std::uint64_t seed, std::size_t input)
    : random_(portable::Random(portable::Random(seed).bits() + input).bits()) {}

double Deviates::next() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  const double radius = std::sqrt(-2 * portable::log(1 - random_.uniform()));
  const double angle = 2 * std::numbers::pi * random_.uniform();
  spare_ = radius * portable::sin(angle);
  has_spare_ = true;
  return radius * portable::cos(angle);
}

MonteCarlo propagate(const Model& model, const DrawSpec& spec) {
  MonteCarlo all;
  all.nominal = model.evaluate(model.values());
  all.quantities = quantities_of(all.nominal);
  for (Quantity& quantity : all.quantities) {
    quantity.shares.resize(model.groups().size());
    quantity.mean = quantity.low = quantity.high = quantity.value;
  }
  all.draws = spec.draws;
  const auto columns = drawn(model, spec.seed, -1, spec.draws);
  if (std::ranges::all_of(model.inputs(), [](const Input& input) { return input.error == 0; }))
    return all;
  all.failed = spec.draws - (columns.empty() ? 0 : static_cast<int>(columns.front().size()));
  if (all.failed > spec.draws / 100)
    throw std::runtime_error(
        fmt::format("{} of {} draws give no valid friction, allowed: at most one in a hundred; "
                    "reduce the uncertainties of the inputs",
                    all.failed, spec.draws));
  for (std::size_t q = 0; q < columns.size(); ++q)
    describe(all.quantities[q], columns[q], spec.confidence);
  add_linear(model, all.quantities);
  if (spec.shares) add_shares(model, spec, all.quantities);
  return all;
}

}  // namespace pulvis::volts
