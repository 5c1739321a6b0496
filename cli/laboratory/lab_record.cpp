#include "cli/laboratory/lab_record.hpp"

#include "scenes/language/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace pulvis::lab {
namespace {

constexpr std::size_t fewest_samples = 30;
constexpr std::size_t flat_top = 10;  // equal consecutive samples at an extreme

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Strain has no dimension; these are the ways its column may be labelled.
std::optional<double> strain_factor(const std::string& unit) {
  static const std::map<std::string, double> factors{
      {"um/m", 1e-6},    {"µm/m", 1e-6},    {"μm/m", 1e-6}, {"ue", 1e-6},  {"µe", 1e-6},
      {"uε", 1e-6},      {"µε", 1e-6},      {"με", 1e-6},   {"ppm", 1e-6}, {"microstrain", 1e-6},
      {"ustrain", 1e-6}, {"µstrain", 1e-6}, {"mm/m", 1e-3}, {"me", 1e-3},  {"%", 1e-2},
      {"m/m", 1},        {"mm/mm", 1},      {"-", 1},       {"1", 1},      {"strain", 1}};
  const auto found = factors.find(unit);
  return found == factors.end() ? std::nullopt : std::optional(found->second);
}

void read_time(const csv::Table& table, const std::string& name, double longest_gap,
               Record& record) {
  const std::size_t column = csv::column_at(table, name);
  record.file = table.file;
  record.lines = table.lines;
  record.time = csv::numbers(table, column, "s");
  const std::vector<double>& t = record.time;
  if (t.size() < fewest_samples)
    csv::refuse(table, t.size() - 1, column,
                fmt::format("the record ends after {} samples, allowed: at least {}", t.size(),
                            fewest_samples));
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) {
    steps.push_back(t[i] - t[i - 1]);
    if (!(steps.back() > 0))
      csv::refuse(table, i, column,
                  fmt::format("{:.6g} s does not come after {:.6g} s in line {}, allowed: time "
                              "that increases from row to row",
                              t[i], t[i - 1], table.lines[i - 1]));
  }
  record.interval = median(steps);
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (steps[i] > longest_gap * record.interval)
      csv::refuse(
          table, i + 1, column,
          fmt::format("a gap of {:.4g} s after line {}, allowed: at most {:.4g} s, {:g} times the "
                      "median interval (clock.longest_gap)",
                      steps[i], table.lines[i], longest_gap * record.interval, longest_gap));
}

struct Channel {
  const csv::Table& table;
  std::size_t column;
  const std::vector<double>& values;
};

void refuse_beyond(const Channel& channel, double limit, const char* unit, const char* key) {
  for (std::size_t i = 0; i < channel.values.size(); ++i)
    if (std::abs(channel.values[i]) >= limit)
      csv::refuse(channel.table, i, channel.column,
                  fmt::format("{:.6g} {} is saturated, allowed: less than {:.6g} {} ({})",
                              channel.values[i], unit, limit, unit, key));
}

bool shows_noise(const std::vector<double>& values) {
  std::vector<double> first(values.begin(), values.begin() + flat_top);
  std::sort(first.begin(), first.end());
  return std::unique(first.begin(), first.end()) - first.begin() >= 3;
}

void refuse_flat_top(const Channel& channel) {
  const std::vector<double>& v = channel.values;
  if (!shows_noise(v)) return;
  const auto [low, high] = std::minmax_element(v.begin(), v.end());
  std::size_t running = 1;
  for (std::size_t i = 1; i < v.size(); ++i) {
    running = v[i] == v[i - 1] ? running + 1 : 1;
    if (running >= flat_top && (v[i] == *low || v[i] == *high))
      csv::refuse(channel.table, i, channel.column,
                  fmt::format("is saturated: it repeats its {} value, {} times up to this line, "
                              "allowed: a channel within its range",
                              v[i] == *high ? "largest" : "smallest", running));
  }
}

double largest_size(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return -*low > *high ? *low : *high;
}

// Presses record compression with either sign, and strokes up or down.
void turn(std::vector<double>& values, double sign) {
  if (sign < 0)
    for (double& value : values) value = -value;
}

void take_press(const csv::Table& table, std::size_t force, std::size_t displacement,
                double capacity, PressRecord& record) {
  record.force = csv::numbers(table, force, "N");
  record.displacement = csv::numbers(table, displacement, "m");
  refuse_beyond({table, force, record.force}, capacity, "N", "press.capacity");
  turn(record.force, largest_size(record.force));
  const auto loaded = std::max_element(record.force.begin(), record.force.end());
  if (!(*loaded > 0))
    csv::refuse(table, table.columns[force].name, "is zero throughout, allowed: a loaded press");
  const auto at = static_cast<std::size_t>(loaded - record.force.begin());
  turn(record.displacement, record.displacement[at] - record.displacement.front());
}

