#include "cli/laboratory/volts/volts_records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/laboratory/volts/loop_rows.hpp"
#include "engine/portable_math.hpp"
#include "scenes/language/csv_table.hpp"
#include "scenes/language/units.hpp"

namespace pulvis::volts {
namespace {

constexpr std::size_t fewest_samples = 30, fewest_in_trace = 10;

std::vector<double> numbers_of(const csv::Table& table, const char* name, const char* unit) {
  return csv::numbers(table, csv::column_at(table, name), unit);
}

bool is_in(const std::string& unit, const char* wanted) {
  try {
    parse_quantity("1 " + unit, wanted);
    return true;
  } catch (const UnitError&) {
    return false;
  }
}

// Relative to the start; the sign of the piezo's axis does not matter.
void order(const csv::Table& table, std::size_t row, ForceCurve& curve) {
  std::vector<double>& d = curve.displacement;
  if (d.size() < fewest_samples)
    csv::refuse(table, row, csv::column_at(table, "displacement"),
                fmt::format("curve {} ends after {} samples, allowed: at least {}", curve.name,
                            d.size(), fewest_samples));
  const double start = d.front();
  for (std::size_t i = 0; i < d.size(); ++i)
    if (std::abs(d[i] - start) > std::abs(d[curve.turn] - start)) curve.turn = i;
  const double sign = d[curve.turn] < start ? -1 : 1;
  for (double& v : d) v = sign * (v - start);
  if (!(d[curve.turn] > 0))
    csv::refuse(
        table, row, csv::column_at(table, "displacement"),
        fmt::format("curve {}: the piezo does not move, allowed: a moving piezo", curve.name));
  for (std::size_t i = 1; i < d.size(); ++i)
    if (i <= curve.turn ? d[i] <= d[i - 1] : d[i] >= d[i - 1])
      csv::refuse(table, row + 1 - d.size() + i, csv::column_at(table, "displacement"),
                  fmt::format("{:.6g} m does not continue the motion from {:.6g} m, allowed: one "
                              "approach to the surface and one retract, without a stop",
                              d[i], d[i - 1]));
}

// A normal signal recorded along with a trace is the load used for the crosstalk, position by position.
void add_normal(const csv::Table& table, std::vector<std::vector<double>>& normal) {
  const bool trace = csv::has_column(table, "normal_trace");
  if (trace != csv::has_column(table, "normal_retrace"))
    csv::refuse(table, trace ? "normal_trace" : "normal_retrace",
                "is given alone, allowed: both normal_trace and normal_retrace, or neither");
  if (!trace) return;
  normal = {numbers_of(table, "normal_trace", "V"), numbers_of(table, "normal_retrace", "V")};
}

struct Columns {
  std::vector<double> slope, load, trace, retrace, position;
  std::vector<std::vector<double>> normal;  // trace, retrace; or empty
};

VoltsLoop loop_of(const csv::Table& table, const Columns& columns, std::size_t begin,
                  std::size_t end, double skip) {
  const auto left_out = static_cast<std::size_t>(skip * static_cast<double>(end - begin));
  const std::size_t count = end - begin - 2 * left_out;
  if (count < fewest_in_trace)
    csv::refuse(
        table, end - 1, csv::column_at(table, "trace"),
        fmt::format(
            "the loop has only {} points, {} of them at its ends, allowed: at least {} others",
            end - begin, 2 * left_out, fewest_in_trace));
  const auto mean = [&](const std::vector<double>& values) {
    return lab::correlated_mean(std::span(values).subspan(begin + left_out, count));
  };
  const lab::Mean trace = mean(columns.trace), retrace = mean(columns.retrace);
  VoltsLoop loop;
  loop.slope = columns.slope[begin];
  loop.load = columns.load[begin];
  loop.half_width = (trace.value - retrace.value) / 2;
  loop.offset = (trace.value + retrace.value) / 2;
  loop.half_width_error = loop.offset_error = 0.5 * portable::hypot(trace.error, retrace.error);
  if (!columns.normal.empty()) {
    const double there = mean(columns.normal[0]).value, return_ = mean(columns.normal[1]).value;
    loop.normal_half = (there - return_) / 2;
    loop.normal_mean = (there + return_) / 2;
  }
  for (std::size_t i = begin; i < end; ++i) {
    loop.traces.position.push_back(columns.position.empty() ? static_cast<double>(i - begin)
                                                            : columns.position[i]);
    loop.traces.trace.push_back(columns.trace[i]);
    loop.traces.retrace.push_back(columns.retrace[i]);
  }
  return loop;
}

std::vector<VoltsLoop> loops_of_raw(const csv::Table& table, Columns& columns, double skip) {
  csv::only(table,
            {"slope", "load", "trace", "retrace", "position", "normal_trace", "normal_retrace"});
  columns.trace = numbers_of(table, "trace", "V");
  columns.retrace = numbers_of(table, "retrace", "V");
  if (csv::has_column(table, "position")) columns.position = numbers_of(table, "position", "m");
  add_normal(table, columns.normal);
  std::vector<VoltsLoop> loops;
  for (std::size_t begin = 0, end = 0; begin < columns.load.size(); begin = end) {
    end = end_of_loop({columns.slope, columns.load, columns.position}, begin);
    loops.push_back(loop_of(table, columns, begin, end, skip));
  }
  return loops;
}

std::vector<VoltsLoop> loops_of_means(const csv::Table& table, const Columns& columns) {
  csv::only(table, {"slope", "load", "half_width", "offset", "half_width_error", "offset_error"});
  const auto width = numbers_of(table, "half_width", "V"),
             offset = numbers_of(table, "offset", "V");
  std::vector<VoltsLoop> loops(columns.load.size());
  for (std::size_t i = 0; i < loops.size(); ++i) {
    loops[i].slope = columns.slope[i];
    loops[i].load = columns.load[i];
    loops[i].half_width = width[i];
    loops[i].offset = offset[i];
  }
  for (const auto& [name, member] : {std::pair{"half_width_error", &VoltsLoop::half_width_error},
                                     std::pair{"offset_error", &VoltsLoop::offset_error}}) {
    if (!csv::has_column(table, name)) continue;
    const auto error = numbers_of(table, name, "V");
    for (std::size_t i = 0; i < error.size(); ++i) {
      if (error[i] < 0)
        csv::refuse(table, i, csv::column_at(table, name), "is negative, allowed: >= 0 V");
      loops[i].*member = error[i];
    }
  }
  return loops;
}

}  // namespace

std::vector<ForceCurve> read_curves(const std::filesystem::path& file, const char* signal) {
  const csv::Table table = csv::read(file);
  const bool has_lateral = csv::has_column(table, "lateral") && std::string(signal) != "lateral";
  const auto d = numbers_of(table, "displacement", "m"), v = numbers_of(table, signal, "V");
  const auto number = csv::has_column(table, "curve") ? numbers_of(table, "curve", "")
                                                      : std::vector<double>(d.size(), 1.0);
  const auto lateral =
      has_lateral ? numbers_of(table, "lateral", "V") : std::vector<double>(d.size());
  std::vector<ForceCurve> curves;
  for (std::size_t begin = 0, end = 0; begin < d.size(); begin = end) {
    ForceCurve curve;
    curve.name = fmt::format("{:g}", number[begin]);
    for (; end < d.size() && number[end] == number[begin]; ++end) {
      curve.displacement.push_back(d[end]);
      curve.normal.push_back(v[end]);
      if (has_lateral) curve.lateral.push_back(lateral[end]);
    }
    order(table, end - 1, curve);
    curves.push_back(std::move(curve));
  }
  return curves;
}

LoopRecord read_loops(const std::filesystem::path& file, bool on_slopes, double skip) {
  const csv::Table table = csv::read(file);
  csv::refuse_former(table, {{"forth", "trace"},
                             {"back", "retrace"},
                             {"normal_forth", "normal_trace"},
                             {"normal_back", "normal_retrace"}});
  LoopRecord record;
  record.file = file;
  const std::size_t at = csv::column_at(table, "load");
  record.load_in_volts = !is_in(table.columns[at].unit, "N");
  if (record.load_in_volts && !is_in(table.columns[at].unit, "V"))
    csv::refuse(table, "load",
                fmt::format("has the unit '{}', allowed: V (of the normal signal, above the free "
                            "level) or N",
                            table.columns[at].unit));
  Columns columns;
  columns.load = csv::numbers(table, at, record.load_in_volts ? "V" : "N");
  if (!on_slopes && csv::has_column(table, "slope"))
    csv::refuse(table, "slope",
                "is not allowed in the loops of the sample, allowed: a flat sample; loops on "
                "slopes belong in wedge.loops");
  columns.slope =
      on_slopes ? numbers_of(table, "slope", "rad") : std::vector<double>(columns.load.size(), 0.0);
  const bool raw = csv::has_column(table, "trace");
  record.has_positions = raw && csv::has_column(table, "position");
  record.loops = raw ? loops_of_raw(table, columns, skip) : loops_of_means(table, columns);
  return record;
}

}  // namespace pulvis::volts
