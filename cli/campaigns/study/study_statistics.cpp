#include "cli/campaigns/study/study_statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cli/csv_cell.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

struct RunRow {
  const StudyResult* result = nullptr;
  std::vector<std::string> settings;
  std::vector<Figure> values;
};

// Numbers with a unit; counts, names and wall time are not results.
bool is_result(const Figure& value) {
  return !value.unit.empty() && value.value.is_number() && value.name != "wall_seconds";
}

std::vector<RunRow> rows_of(const std::vector<std::string>& keys,
                            const std::vector<StudyResult>& results) {
  std::vector<RunRow> rows;
  for (const StudyResult& result : results) {
    RunRow row{&result, {}, {}};
    for (const std::string& key : keys) row.settings.push_back(varied_value(*result.run, key));
    if (result.usable)
      for (Figure& value : figures_of(result))
        if (is_result(value)) row.values.push_back(std::move(value));
    rows.push_back(std::move(row));
  }
  return rows;
}

StudySample sample_of(const std::vector<double>& values) {
  StudySample sample{values.size(), 0, 0};
  for (const double value : values) sample.mean += value / static_cast<double>(values.size());
  double squares = 0;
  for (const double value : values) squares += (value - sample.mean) * (value - sample.mean);
  if (values.size() > 1)
    sample.deviation = std::sqrt(squares / static_cast<double>(values.size() - 1));
  return sample;
}

// Samples of every value that any of the rows has, in order of first occurrence.
std::vector<NamedSample> samples_of(const std::vector<const RunRow*>& rows) {
  std::vector<NamedSample> samples;
  std::map<std::string, std::vector<double>> numbers;
  for (const RunRow* row : rows)
    for (const Figure& value : row->values) {
      if (!numbers.contains(value.name)) samples.push_back({value.name, value.unit, {}});
      numbers[value.name].push_back(value.value.get<double>());
    }
  for (NamedSample& one : samples) one.sample = sample_of(numbers[one.name]);
  return samples;
}

std::vector<const RunRow*> usable_of(const std::vector<RunRow>& rows, const auto& wanted) {
  std::vector<const RunRow*> found;
  for (const RunRow& row : rows)
    if (row.result->usable && wanted(row)) found.push_back(&row);
  return found;
}

std::vector<std::string> levels_of(const std::vector<RunRow>& rows, std::size_t key) {
  std::vector<std::string> levels;
  for (const RunRow& row : rows)
    if (std::ranges::find(levels, row.settings[key]) == levels.end())
      levels.push_back(row.settings[key]);
  return levels;
}

// Whether all combinations of the other settings occur equally often per level: else their effect is included.
bool is_balanced(const std::vector<RunRow>& rows, std::size_t key,
                 const std::vector<std::string>& levels) {
  std::map<std::vector<std::string>, std::map<std::string, int>> counts;
  for (const RunRow& row : rows) {
    if (!row.result->usable) continue;
    std::vector<std::string> others = row.settings;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(key));
    others.push_back(row.result->run->file.string());
    ++counts[others][row.settings[key]];
  }
  const auto even = [&](const auto& of_levels) {
    return of_levels.second.size() == levels.size() &&
           std::ranges::all_of(of_levels.second, [&](const auto& one) {
             return one.second == of_levels.second.begin()->second;
           });
  };
  return std::ranges::all_of(counts, even);
}

// For runs of different scenes only if each of them sets the key: otherwise the scenes would be compared.
bool has_effect(const std::vector<RunRow>& rows, std::size_t key) {
  const auto scene = [](const RunRow& row) { return row.result->run->file; };
  const bool one_scene = std::ranges::all_of(
      rows, [&](const RunRow& row) { return scene(row) == scene(rows.front()); });
  const bool all_set =
      std::ranges::none_of(rows, [&](const RunRow& row) { return row.settings[key].empty(); });
  return (one_scene || all_set) && levels_of(rows, key).size() > 1;
}

MainEffect effect_of(const std::string& name, std::size_t key, const std::vector<RunRow>& rows) {
  MainEffect effect{name, true, {}};
  const std::vector<std::string> levels = levels_of(rows, key);
  for (const std::string& level : levels) {
    const auto mine =
        usable_of(rows, [&](const RunRow& row) { return row.settings[key] == level; });
    effect.levels.push_back({level, mine.size(), samples_of(mine)});
  }
  effect.balanced = is_balanced(rows, key, levels);
  return effect;
}

