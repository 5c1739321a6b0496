#include "cli/campaigns/study/analysis/study_fits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <variant>

#include "cli/campaigns/study/analysis/study_porosity.hpp"
#include "cli/campaigns/study/analysis/study_power.hpp"
#include "cli/campaigns/study/analysis/study_series.hpp"
#include "cli/campaigns/study/analysis/study_weibull.hpp"

namespace pulvis {
namespace {

using Law = StudyFit::Law;

// The values that `run` gives to the keys of `by`; the last setting wins.
std::string group_name(const StudyRun& run, const std::vector<std::string>& by) {
  std::vector<std::string> parts;
  for (const std::string& key : by) {
    std::string part = key + " of the scene";
    for (auto setting = run.varied.rbegin(); setting != run.varied.rend(); ++setting)
      if (setting->path == key) {
        part = setting->text();
        break;
      }
    parts.push_back(part);
  }
  return by.empty() ? "all runs" : fmt::format("{}", fmt::join(parts, ","));
}

// What distinguishes the run from the others, apart from `key`.
std::string group_without(const Study& study, const StudyRun& run, const std::string& key) {
  std::vector<std::string> parts;
  const auto other = [&](const StudyRun& one) { return one.file != run.file; };
  if (std::ranges::any_of(study.runs, other)) parts.push_back(run.file.stem().string());
  for (std::size_t i = 0; i < run.varied.size(); ++i) {
    const std::string& path = run.varied[i].path;
    const auto same = [&](const StudySetting& later) { return later.path == path; };
    const auto rest = run.varied.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    if (path != key && std::none_of(rest, run.varied.end(), same))
      parts.push_back(run.varied[i].text());
  }
  return parts.empty() ? "all runs" : fmt::format("{}", fmt::join(parts, ","));
}

constexpr std::array law_words{"weibull", "ryshkewitch_duckworth", "power"};
constexpr std::array law_titles{"Weibull's law", "Ryshkewitch and Duckworth", "Power law"};

std::string unit_of_series(const Scene& scene, const std::string& name) {
  for (const SeriesInfo& info : study_series(scene))
    if (info.name == name) return info.unit;
  return "-";
}

// m^2, by which the force is divided to give a strength; 1 if the number is the strength.
double area_of(const StudyFit& fit, const Scene& scene) {
  if (fit.area) return *fit.area;
  if (fit.disc.empty()) return 1;
  return 0.5 * std::numbers::pi * disc_diameter(scene, fit.disc).value() * scene.thickness;
}

std::vector<double> strengths_of(const FittedGroup& group) {
  std::vector<double> strengths;
  for (const FittedPoint& point : group.points) strengths.push_back(point.strength);
  return strengths;
}

FittedParameter with_limits(const char* name, const std::string& unit, const Estimate& estimate) {
  return {name, unit, estimate.value, estimate.low, estimate.high};
}

class StudyFitter {
 public:
  StudyFitter(const Study& study, const SeriesOfRun& series, const FailureOfRun& failed,
              const StudyFit& fit)
      : study_(study), series_(series), failed_(failed), fit_(fit) {}

  FittedLaw fitted() {
    const bool weibull = fit_.law == Law::weibull, power = fit_.law == Law::power;
    const auto which = static_cast<std::size_t>(fit_.law);
    FittedLaw law;
    law.fit = &fit_;
    law.law = law_words[which];
    if (power) law.key_unit = unit_of_varied(study_.runs, fit_.key);
    const bool over_area = fit_.area || !fit_.disc.empty();
    law.unit = over_area ? "Pa" : unit_of_series(study_.runs.front().scene, fit_.series);
    law.title =
        !fit_.title.empty() ? fit_.title : fmt::format("{}: {}", law_titles[which], words_of(fit_));
    if (power && fit_.title.empty()) law.title += " against " + fit_.key;
    for (const FitRuns& runs : groups_of(study_, fit_)) {
      FittedGroup group = measured(runs);
      if (group.not_fitted.empty())
        weibull ? weibull_of(group, law.unit)
        : power ? power_of(group, law)
                : porosity_of(group, law.unit);
      law.groups.push_back(std::move(group));
    }
    if (weibull && !fit_.disc.empty()) size_effect(law);
    return law;
  }

 private:
  bool power() const { return fit_.law == Law::power; }

  FittedGroup measured(const FitRuns& runs) const {
    FittedGroup group;
    group.name = runs.name;
    for (const StudyRun* run : runs.runs) {
      const std::string failure = failed_(*run);
      const FittedPoint point = failure.empty() ? point_of(*run) : FittedPoint{};
      if (!failure.empty())
        group.not_fitted = fmt::format("no result of {}: {}", run->name, failure);
      else if (!std::isfinite(point.strength))
        group.not_fitted =
            fmt::format("{} has no such value: the run does not reach it", run->name);
      else if (!(point.strength > 0))
        group.not_fitted = fmt::format(
            "{:.4g} of {} {}: only numbers above 0 {}", point.strength, run->name,
            power() ? "has no power law" : "is not a strength", power() ? "have" : "are");
      else
        group.points.push_back(point);
    }
    return group;
  }

  FittedPoint point_of(const StudyRun& run) const {
    FittedPoint point;
    point.run = &run;
    point.strength = figure_of(fit_, series_(run, fit_.against), series_(run, fit_.series)) /
                     area_of(fit_, run.scene);
    if (fit_.law == Law::weibull) return point;
    if (power()) {
      point.key = number_of_key(run, fit_.key).value();
      return point;
    }
    double density = 0;
    for (const double value : series_(run, fit_.density))
      if (value > density) density = value;
    point.porosity = 1 - density;
    return point;
  }

