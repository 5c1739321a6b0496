#include "cli/campaigns/study/study_fit_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/csv_cell.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

Json parameters_json(const std::vector<FittedParameter>& parameters) {
  Json list = Json::array();
  for (const FittedParameter& p : parameters) {
    list.push_back({{"name", p.name}, {"unit", p.unit}, {"value", p.value}});
    if (p.low) list.back()["low"] = *p.low;
    if (p.high) list.back()["high"] = *p.high;
  }
  return list;
}

bool is_weibull(const FittedLaw& law) { return law.fit->law == StudyFit::Law::weibull; }

double parameter(const FittedGroup& group, const std::string& name) {
  return std::ranges::find(group.parameters, name, &FittedParameter::name)->value;
}

// The fitted law over the range of the points, as pages and figures draw it: columns named as in the points.
Json line_json(const FittedLaw& law, const FittedGroup& group) {
  const auto column = is_power(law)     ? &FittedPoint::key
                      : is_weibull(law) ? &FittedPoint::strength
                                        : &FittedPoint::porosity;
  const auto of = [&](const char* name) { return parameter(group, name); };
  const auto y = [&](double x) {
    if (is_power(law)) return of("value") * std::pow(x / of("at"), of("exponent"));
    if (is_weibull(law)) return 1 - std::exp(-std::pow(x / of("scale"), of("modulus")));
    return of("dense_strength") * std::exp(-of("k") * x);
  };
  const auto [first, last] = std::ranges::minmax_element(group.points, {}, column);
  const double low = (*first).*column, high = (*last).*column;
  Json xs = Json::array(), ys = Json::array();
  constexpr int pieces = 60;
  for (int i = 0; i <= pieces; ++i) {
    xs.push_back(low + (high - low) * i / pieces);
    ys.push_back(y(xs.back().get<double>()));
  }
  if (is_power(law)) return {{"key", xs}, {"value", ys}};
  if (is_weibull(law)) return {{"strength", xs}, {"failure_probability", ys}};
  return {{"porosity", xs}, {"strength", ys}};
}

Json group_json(const FittedLaw& law, const FittedGroup& group) {
  Json points = Json::array();
  for (const FittedPoint& point : group.points) {
    points.push_back(
        {{"run", point.run->name}, {is_power(law) ? "value" : "strength", point.strength}});
    if (is_power(law)) {
      points.back()["key"] = point.key;
      points.back()["local_exponent"] = point.local_exponent;
    } else if (!is_weibull(law))
      points.back()["porosity"] = point.porosity;
    else if (point.failure_probability > 0)
      points.back()["failure_probability"] = point.failure_probability;
  }
  Json json{{"name", group.name}};
  if (group.diameter) json["diameter"] = *group.diameter;
  if (!group.not_fitted.empty()) json["not_fitted"] = group.not_fitted;
  json["parameters"] = parameters_json(group.parameters);
  json["points"] = points;
  if (group.not_fitted.empty()) json["line"] = line_json(law, group);
  return json;
}

std::string number_or_nothing(const std::optional<double>& value) {
  return value ? fmt::format("{:.9g}", *value) : "";
}

std::string parameter_row(const FittedLaw& law, const std::string& group, std::size_t runs,
                          const FittedParameter& p) {
  return fmt::format("{},{},{},{},{},{},{:.9g},{},{}\n", csv_word(law.title), law.law,
                     csv_word(group), runs, p.name, p.unit, p.value, number_or_nothing(p.low),
                     number_or_nothing(p.high));
}

std::string parameters_text(const std::vector<FittedParameter>& parameters) {
  std::string text;
  for (const FittedParameter& p : parameters) {
    const double factor = p.unit == "Pa" ? 1e-6 : 1;
    if (!text.empty()) text += ", ";
    text += fmt::format("{} {:.4g}", p.name, factor * p.value);
    if (p.low && p.high)
      text += fmt::format(" ({:.4g} to {:.4g})", factor * *p.low, factor * *p.high);
    if (p.unit != "-") text += p.unit == "Pa" ? " MPa" : " " + p.unit;
  }
  return text;
}

}  // namespace

bool is_power(const FittedLaw& law) { return law.fit->law == StudyFit::Law::power; }

Json fits_json(const std::vector<FittedLaw>& laws) {
  Json list = Json::array();
  for (const FittedLaw& law : laws) {
    Json groups = Json::array();
    for (const FittedGroup& group : law.groups) groups.push_back(group_json(law, group));
    list.push_back(
        {{"title", law.title}, {"law", law.law}, {"unit", law.unit}, {"groups", groups}});
    if (!law.size_effect.empty()) list.back()["size_effect"] = parameters_json(law.size_effect);
    if (!is_power(law)) continue;
    list.back()["key"] = law.fit->key;
    list.back()["key_unit"] = law.key_unit;
    list.back()["series"] = law.fit->series;
  }
  return list;
}

std::string fits_csv(const std::vector<FittedLaw>& laws) {
  std::string text = "fit,law,group,runs,parameter,unit,value,low_90,high_90\n";
  for (const FittedLaw& law : laws) {
    std::size_t runs = 0;
    for (const FittedGroup& group : law.groups) {
      runs += group.points.size();
      for (const FittedParameter& p : group.parameters)
        text += parameter_row(law, group.name, group.points.size(), p);
    }
    for (const FittedParameter& p : law.size_effect)
      text += parameter_row(law, "all groups", runs, p);
  }
  return text;
}

std::string strengths_csv(const std::vector<FittedLaw>& laws) {
  std::string text =
      "fit,law,group,run,seed,diameter [m],porosity [-],strength,unit,failure_probability [-]\n";
  for (const FittedLaw& law : laws)
    for (const FittedGroup& group : law.groups)
      for (const FittedPoint& point : group.points) {
        if (is_power(law)) continue;
        const bool ranked = point.failure_probability > 0;
        text += fmt::format("{},{},{},{},{},{},{},{:.9g},{},{}\n", csv_word(law.title), law.law,
                            csv_word(group.name), csv_word(point.run->name), point.run->scene.seed,
                            number_or_nothing(group.diameter),
                            is_weibull(law) ? "" : fmt::format("{:.9g}", point.porosity),
                            point.strength, law.unit,
                            ranked ? fmt::format("{:.9g}", point.failure_probability) : "");
      }
  return text;
}

std::string sensitivities_csv(const std::vector<FittedLaw>& laws) {
  std::string text = "fit,group,run,key,key_value,key_unit,series,value,unit,local_exponent [-]\n";
  for (const FittedLaw& law : laws)
    for (const FittedGroup& group : law.groups)
      for (const FittedPoint& point : group.points)
        if (is_power(law))
          text += fmt::format(
              "{},{},{},{},{:.9g},{},{},{:.9g},{},{}\n", csv_word(law.title), csv_word(group.name),
              csv_word(point.run->name), csv_word(law.fit->key), point.key, law.key_unit,
              csv_word(law.fit->series), point.strength, law.unit,
              group.not_fitted.empty() ? fmt::format("{:.6g}", point.local_exponent) : "");
  return text;
}

std::string fits_text(const std::vector<FittedLaw>& laws) {
  std::string text;
  for (const FittedLaw& law : laws) {
    text += law.title + "\n";
    for (const FittedGroup& group : law.groups)
      text += fmt::format("  {}: {}\n", group.name,
                          group.not_fitted.empty() ? parameters_text(group.parameters)
                                                   : "not fitted: " + group.not_fitted);
    if (!law.size_effect.empty())
      text += fmt::format("  size effect: {}\n", parameters_text(law.size_effect));
  }
  return text;
}

}  // namespace pulvis
