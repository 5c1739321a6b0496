#include "cli/campaigns/study/analysis/study_power.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/keys/tables.hpp"
#include "scenes/language/units.hpp"
#include "scenes/let/dimension.hpp"

namespace pulvis {
namespace {

// "stage.press.move[0].displacement" is stage, press, move, displacement.
std::vector<std::string> words_of_path(const std::string& path) {
  std::vector<std::string> words{""};
  bool position = false;
  for (const char c : path) {
    position = c == '[' || (position && c != ']');
    if (c == '.')
      words.emplace_back();
    else if (!position && c != ']')
      words.back() += c;
  }
  return words;
}

// Names of elements may occur between the words of a table's path.
bool leads_to(const std::vector<std::string>& words, const std::string& table) {
  std::size_t at = 0;
  for (const std::string& word : words_of_path(table)) {
    while (at < words.size() && words[at] != word) ++at;
    if (at++ == words.size()) return false;
  }
  return true;
}

const StudySetting* setting_of(const StudyRun& run, const std::string& path) {
  const auto found = std::find_if(run.varied.rbegin(), run.varied.rend(),
                                  [&](const StudySetting& one) { return one.path == path; });
  return found == run.varied.rend() ? nullptr : &*found;
}

bool is_variable(const std::string& path) { return path.starts_with("let."); }

// A variable has no declaration: its dimension is that of its value.
std::optional<let::Quantity> quantity_set(const StudyRun& run, const std::string& path) {
  const StudySetting* setting = setting_of(run, path);
  if (setting == nullptr) return std::nullopt;
  const document::Value& value = setting->value;
  if (const auto* whole = value.as<std::int64_t>())
    return let::Quantity{static_cast<double>(*whole)};
  if (const auto* number = value.as<double>()) return let::Quantity{*number};
  const auto* text = value.as<std::string>();
  if (text == nullptr) return std::nullopt;
  try {
    return let::quantity_of(*text);
  } catch (const let::ExpressionError&) {
    return std::nullopt;
  }
}

std::vector<double> logs_of(const std::vector<double>& values) {
  std::vector<double> all;
  for (const double value : values) all.push_back(std::log(value));
  return all;
}

}  // namespace

LogLine fit_log_line(const std::vector<double>& x, const std::vector<double>& y) {
  const double count = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / count;
    mean_y += std::log(y[i]) / count;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double dx = x[i] - mean_x, dy = std::log(y[i]) - mean_y;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
  const double slope = xy / xx;
  return {std::exp(mean_y - slope * mean_x), slope, xy * xy / (xx * yy)};
}

PowerFit fit_power(const std::vector<double>& key, const std::vector<double>& value) {
  std::vector<double> x = logs_of(key);
  double middle = 0;
  for (const double one : x) middle += one / static_cast<double>(x.size());
  for (double& one : x) one -= middle;
  const LogLine line = fit_log_line(x, value);
  return {line.slope, std::exp(middle), line.at_zero, line.r_squared};
}

std::vector<double> local_exponents(const std::vector<double>& key,
                                    const std::vector<double>& value) {
  const std::vector<double> x = logs_of(key), y = logs_of(value);
  const auto chord = [&](std::size_t i) { return (y[i + 1] - y[i]) / (x[i + 1] - x[i]); };
  const std::size_t last = x.size() - 1;
  std::vector<double> exponents;
  for (std::size_t i = 0; i <= last; ++i) {
    if (i == 0 || i == last) {
      exponents.push_back(chord(i == 0 ? 0 : last - 1));
      continue;
    }
    const double before = x[i] - x[i - 1], after = x[i + 1] - x[i];
    exponents.push_back((after * chord(i - 1) + before * chord(i)) / (before + after));
  }
  return exponents;
}

std::string unit_of_varied(const std::vector<StudyRun>& runs, const std::string& path) {
  if (!is_variable(path)) return unit_of_key(path);
  for (const StudyRun& run : runs)
    if (const std::optional<let::Quantity> set = quantity_set(run, path);
        set && !set->dimension.plain())
      return set->dimension.text();
  return "-";
}

namespace {

const schema::KeyInfo* key_at(const std::string& path, const schema::Language& language) {
  const std::vector<std::string> words = words_of_path(path);
  const std::vector<std::string> above(words.begin(), words.end() - 1);
  const schema::KeyInfo* found = nullptr;
  std::size_t longest = 0;
  for (const schema::TableView& table : language) {
    const std::string& name = table.info.path;
    if (name.size() < longest || (name.empty() ? !above.empty() : !leads_to(above, name))) continue;
    const schema::KeyInfo* key = schema::find_key(table, words.back());
    if (key == nullptr) continue;
    found = key;
    longest = name.size();
  }
  return found;
}

}  // namespace

std::string unit_of_key(const std::string& path) {
  const schema::KeyInfo* found = key_at(path, schema::scene_language());
  return found == nullptr || found->unit.empty() ? "-" : found->unit;
}

bool sets_key(const StudyRun& run, const std::string& path) {
  return setting_of(run, path) != nullptr;
}

std::optional<double> number_of_key(const StudyRun& run, const std::string& path) {
  const StudySetting* setting = setting_of(run, path);
  if (setting == nullptr) return std::nullopt;
  if (is_variable(path)) {
    const std::optional<let::Quantity> quantity = quantity_set(run, path);
    return quantity ? std::optional(quantity->value) : std::nullopt;
  }
  if (const auto* whole = setting->value.as<std::int64_t>()) return static_cast<double>(*whole);
  if (const auto* number = setting->value.as<double>()) return *number;
  const auto* text = setting->value.as<std::string>();
  if (text == nullptr) return std::nullopt;
  try {
    return parse_quantity(*text, unit_of_key(path));
  } catch (const UnitError&) {
    return std::nullopt;
  }
}

}  // namespace pulvis