Json samples_json(const std::vector<NamedSample>& samples) {
  Json list = Json::array();
  for (const NamedSample& one : samples) {
    list.push_back({{"name", one.name}, {"unit", one.unit}, {"mean", one.sample.mean}});
    if (one.sample.count > 1) list.back()["standard_deviation"] = one.sample.deviation;
    list.back()["runs"] = one.sample.count;
  }
  return list;
}

std::string deviation_cell(const StudySample& sample) {
  return sample.count > 1 ? fmt::format("{:.9g}", sample.deviation) : "";
}

const NamedSample* named(const std::vector<NamedSample>& samples, const std::string& name) {
  const auto found = std::ranges::find(samples, name, &NamedSample::name);
  return found == samples.end() ? nullptr : &*found;
}

}  // namespace

StudyStatistics statistics_of(const Study& study, const std::vector<StudyResult>& results) {
  const std::vector<std::string> keys = varied_keys(study);
  const std::vector<RunRow> rows = rows_of(keys, results);
  StudyStatistics all;
  for (const std::string& variation : study.variations) {
    const auto is_mine = [&](const RunRow& row) { return row.result->run->variation == variation; };
    const auto mine = usable_of(rows, is_mine);
    const auto first = std::ranges::find_if(rows, is_mine);
    all.variations.push_back(
        {variation, first == rows.end() ? std::vector<std::string>(keys.size()) : first->settings,
         mine.size(), static_cast<std::size_t>(std::ranges::count_if(rows, is_mine)),
         samples_of(mine)});
  }
  for (std::size_t key = 0; key < keys.size(); ++key)
    if (has_effect(rows, key)) all.effects.push_back(effect_of(keys[key], key, rows));
  return all;
}

Json variations_json(const StudyStatistics& statistics) {
  Json list = Json::array();
  for (const VariationStatistics& one : statistics.variations)
    list.push_back({{"variation", one.variation},
                    {"settings", one.settings},
                    {"runs", one.runs},
                    {"of", one.of},
                    {"values", samples_json(one.values)}});
  return list;
}

Json effects_json(const StudyStatistics& statistics) {
  Json list = Json::array();
  for (const MainEffect& effect : statistics.effects) {
    Json levels = Json::array();
    for (const EffectLevel& one : effect.levels)
      levels.push_back(
          {{"level", one.level}, {"runs", one.runs}, {"values", samples_json(one.values)}});
    list.push_back({{"key", effect.key}, {"balanced", effect.balanced}, {"levels", levels}});
  }
  return list;
}

std::string variations_csv(const Study& study, const StudyStatistics& statistics) {
  std::vector<const NamedSample*> columns;  // of any variation
  for (const VariationStatistics& one : statistics.variations)
    for (const NamedSample& value : one.values)
      if (std::ranges::none_of(columns, [&](const auto* c) { return c->name == value.name; }))
        columns.push_back(&value);
  std::string text = "variation";
  for (const std::string& key : varied_keys(study)) text.append(",").append(csv_word(key));
  text += ",runs";
  for (const NamedSample* c : columns)
    text += fmt::format(",{0} mean [{1}],{0} standard deviation [{1}]", c->name, c->unit);
  text += "\n";
  for (const VariationStatistics& one : statistics.variations) {
    text += csv_word(one.variation);
    for (const std::string& setting : one.settings) text.append(",").append(csv_word(setting));
    text += fmt::format(",{}", one.runs);
    for (const NamedSample* c : columns) {
      const NamedSample* value = named(one.values, c->name);
      text += value == nullptr
                  ? ",,"
                  : fmt::format(",{:.9g},{}", value->sample.mean, deviation_cell(value->sample));
    }
    text += "\n";
  }
  return text;
}

std::string effects_csv(const StudyStatistics& statistics) {
  std::string text = "key,level,value,unit,runs,mean,standard deviation\n";
  for (const MainEffect& effect : statistics.effects)
    for (const EffectLevel& level : effect.levels)
      for (const NamedSample& one : level.values)
        text += fmt::format("{},{},{},{},{},{:.9g},{}\n", csv_word(effect.key),
                            csv_word(level.level), csv_word(one.name), one.unit, one.sample.count,
                            one.sample.mean, deviation_cell(one.sample));
  return text;
}

}  // namespace pulvis
