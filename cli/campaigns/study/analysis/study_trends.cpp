#include "cli/campaigns/study/analysis/study_trends.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cli/campaigns/study/analysis/study_checks.hpp"
#include "cli/campaigns/study/analysis/study_series.hpp"
#include "scenes/checks/expect_checks.hpp"

namespace pulvis {
namespace {

using When = StudyExpect::When;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t min_neighbours = 5;
constexpr std::size_t share_of_neighbours = 20;

double passing(std::span<const double> against, std::span<const double> series, double at) {
  for (std::size_t i = 0; i < against.size(); ++i) {
    if (against[i] == at) return series[i];
    if (i + 1 == against.size() || (against[i] < at) == (against[i + 1] < at)) continue;
    const double share = (at - against[i]) / (against[i + 1] - against[i]);
    return series[i] + share * (series[i + 1] - series[i]);
  }
  return no_number;
}

// Samples from where `against` first reaches `from` to where it first passes `until`.
std::vector<double> window(const StudyQuantity& quantity, std::span<const double> against,
                           std::span<const double> series) {
  std::vector<double> inside;
  bool begun = !quantity.from;
  for (std::size_t i = 0; i < against.size(); ++i) {
    begun = begun || against[i] >= quantity.from->number;
    if (quantity.until && against[i] > quantity.until->number) break;
    if (begun && std::isfinite(series[i])) inside.push_back(series[i]);
  }
  return inside;
}

double reduced(When when, const std::vector<double>& values) {
  if (values.empty()) return no_number;
  double sum = 0;
  switch (when) {
    case When::end:
      return values.back();
    case When::max:
      return std::ranges::max(values);
    case When::min:
      return std::ranges::min(values);
    case When::mean:
      for (const double value : values) sum += value;
      return sum / static_cast<double>(values.size());
    case When::roughness:
      return roughness(values);
  }
  return no_number;
}

// Deviation of values[at] from the line fitted to values[low..high).
double off_the_line(std::span<const double> values, std::size_t low, std::size_t high,
                    std::size_t at) {
  const double count = static_cast<double>(high - low);
  const double middle = 0.5 * static_cast<double>(low + high - 1);
  double mean = 0, slope = 0, spread = 0;
  for (std::size_t i = low; i < high; ++i) mean += values[i] / count;
  for (std::size_t i = low; i < high; ++i) {
    const double x = static_cast<double>(i) - middle;
    slope += x * (values[i] - mean);
    spread += x * x;
  }
  return values[at] - mean - slope / spread * (static_cast<double>(at) - middle);
}

class Judge {
 public:
  Judge(const Study& study, const SeriesOfRun& series, const FailureOfRun& failed,
        const StudyExpect& expect)
      : study_(study), series_(series), failed_(failed), expect_(expect) {}

  Verdict verdict() {
    Verdict result{words_of(expect_), "", "", {}, false};
    if (!expect_.order.empty()) order(result);
    if (!expect_.ratio.empty()) ratio(result);
    if (!expect_.effect.empty()) effect(result);
    if (!expect_.of.empty()) one(result);
    if (!reason_.empty()) {
      result.measured = reason_;
      result.met = false;
    }
    return result;
  }

 private:
  // Mean over the seeds of a variation.
  double value(const std::string& variation) {
    double sum = 0;
    int count = 0;
    for (const StudyRun& run : study_.runs) {
      if (run.variation != variation) continue;
      const std::string failure = failed_(run);
      if (!failure.empty()) reason_ = fmt::format("no result of {}: {}", run.name, failure);
      sum += failure.empty() ? of_run(run) : no_number;
      count += 1;
    }
    return sum / count;
  }

  double of_run(const StudyRun& run) {
    const double figure =
        figure_of(expect_, series_(run, expect_.against), series_(run, expect_.series));
    if (!std::isfinite(figure) && reason_.empty())
      reason_ = fmt::format("{} has no such value: the run does not reach it", run.name);
    return figure;
  }

  std::string unit() const {
    if (expect_.when == When::roughness) return "";
    for (const SeriesInfo& info : study_series(first_run_of(study_, shown())->scene))
      if (info.name == expect_.series && info.unit != "-") return " " + info.unit;
    return "";
  }
  std::string shown() const {
    return !expect_.of.empty()      ? expect_.of
           : !expect_.order.empty() ? expect_.order.front()
           : !expect_.ratio.empty() ? expect_.ratio.front()
                                    : expect_.effect.front();
  }

  void order(Verdict& result) {
    const bool up = expect_.trend == StudyExpect::Trend::increasing;
    std::vector<std::string> names, values;
    double before = 0;
    result.met = true;
    for (std::size_t i = 0; i < expect_.order.size(); ++i) {
      const double now = value(expect_.order[i]);
      names.push_back(expect_.order[i]);
      values.push_back(fmt::format("{:.5g}", now));
      const double step = up ? now - before : before - now;
      const double needed = expect_.by * std::max(std::abs(now), std::abs(before));
      if (i > 0 && !(step > 0 && step >= needed)) result.met = false;
      before = now;
    }
    result.measured = fmt::format("{}{}", fmt::join(values, ", "), unit());
    result.allowed =
        fmt::format("{} for {}", up ? "increasing" : "decreasing", fmt::join(names, ", "));
    if (expect_.by > 0) result.allowed += fmt::format(", by at least {:g} %", 100 * expect_.by);
  }

