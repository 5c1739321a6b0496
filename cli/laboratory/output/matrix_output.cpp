#include "cli/laboratory/output/matrix_output.hpp"

#include <fmt/format.h>

#include "cli/csv_cell.hpp"
#include "cli/laboratory/lab_matrix.hpp"
#include "scenes/language/counted.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

struct Response {
  const char* name;
  std::vector<double> values;  // one per run
  lab::Effects effects;
};

struct Matrix {
  const Reduction& all;
  std::vector<lab::Factor> factors;
  std::vector<lab::Condition> conditions;
  std::vector<Response> responses;
  double confidence = 0;

  std::string level(const lab::Condition& condition, std::size_t factor) const {
    return factors[factor].levels[condition.levels[factor]];
  }
  std::string label(const lab::Condition& condition) const {
    std::string text;
    for (std::size_t f = 0; f < factors.size(); ++f)
      if (factors[f].levels.size() > 1) text += (text.empty() ? "" : ", ") + level(condition, f);
    return text.empty() ? "all runs" : text;
  }
  lab::Sample sample(const lab::Condition& condition, const Response& response) const {
    std::vector<double> values;
    for (const std::size_t run : condition.runs) values.push_back(response.values[run]);
    return lab::sample_of(values);
  }
};

Matrix matrix_of(const Reduction& all) {
  Matrix matrix{all, lab::factors_of(all.specs), {}, {}, all.loaded.settings.analysis.confidence};
  matrix.conditions = lab::conditions_of(matrix.factors);
  matrix.responses = {{"static", {}, {}}, {"dynamic", {}, {}}};
  for (const lab::ReducedRun& run : all.runs) {
    matrix.responses[0].values.push_back(run.peak.value);
    matrix.responses[1].values.push_back(run.dynamic.mean);
  }
  for (Response& response : matrix.responses)
    response.effects =
        lab::effects_of(matrix.factors, matrix.conditions, response.values, matrix.confidence);
  return matrix;
}

// Half-width from the number of the condition's runs and the pooled scatter of all conditions.
std::optional<double> pooled_half_width(const Matrix& m, const lab::Effects& e, std::size_t runs) {
  if (!e.not_found.empty() || e.freedom < 1) return std::nullopt;
  return lab::student_quantile(m.confidence, e.freedom) * e.deviation /
         std::sqrt(static_cast<double>(runs));
}

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.6g}", *value) : "";
}

std::string conditions_csv(const Matrix& m) {
  std::string text;
  for (const lab::Factor& factor : m.factors) text += factor.name + ",";
  text += "runs [-]";
  for (const Response& r : m.responses)
    text += fmt::format(",{0} [-],{0}_deviation [-],{0}_half_width [-],{0}_pooled_half_width [-]",
                        r.name);
  for (const lab::Condition& condition : m.conditions) {
    text += "\n";
    for (std::size_t f = 0; f < m.factors.size(); ++f)
      text += csv_word(m.level(condition, f)) + ",";
    text += std::to_string(condition.runs.size());
    for (const Response& r : m.responses) {
      const lab::Sample sample = m.sample(condition, r);
      const bool several = sample.count > 1;
      text += fmt::format(",{:.6g},{},{},{}", sample.mean,
                          number(several ? std::optional(sample.deviation) : std::nullopt),
                          number(lab::half_width(sample, m.confidence)),
                          number(pooled_half_width(m, r.effects, sample.count)));
    }
  }
  return text + "\n";
}

std::string effects_csv(const Matrix& m) {
  std::string text = "response,factor,level,effect [-],half_width [-],F [-],probability [-]\n";
  for (const Response& r : m.responses) {
    for (const lab::Effect& effect : r.effects.effects)
      text += fmt::format("{},{},{},{:.6g},{},,\n", r.name, effect.factor, csv_word(effect.level),
                          effect.value, number(effect.half_width));
    for (const lab::FactorTest& test : r.effects.tests)
      text +=
          fmt::format("{},{},,,,{:.4g},{:.3g}\n", r.name, test.factor, test.f, test.probability);
  }
  return text;
}

