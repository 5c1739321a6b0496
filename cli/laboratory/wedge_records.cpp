#include "cli/laboratory/wedge_records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "cli/laboratory/volts/loop_rows.hpp"
#include "engine/portable_math.hpp"
#include "scenes/language/csv_table.hpp"
#include "scenes/solve/lab_fit.hpp"

namespace pulvis::wedge {
namespace {

constexpr std::size_t fewest_places = 10;  // of a trace, without the ends

std::vector<double> column(const csv::Table& table, const char* name, const char* unit) {
  return csv::numbers(table, csv::column_at(table, name), unit);
}

std::vector<Loop> loops_of_figures(const csv::Table& table) {
  csv::only(table, {"slope", "load", "half_width", "offset", "half_width_error", "offset_error"});
  const auto slope = column(table, "slope", "rad"), load = column(table, "load", "N");
  const auto width = column(table, "half_width", "V"), offset = column(table, "offset", "V");
  std::vector<Loop> loops;
  for (std::size_t i = 0; i < slope.size(); ++i)
    loops.push_back({slope[i], load[i], width[i], offset[i], {}, {}});
  for (const auto& [name, member] : {std::pair{"half_width_error", &Loop::half_width_error},
                                     std::pair{"offset_error", &Loop::offset_error}}) {
    if (!csv::has_column(table, name)) continue;
    const auto error = column(table, name, "V");
    for (std::size_t i = 0; i < error.size(); ++i) {
      if (error[i] < 0)
        csv::refuse(table, i, csv::column_at(table, name), "is negative, allowed: >= 0 V");
      loops[i].*member = error[i];
    }
  }
  return loops;
}

std::vector<Loop> loops_of_traces(const csv::Table& table, double skip) {
  csv::only(table, {"slope", "load", "trace", "retrace", "position"});
  const auto slope = column(table, "slope", "rad"), load = column(table, "load", "N");
  const auto trace = column(table, "trace", "V"), retrace = column(table, "retrace", "V");
  const auto position =
      csv::has_column(table, "position") ? column(table, "position", "m") : std::vector<double>();
  std::vector<Loop> loops;
  for (std::size_t begin = 0, end = 0; begin < slope.size(); begin = end) {
    end = volts::end_of_loop({slope, load, position}, begin);
    const auto left_out = static_cast<std::size_t>(skip * static_cast<double>(end - begin));
    const std::size_t count = end - begin - 2 * left_out;
    if (count < fewest_places)
      csv::refuse(
          table, end - 1, csv::column_at(table, "trace"),
          fmt::format(
              "the loop has only {} points, {} of them at its ends, allowed: at least {} others",
              end - begin, 2 * left_out, fewest_places));
    const lab::Mean f = lab::correlated_mean(std::span(trace).subspan(begin + left_out, count));
    const lab::Mean b = lab::correlated_mean(std::span(retrace).subspan(begin + left_out, count));
    const double error = 0.5 * portable::hypot(f.error, b.error);
    loops.push_back({slope[begin], load[begin], 0.5 * (f.value - b.value),
                     0.5 * (f.value + b.value), error, error});
  }
  return loops;
}

}  // namespace

// Records of other instruments may have lines before their header: their readers report errors.
bool holds_loops(const std::filesystem::path& file) {
  try {
    const csv::Table table = csv::read(file);
    const auto has = [&](const char* name) { return csv::has_column(table, name); };
    // Names that no other instrument uses, two of former tables among them; read_loops tells which ones are wrong.
    const std::array own{"slope", "half_width", "trace", "retrace", "forth", "back"};
    const auto found = std::ranges::count_if(own, has);
    return found > 1 || (found == 1 && (has("load") || has("offset")));
  } catch (const SceneError&) {
    return false;
  }
}

std::vector<Loop> read_loops(const std::filesystem::path& file, double skip) {
  const csv::Table table = csv::read(file);
  csv::refuse_former(table, {{"forth", "trace"}, {"back", "retrace"}});
  std::vector<Loop> loops = csv::has_column(table, "trace") || csv::has_column(table, "retrace")
                                ? loops_of_traces(table, skip)
                                : loops_of_figures(table);
  if (loops.empty()) csv::refuse(table, "slope", "there is no loop, allowed: rows of numbers");
  return loops;
}

}  // namespace pulvis::wedge