  void ratio(Verdict& result) {
    const double first = value(expect_.ratio[0]), second = value(expect_.ratio[1]);
    result.what += fmt::format(", {} over {}", expect_.ratio[0], expect_.ratio[1]);
    judge_bounds(result, expect_, first / second, "");
    result.measured = fmt::format("{:.5g} / {:.5g} = {:.5g}", first, second, first / second);
  }

  void one(Verdict& result) {
    const double found = value(expect_.of);
    result.what += ", of " + expect_.of;
    judge_bounds(result, expect_, found, unit());
    result.measured = fmt::format("{:.5g}{}", found, unit());
  }

  void effect(Verdict& result) {
    const auto change = [&](const std::vector<std::string>& pair) {
      return value(pair[1]) - value(pair[0]);
    };
    const double here = change(expect_.effect), there = change(expect_.exceeds);
    result.value = std::abs(here / there);
    result.met = std::abs(here) > expect_.factor * std::abs(there);
    result.measured = fmt::format("{:+.5g} against {:+.5g}{}", here, there, unit());
    result.allowed = fmt::format(
        "the change from {} to {} is larger than {}that from {} to {}", expect_.effect[0],
        expect_.effect[1], expect_.factor == 1 ? "" : fmt::format("{:g} times ", expect_.factor),
        expect_.exceeds[0], expect_.exceeds[1]);
  }

  const Study& study_;
  const SeriesOfRun& series_;
  const FailureOfRun& failed_;
  const StudyExpect& expect_;
  std::string reason_;
};

}  // namespace

void judge_bounds(Verdict& result, const StudyBounds& bounds, double value,
                  const std::string& unit) {
  result.value = value;
  if (bounds.equals) {
    const double wanted = bounds.equals->number;
    result.allowed = fmt::format("{:.5g}{} within {:g}{}", wanted, unit, *bounds.within,
                                 wanted == 0 ? unit : " of it");
    result.met = std::abs(value - wanted) <= *bounds.within * (wanted == 0 ? 1 : std::abs(wanted));
    return;
  }
  std::vector<std::string> said;
  if (bounds.above) said.push_back(fmt::format("at least {:.5g}{}", bounds.above->number, unit));
  if (bounds.below) said.push_back(fmt::format("at most {:.5g}{}", bounds.below->number, unit));
  result.allowed = fmt::format("{}", fmt::join(said, ", "));
  result.met = (!bounds.above || value >= bounds.above->number) &&
               (!bounds.below || value <= bounds.below->number);
}

std::string words_of(const StudyQuantity& quantity) {
  static constexpr const char* words[] = {"at the end", "largest", "smallest", "mean", "roughness"};
  std::string text = quantity.series;
  if (!quantity.at && is_figure_of_a_run(quantity.series)) return text;
  if (quantity.at)
    return text + fmt::format(" at {} = {:g}", quantity.against, quantity.at->number);
  text += fmt::format(", {}", words[static_cast<int>(quantity.when.value_or(When::end))]);
  if (quantity.from)
    text += fmt::format(", from {} = {:g}", quantity.against, quantity.from->number);
  if (quantity.until)
    text += fmt::format(", until {} = {:g}", quantity.against, quantity.until->number);
  return text;
}

double roughness(std::span<const double> values) {
  const std::size_t count = values.size();
  const std::size_t near = std::max(min_neighbours, count / share_of_neighbours);
  if (count < near) return no_number;
  const auto [low, high] = std::ranges::minmax(values);
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t first = std::min(i - std::min(i, near / 2), count - near);
    const double off = off_the_line(values, first, first + near, i);
    sum += off * off;
  }
  return high > low ? std::sqrt(sum / static_cast<double>(count)) / (high - low) : 0;
}

double figure_of(const StudyQuantity& quantity, std::span<const double> against,
                 std::span<const double> series) {
  const bool whole = !quantity.at && quantity.when != When::roughness;
  if (series.size() == 1 && against.size() != 1 && whole) return series[0];  // one value per run
  if (series.empty() || against.size() != series.size()) return no_number;
  if (quantity.at) return passing(against, series, quantity.at->number);
  return reduced(quantity.when.value_or(When::end), window(quantity, against, series));
}

std::vector<Verdict> judge_study(const Study& study, const SeriesOfRun& series,
                                 const FailureOfRun& failed) {
  std::vector<Verdict> verdicts;
  for (const StudyExpect& expect : study.spec.expects)
    verdicts.push_back(Judge(study, series, failed, expect).verdict());
  return verdicts;
}

}  // namespace pulvis
