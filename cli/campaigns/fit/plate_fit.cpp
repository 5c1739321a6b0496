#include "cli/campaigns/fit/plate_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/campaigns/fit/declare_fit.hpp"
#include "scenes/language/describe.hpp"
#include "scenes/language/table_reader.hpp"

namespace pulvis {
namespace {

constexpr std::size_t most_parameters = 3;
constexpr double smallest_step = 1e-12;  // of the largest value: a thousandth has 15 digits
const char* const introduction = R"(# The fit file

<!-- Generated from the declarations in cli/campaigns/fit/declare_fit.cpp: change those, not this file. -->

A fit is a TOML file that names the scene of a sliding-plate test, the keys to be fitted, and the measured data. `pulvis fit
FIT.toml` runs the scene with different values of these keys, several runs at once, until its friction matches the record.
It reports the values with confidence intervals, and the ranges in which test and simulation must not be compared. If
interrupted, the same command resumes. The method is described in [laboratory.md](laboratory.md#from-test-to-simulation).

```toml
scene = "plate-scene.toml"

[[parameter]]
key = "friction[0].coefficient"
start = 0.1
low = 0.0
high = 0.6
step = 0.02

[measured]
record = "plate-measured.csv"
```
)";

class PlateFitReader {
 public:
  PlateFitReader(const std::filesystem::path& file, const std::vector<std::string>& overrides)
      : problems_(file, overrides) {
    fit_.file = file;
    fit_.overrides = overrides;
    fit_.text = toml_file_text(file, "a fit");
    fit_.spec.title = file.stem().string();
  }

  PlateFit read() {
    document::Value root{parsed(), {{1, 1}, -1}};
    schema::fill_defaults(root.get<document::Table>(), schema::fit_language());
    const auto& table = root.get<document::Table>();
    schema::TableReader reader(table, problems_, schema::fit_language());
    reader.read(schema::fit_top_level(), root, "", "", fit_.spec);
    const document::Entry* measured = document::find(table, "measured");
    if (measured != nullptr)
      reader.read(schema::fit_measured(), measured->value, "measured", "", fit_.spec.measured);
    if (const document::Entry* how = document::find(table, "fit"))
      reader.read(schema::fit_fit(), how->value, "fit", "", fit_.spec);
    const document::Array& parameters = reader.elements(table, "", schema::fit_parameter().info);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      SoughtKey& sought = fit_.spec.parameters.emplace_back();
      sought.mark = parameters[i].origin.mark;
      reader.read(schema::fit_parameter(), parameters[i], fmt::format("parameter[{}]", i), "",
                  sought);
    }
    problems_.throw_if_any();
    check_parameters();
    check_measured();
    problems_.throw_if_any();
    load(reader.origins());
    problems_.throw_if_any();
    return std::move(fit_);
  }

 private:
  document::Table parsed() {
    try {
      return document::parse(fit_.text);
    } catch (const document::SyntaxError& error) {
      problems_.add({error.mark, -1}, "syntax", error.what());
      problems_.throw_if_any();
      throw;  // not reached
    }
  }

  void check_parameters() {
    const std::vector<SoughtKey>& all = fit_.spec.parameters;
    if (all.empty() || all.size() > most_parameters)
      problems_.add({{1, 1}, -1}, "parameter",
                    fmt::format("{} are given, allowed: 1 to {} [[parameter]] tables", all.size(),
                                most_parameters));
    for (std::size_t i = 0; i < all.size(); ++i) {
      const SoughtKey& one = all[i];
      const auto add = [&](const char* key, const std::string& what) {
        problems_.add({one.mark, -1}, fmt::format("parameter[{}].{}", i, key), what);
      };
      if (!(one.low < one.high))
        add("high", fmt::format("{:g} is not above low, allowed: > {:g}", one.high, one.low));
      else if (one.start < one.low || one.start > one.high)
        add("start",
            fmt::format("{:g}, allowed: between {:g} and {:g}", one.start, one.low, one.high));
      else if (one.step > (one.high - one.low) / 2)
        add("step", fmt::format("{:g}, allowed: up to half of high - low, {:g}", one.step,
                                (one.high - one.low) / 2));
      else if (const double least = smallest_step * std::max(std::abs(one.low), std::abs(one.high));
               one.step < least)
        add("step", fmt::format("{:g}, allowed: at least {:g}", one.step, least));
      for (std::size_t k = 0; k < i; ++k)
        if (all[k].short_name() == one.short_name())
          add("name",
              fmt::format("two are called '{}', allowed: each name once", one.short_name()));
    }
  }