// The walls carry part of the force of the top punch, which is the moving one.
void refuse_exchanged(const csv::Table& table, std::size_t bottom, const DieRecord& record) {
  constexpr double error = 0.05;  // more than gauges differ
  const double from_top = largest_size(record.force), below = largest_size(record.bottom);
  if (below > (1 + error) * from_top)
    csv::refuse(table, table.columns[bottom].name,
                fmt::format("carries up to {:.6g} N, more than the {:.6g} N of the top punch, "
                            "allowed: less (are the columns swapped?)",
                            below, from_top));
}

}  // namespace

Instrument instrument_of(const std::filesystem::path& file, const Settings& settings) {
  const csv::Table press = csv::read(file, {settings.press.header_line, true});
  const bool is_press = csv::has_column(press, settings.press.force) &&
                        csv::has_column(press, settings.press.displacement);
  const csv::Table logger = csv::read(file, {settings.logger.header_line, true});
  const bool is_logger = csv::has_column(logger, settings.logger.strain) &&
                         csv::has_column(logger, settings.logger.lvdt);
  if (is_press != is_logger) return is_press ? Instrument::press : Instrument::logger;
  std::vector<std::string> names;
  for (const csv::Column& column : press.columns) names.push_back("'" + column.name + "'");
  csv::refuse(
      press, "record",
      fmt::format("{} of press and logger, its columns are {}, allowed: either '{}' and '{}' "
                  "(press), or '{}' and '{}' (logger)",
                  is_press ? "has the columns" : "does not have the columns", listed(names),
                  settings.press.force, settings.press.displacement, settings.logger.strain,
                  settings.logger.lvdt));
}

PressRecord read_press(const std::filesystem::path& file, const Settings& settings) {
  const PressSpec& spec = settings.press;
  const csv::Table table = csv::read(file, {spec.header_line, true});
  PressRecord record;
  read_time(table, spec.time, settings.clock.longest_gap, record);
  const std::size_t force = csv::column_at(table, spec.force);
  const std::size_t displacement = csv::column_at(table, spec.displacement);
  take_press(table, force, displacement, spec.capacity, record);
  return record;
}

DieRecord read_die(const std::filesystem::path& file, const Settings& settings) {
  const GaugesSpec& spec = settings.gauges;
  const csv::Table table = csv::read(file, {spec.header_line, true});
  DieRecord record;
  read_time(table, spec.time, settings.clock.longest_gap, record);
  take_press(table, csv::column_at(table, spec.top), csv::column_at(table, spec.displacement),
             settings.press.capacity, record);
  const std::size_t bottom = csv::column_at(table, spec.bottom);
  record.bottom = csv::numbers(table, bottom, "N");
  refuse_beyond({table, bottom, record.bottom}, settings.press.capacity, "N", "press.capacity");
  record.radial = csv::numbers(table, csv::column_at(table, spec.radial), "Pa");
  turn(record.bottom, largest_size(record.bottom));
  refuse_exchanged(table, bottom, record);
  turn(record.radial, largest_size(record.radial));
  return record;
}

LoggerRecord read_logger(const std::filesystem::path& file, const Settings& settings) {
  const LoggerSpec& spec = settings.logger;
  const csv::Table table = csv::read(file, {spec.header_line, true});
  LoggerRecord record;
  read_time(table, spec.time, settings.clock.longest_gap, record);
  const std::size_t strain = csv::column_at(table, spec.strain);
  const std::size_t lvdt = csv::column_at(table, spec.lvdt);
  const std::string& unit = table.columns[strain].unit;
  const std::optional<double> factor = strain_factor(unit);
  if (!factor)
    csv::refuse(table, table.columns[strain].name,
                fmt::format("{}, allowed: um/m, ue, ppm, mm/m, m/m, -, %",
                            unit.empty() ? "has no unit" : "has the unit '" + unit + "'"));
  record.strain = csv::numbers(table, strain, *factor);
  record.lvdt = csv::numbers(table, lvdt, "V");
  const Channel strains{table, strain, record.strain}, volts{table, lvdt, record.lvdt};
  if (spec.strain_limit) refuse_beyond(strains, *spec.strain_limit, "m/m", "logger.strain_limit");
  if (spec.lvdt_limit) refuse_beyond(volts, *spec.lvdt_limit, "V", "logger.lvdt_limit");
  refuse_flat_top(strains);
  refuse_flat_top(volts);
  return record;
}

void refuse(const Record& record, std::size_t sample, const std::string& key,
            const std::string& message) {
  throw SceneError({{record.file.string(), record.lines[sample], 1, "", key, message}});
}

void refuse(const Record& record, const std::string& key, const std::string& message) {
  throw SceneError({{record.file.string(), 1, 1, "", key, message}});
}

}  // namespace pulvis::lab