Json effects_json(const lab::Effects& e) {
  if (!e.not_found.empty()) return {{"not_found", e.not_found}};
  Json json{{"mean", e.mean},
            {"deviation_of_a_run", e.deviation},
            {"degrees_of_freedom", e.freedom},
            {"deviation_is_of", e.is_pure_error ? "repeated runs" : "residuals of the model"}};
  if (e.mean_half_width) json["mean_half_width"] = *e.mean_half_width;
  for (const lab::Effect& effect : e.effects) {
    Json one{{"factor", effect.factor}, {"level", effect.level}, {"effect", effect.value}};
    if (effect.half_width) one["half_width"] = *effect.half_width;
    json["effects"].push_back(one);
  }
  for (const lab::FactorTest& test : e.tests)
    json["tests"].push_back({{"factor", test.factor},
                             {"F", test.f},
                             {"degrees_of_freedom", test.freedom},
                             {"probability", test.probability}});
  return json;
}

Json matrix_json(const Matrix& m) {
  Json json{{"kind", "matrix"}, {"confidence", m.confidence}};
  for (const lab::Condition& condition : m.conditions) {
    Json one;
    for (std::size_t f = 0; f < m.factors.size(); ++f)
      one[m.factors[f].name] = m.level(condition, f);
    one["runs"] = condition.runs.size();
    for (const Response& r : m.responses) {
      const lab::Sample sample = m.sample(condition, r);
      one[r.name]["mean"] = sample.mean;
      if (const auto half = lab::half_width(sample, m.confidence))
        one[r.name]["half_width"] = *half;
      if (const auto half = pooled_half_width(m, r.effects, sample.count))
        one[r.name]["pooled_half_width"] = *half;
    }
    json["conditions"].push_back(one);
  }
  for (const Response& r : m.responses) json["effects"][r.name] = effects_json(r.effects);
  for (const lab::ReducedRun& run : m.all.runs) json["runs"].push_back(run_json(run));
  return json;
}

Json conditions_table(const Matrix& m) {
  Json table{{"title", "Conditions"}, {"head", Json::array()}, {"rows", Json::array()}};
  for (const lab::Factor& factor : m.factors) table["head"].push_back(factor.name);
  table["head"].insert(table["head"].end(), {"runs", "static", "of all", "dynamic", "of all"});
  for (const lab::Condition& condition : m.conditions) {
    Json row = Json::array();
    for (std::size_t f = 0; f < m.factors.size(); ++f) row.push_back(m.level(condition, f));
    row.push_back(condition.runs.size());
    for (const Response& r : m.responses) {
      const lab::Sample sample = m.sample(condition, r);
      Json cell{{"value", sample.mean}};
      if (const auto half = lab::half_width(sample, m.confidence)) cell["error"] = *half;
      row.push_back(cell);
      const auto pooled = pooled_half_width(m, r.effects, sample.count);
      row.push_back(pooled ? Json(fmt::format("± {:.2g}", *pooled)) : Json(nullptr));
    }
    table["rows"].push_back(row);
  }
  table["note"] = fmt::format(
      "± is the half width of the {:g} % interval from the condition's own runs; \"of all\" is the "
      "one from the scatter of repeated runs over all conditions, which is more reliable where "
      "conditions have few runs each.",
      100 * m.confidence);
  return table;
}

Json effects_table(const Response& r) {
  Json table{{"title", fmt::format("Effects on the {} coefficient", r.name)},
             {"head", {"factor", "level", "effect", "F", "p-value (no effect)"}},
             {"rows", Json::array()}};
  const lab::Effects& e = r.effects;
  if (!e.not_found.empty()) {
    table["note"] = "Not found: " + e.not_found + ".";
    return table;
  }
  const auto tested = [&](const std::string& factor) {
    const auto found = std::ranges::find(e.tests, factor, &lab::FactorTest::factor);
    return found == e.tests.end() ? nullptr : &*found;
  };
  std::string before;
  for (const lab::Effect& effect : e.effects) {
    Json cell{{"value", effect.value}};
    if (effect.half_width) cell["error"] = *effect.half_width;
    const auto* test = effect.factor == before ? nullptr : tested(effect.factor);
    table["rows"].push_back({effect.factor, effect.level, cell, test ? Json(test->f) : Json(""),
                             test ? Json(fmt::format("{:.2g}", test->probability)) : Json("")});
    before = effect.factor;
  }
  if (const auto* test = tested("interactions"))
    table["rows"].push_back(
        {"interactions", "", "", test->f, fmt::format("{:.2g}", test->probability)});
  table["note"] = fmt::format(
      "Mean {:.4f}; an effect is what a level adds to it. Standard deviation of one run {:.2g} "
      "({}, "
      "{} degrees of freedom). Interactions: deviations of the conditions from the sum of the "
      "effects; where they are significant, the effects of single factors do not suffice.",
      e.mean, e.deviation, e.is_pure_error ? "of repeated runs" : "of the residuals", e.freedom);
  return table;
}