  void check_measured() {
    const PlateMeasured& m = fit_.spec.measured;
    const auto add = [&](const char* key, const std::string& what) {
      problems_.add({{1, 1}, -1}, std::string("measured") + key, what);
    };
    const int targets = (m.peak ? 1 : 0) + (m.dynamic ? 1 : 0);
    if (m.record.empty() == (targets == 0))
      add("", m.record.empty() ? "nothing is given, allowed: a record, or static and dynamic "
                                 "coefficients"
                               : "a record and coefficients are given, allowed: one of them");
    else if (m.record.empty() && targets < static_cast<int>(fit_.spec.parameters.size()))
      add("", fmt::format("{} coefficient for {} parameters, allowed: at least as many "
                          "coefficients as parameters",
                          targets, fit_.spec.parameters.size()));
    if (m.until && !(*m.until > m.from))
      add(".until", fmt::format("{:g} m is not beyond from, allowed: > {:g} m", *m.until, m.from));
    if (m.by_diameters() && !m.particle_diameter)
      add(".particle_diameter", "is not given, allowed: > 0 m, for compare = \"diameters\"");
  }

  void load(const schema::Origins& origins) {
    try {
      std::vector<double> start;
      for (const SoughtKey& sought : fit_.spec.parameters) start.push_back(sought.start);
      LoadedScene loaded = load_scene(fit_.scene_file(), fit_.settings_at(start));
      fit_.scene = std::move(loaded.scene);
      for (const InputFile& input : loaded.inputs) fit_.files.insert(input.source);
      refuse_replaced(loaded.replaced, origins);
    } catch (const SceneError& error) {
      for (const SceneProblem& problem : error.errors())
        problems_.add(origins.at("scene"), "scene", problem.text());
      return;
    }
    if (fit_.scene.in_space()) {
      problems_.add(origins.at("scene"), "scene",
                    "the scene is three-dimensional, allowed: two-dimensional scenes");
      return;
    }
    const auto& tools = fit_.scene.tools;
    if (std::ranges::find(tools, fit_.spec.target, &ToolSpec::name) == tools.end())
      problems_.add(origins.at("scene"), "fit.target",
                    fmt::format("the scene has no tool '{}', allowed: the one that slides",
                                fit_.spec.target));
  }

  // A parameter that a later setting replaces would not change from run to run.
  void refuse_replaced(const std::vector<ReplacedOverride>& replaced,
                       const schema::Origins& origins) {
    const std::size_t parameters = fit_.spec.parameters.size();
    const std::size_t own = parameters + fit_.spec.overrides.size();
    for (const auto [earlier, later] : replaced) {
      if (earlier >= parameters) continue;
      if (later < parameters)
        problems_.add({fit_.spec.parameters[later].mark, -1},
                      fmt::format("parameter[{}].key", later),
                      fmt::format("'{}' is fitted twice, allowed: each key once",
                                  fit_.spec.parameters[later].key));
      else if (later < own)
        problems_.add(origins.at("overrides"), "overrides", replaces_parameter(earlier));
      else
        problems_.add({{}, static_cast<int>(later - own)}, key_of(fit_.overrides[later - own]),
                      replaces_parameter(earlier));
    }
  }

  std::string replaces_parameter(std::size_t i) const {
    return fmt::format("replaces the fitted parameter '{}', allowed: keys that are not fitted",
                       fit_.spec.parameters[i].key);
  }

  Problems problems_;
  PlateFit fit_;
};

}  // namespace

std::string SoughtKey::short_name() const {
  return name.empty() ? key.substr(key.rfind('.') + 1) : name;
}

std::string SoughtKey::text(double value) const {
  int digits = 3;  // of a thousandth step
  for (double left = std::max(std::abs(low), std::abs(high)) / step; left > 1; left /= 10) ++digits;
  return fmt::format("{:.{}g}", value, std::max(6, digits));
}

std::string SoughtKey::setting(double value) const {
  return fmt::format("{}={}{}{}", key, text(value), unit.empty() ? "" : " ", unit);
}

std::vector<std::string> PlateFit::settings_at(const std::vector<double>& values) const {
  std::vector<std::string> settings;
  for (std::size_t i = 0; i < values.size(); ++i)
    settings.push_back(spec.parameters[i].setting(values[i]));
  settings.insert(settings.end(), spec.overrides.begin(), spec.overrides.end());
  settings.insert(settings.end(), overrides.begin(), overrides.end());
  return settings;
}

PlateFit load_plate_fit(const std::filesystem::path& file,
                        const std::vector<std::string>& overrides) {
  return PlateFitReader(file, overrides).read();
}

std::string plate_fit_reference() { return reference_of(introduction, schema::fit_language()); }

}  // namespace pulvis