  void weibull_of(FittedGroup& group, const std::string& unit) const {
    std::ranges::stable_sort(group.points, {}, &FittedPoint::strength);
    for (std::size_t i = 0; i < group.points.size(); ++i)
      group.points[i].failure_probability = failure_probability(i, group.points.size());
    std::set<double> diameters;
    for (const FittedPoint& point : group.points)
      if (const auto diameter = disc_diameter(point.run->scene, fit_.disc))
        diameters.insert(*diameter);
    if (diameters.size() == 1) group.diameter = *diameters.begin();
    if (group.points.front().strength == group.points.back().strength) {
      group.not_fitted = "all strengths are equal";
      return;
    }
    const WeibullFit found = fit_weibull({strengths_of(group)});
    group.parameters = {with_limits("modulus", "-", found.modulus),
                        {"unbiased_modulus", "-", found.unbiased_modulus, {}, {}},
                        with_limits("scale", unit, found.scales.front())};
  }

  void porosity_of(FittedGroup& group, const std::string& unit) const {
    std::ranges::stable_sort(group.points, {}, &FittedPoint::porosity);
    std::vector<double> porosity;
    for (const FittedPoint& point : group.points) porosity.push_back(point.porosity);
    if (porosity.front() == porosity.back()) {
      group.not_fitted = "all porosities are equal";
      return;
    }
    const PorosityFit found = fit_porosity(porosity, strengths_of(group));
    group.parameters = {{"dense_strength", unit, found.dense_strength, {}, {}},
                        {"k", "-", found.k, {}, {}},
                        {"r_squared", "-", found.r_squared, {}, {}}};
  }

  void power_of(FittedGroup& group, const FittedLaw& law) const {
    std::ranges::stable_sort(group.points, {}, &FittedPoint::key);
    std::vector<double> key;
    for (const FittedPoint& point : group.points) key.push_back(point.key);
    const std::vector<double> values = strengths_of(group);
    const PowerFit found = fit_power(key, values);
    const std::vector<double> local = local_exponents(key, values);
    for (std::size_t i = 0; i < local.size(); ++i) group.points[i].local_exponent = local[i];
    group.parameters = {{"exponent", "-", found.exponent, {}, {}},
                        {"value", law.unit, found.value, {}, {}},
                        {"at", law.key_unit, found.middle, {}, {}}};
    if (std::isfinite(found.r_squared))
      group.parameters.push_back({"r_squared", "-", found.r_squared, {}, {}});
  }

  void size_effect(FittedLaw& law) const {
    std::vector<std::vector<double>> samples;
    std::vector<double> diameters;
    for (const FittedGroup& group : law.groups) {
      if (!group.not_fitted.empty() || !group.diameter) return;
      samples.push_back(strengths_of(group));
      diameters.push_back(*group.diameter);
    }
    if (std::ranges::min(diameters) == std::ranges::max(diameters)) return;
    const WeibullFit found = fit_weibull(samples, default_draws, diameters);
    const Estimate& modulus = found.modulus;
    law.size_effect = {
        with_limits("common_modulus", "-", modulus),
        {"weakest_link_exponent", "-", -2 / modulus.value, -2 / modulus.low, -2 / modulus.high},
        with_limits("exponent", "-", found.exponent)};
  }

  const Study& study_;
  const SeriesOfRun& series_;
  const FailureOfRun& failed_;
  const StudyFit& fit_;
};

}  // namespace

std::vector<FitRuns> groups_of(const Study& study, const StudyFit& fit) {
  std::vector<FitRuns> groups;
  for (const StudyRun& run : study.runs) {
    if (fit.law == Law::power && !sets_key(run, fit.key)) continue;
    const std::string name = fit.law == Law::weibull ? run.variation
                             : fit.law == Law::power ? group_without(study, run, fit.key)
                                                     : group_name(run, fit.by);
    auto group = std::ranges::find(groups, name, &FitRuns::name);
    if (group == groups.end()) group = groups.insert(groups.end(), {name, {}});
    group->runs.push_back(&run);
  }
  return groups;
}

std::size_t fewest_runs(Law law) { return law == Law::weibull ? 5 : law == Law::power ? 2 : 3; }

std::optional<double> disc_diameter(const Scene& scene, const std::string& particle) {
  const auto found = std::ranges::find(scene.particles, particle, &ParticleSpec::name);
  if (found == scene.particles.end()) return std::nullopt;
  const auto* disc = std::get_if<DiscOutline>(&found->outline);
  return disc == nullptr || disc->diameter == 0 ? std::nullopt : std::optional(disc->diameter);
}

std::vector<FittedLaw> fit_study(const Study& study, const SeriesOfRun& series,
                                 const FailureOfRun& failed) {
  std::vector<FittedLaw> laws;
  for (const StudyFit& fit : study.spec.fits)
    laws.push_back(StudyFitter(study, series, failed, fit).fitted());
  return laws;
}

std::vector<Verdict> judge_fits(const std::vector<FittedLaw>& laws) {
  std::vector<Verdict> verdicts;
  for (const FittedLaw& law : laws) {
    const StudyFit& fit = *law.fit;
    if (!fit.above && !fit.below && !fit.equals) continue;
    for (const FittedGroup& group : law.groups) {
      Verdict verdict;
      verdict.what =
          fmt::format("exponent of {} against {}, of {}", words_of(fit), fit.key, group.name);
      const double exponent = group.not_fitted.empty() ? group.parameters.front().value : 0;
      judge_bounds(verdict, fit, exponent, "");
      verdict.measured = fmt::format("{:.5g}", exponent);
      if (!group.not_fitted.empty()) {
        verdict.value.reset();
        verdict.measured = group.not_fitted;
        verdict.met = false;
      }
      verdicts.push_back(verdict);
    }
  }
  return verdicts;
}

}  // namespace pulvis