Json curves_chart(const Matrix& m) {
  Json chart = chart_of("Mean friction of each condition against sliding distance", "distance", "m",
                        "friction coefficient");
  const double step = m.all.loaded.settings.analysis.distance_step;
  for (const lab::Condition& condition : m.conditions) {
    std::vector<lab::ReducedRun> runs;
    for (const std::size_t run : condition.runs) runs.push_back(m.all.runs[run]);
    std::vector<double> x, y;
    for (const lab::Sample& sample : lab::repeatability(runs, step).friction) {
      x.push_back(static_cast<double>(x.size()) * step);
      y.push_back(sample.mean);
    }
    chart["lines"].push_back(chart_line(m.label(condition), "-", x, y));
  }
  return chart;
}

// Marks over the levels, one position per level, named below it.
Json effects_chart(const Matrix& m, const Response& r) {
  Json chart =
      chart_of(fmt::format("Effects on the {} coefficient", r.name), "level", "-", "effect");
  Json& names = chart["x"]["names"] = Json::array();
  for (const lab::Factor& factor : m.factors) {
    std::vector<double> x, y;
    Json low = Json::array(), high = Json::array();
    for (const lab::Effect& effect : r.effects.effects) {
      if (effect.factor != factor.name) continue;
      const double half = effect.half_width.value_or(0);
      x.push_back(static_cast<double>(names.size()));
      names.push_back(effect.level);
      y.push_back(effect.value);
      low.push_back(effect.value - half);
      high.push_back(effect.value + half);
    }
    if (x.empty()) continue;
    Json line = chart_line(factor.name, "-", x, y);
    line["isMarks"] = true;
    line["low"] = low;
    line["high"] = high;
    chart["lines"].push_back(line);
  }
  return chart;
}

std::string matrix_text(const Matrix& m) {
  std::string text;
  for (const lab::Condition& condition : m.conditions) {
    text += m.label(condition) + ":";
    for (const Response& r : m.responses) {
      const lab::Sample sample = m.sample(condition, r);
      text += fmt::format(" {} {:.4f}", r.name, sample.mean);
      if (const auto half = lab::half_width(sample, m.confidence))
        text += fmt::format(" +- {:.4f}", *half);
    }
    text += fmt::format(" ({})\n", counted(condition.runs.size(), "run"));
  }
  for (const Response& r : m.responses) {
    if (!r.effects.not_found.empty())
      text += fmt::format("effects on {}: not found: {}\n", r.name, r.effects.not_found);
    for (const lab::Effect& effect : r.effects.effects)
      text += fmt::format("{}: {} {} adds {:+.4f} +- {:.4f}\n", r.name, effect.factor, effect.level,
                          effect.value, effect.half_width.value_or(0));
    for (const lab::FactorTest& test : r.effects.tests)
      if (test.factor == "interactions")
        text += fmt::format("{}: interactions F {:.3g}, probability {:.2g}\n", r.name, test.f,
                            test.probability);
  }
  return text;
}

}  // namespace

LabOutput matrix_output(const Reduction& all) {
  const Matrix m = matrix_of(all);
  const std::string& named = all.loaded.settings.title;
  LabOutput output;
  output.title = named.empty() ? "Sliding-plate tests under a matrix of conditions" : named;
  output.lead = fmt::format("{} under {}.", counted(all.runs.size(), "run"),
                            counted(m.conditions.size(), "condition"));
  output.summary = matrix_json(m);
  output.files = {{"conditions.csv", conditions_csv(m)}, {"effects.csv", effects_csv(m)}};
  for (const lab::ReducedRun& run : all.runs)
    output.files.emplace_back("reduced-" + run.name + ".csv", run_csv(run.curve));
  output.charts.push_back(curves_chart(m));
  for (const Response& r : m.responses)
    if (r.effects.not_found.empty()) output.charts.push_back(effects_chart(m, r));
  output.tables.push_back(conditions_table(m));
  for (const Response& r : m.responses) output.tables.push_back(effects_table(r));
  output.told = matrix_text(m);
  return output;
}

}  // namespace pulvis
