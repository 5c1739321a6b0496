// report.html of the conversion from AFM volts to friction: force curves, loops, the friction line, and what
// contributes to its uncertainty. cli/report/page/volts.js draws them.
#include "cli/laboratory/output/volts_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/report/report_page.hpp"
#include "engine/files/own_files.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_curve_points = 500;  // per curve
constexpr std::size_t most_curves = 6;

Json thin(const std::vector<double>& values) {
  Json json = Json::array();
  const std::size_t stride = 1 + values.size() / most_curve_points;
  for (std::size_t i = 0; i < values.size(); i += stride) json.push_back(values[i]);
  return json;
}

Json fit_json(const volts::Way& way, double from, double until) {
  Json json{{"x", Json::array()}, {"values", Json::array()}};
  for (const double d : {from, until}) {
    json["x"].push_back(d);
    json["values"].push_back(way.free.at(d) + way.contact.at(d));
  }
  return json;
}

// The contact line from its intersection with the zero-force line to the turning point.
Json way_json(const volts::Way& way, double turn) {
  const double touch = way.contact.middle - way.contact.value / way.contact.slope;
  return fit_json(way, touch, turn);
}

Json force_curve_json(const volts::ForceCurve& curve, const volts::CurveFigures& figures) {
  const auto begin = curve.displacement.begin();
  const auto turn = static_cast<std::ptrdiff_t>(curve.turn);
  const double end = curve.displacement[curve.turn];
  const auto part = [&](const std::vector<double>& values, std::ptrdiff_t from,
                        std::ptrdiff_t until) {
    return thin({values.begin() + from, values.begin() + until});
  };
  const auto n = static_cast<std::ptrdiff_t>(curve.displacement.size());
  Json json{{"name", curve.name},
            {"approach",
             {{"x", thin({begin, begin + turn + 1})}, {"values", part(curve.normal, 0, turn + 1)}}},
            {"retract",
             {{"x", part(curve.displacement, turn, n)}, {"values", part(curve.normal, turn, n)}}},
            {"fit", way_json(figures.approach, end)}};
  if (figures.retract && figures.pull_off_at)
    json["pull_off"] = {
        {"x", *figures.pull_off_at},
        {"value", figures.retract->free.at(*figures.pull_off_at) - figures.pull_off.value}};
  return json;
}

Json curve_set_json(const volts::CurveSet& set) {
  Json json = Json::array();
  for (std::size_t i = 0; i < std::min(most_curves, set.curves.size()); ++i)
    json.push_back(force_curve_json(set.curves[i], set.figures[i]));
  return json;
}

Json loops_json(const volts::LoopRecord& record, const std::vector<volts::Input>& inputs,
                const std::string& group) {
  Json json{{"file", record.file.filename().string()},
            {"load_unit", record.load_in_volts ? "V" : "N"},
            {"position_unit", record.has_positions ? "m" : ""},
            {"loops", Json::array()}};
  for (std::size_t i = 0; i < record.loops.size(); ++i) {
    const volts::VoltsLoop& loop = record.loops[i];
    Json one{{"slope", loop.slope},
             {"load", loop.load},
             {"half_width", loop.half_width},
             {"offset", loop.offset}};
    const auto error = std::ranges::find(
        inputs, group + " " + std::to_string(i + 1) + ", half-width", &volts::Input::name);
    if (error != inputs.end()) one["half_width_error"] = error->error;
    if (!loop.traces.trace.empty())
      one["traces"] = {{"position", thin(loop.traces.position)},
                       {"trace", thin(loop.traces.trace)},
                       {"retrace", thin(loop.traces.retrace)}};
    json["loops"].push_back(one);
  }
  return json;
}

}  // namespace

void write_volts_report(const std::filesystem::path& folder, const VoltsReduction& reduction) {
  const volts::Reduced& reduced = reduction.reduced;
  const std::string& named = reduction.loaded.settings.title;
  const std::string title = named.empty() ? "From volts to friction" : named;
  Json head{{"summary", volts_json(reduction)},
            {"settings", reduction.loaded.text},
            {"groups", reduced.groups},
            {"hard", curve_set_json(reduced.hard)},
            {"loops", loops_json(reduced.measured.loops, reduced.inputs, "loops on the sample")}};
  if (reduced.sample) head["sample"] = curve_set_json(*reduced.sample);
  if (reduced.side) head["side"] = curve_set_json(*reduced.side);
  if (reduced.measured.wedge)
    head["wedge"] = loops_json(*reduced.measured.wedge, reduced.inputs, "loops on slopes");
  const volts::Quantity& friction = reduced.result.quantities.front();
  head["histogram"] = {
      {"from", friction.from}, {"until", friction.until}, {"counts", friction.histogram}};
  write_page(folder / "report.html", "volts.html",
             {"units.js", "payload.js", "save.js", "chart.js", "tables.js", "volts.js"},
             {title, head.dump(-1, ' ', false, Json::error_handler_t::replace), {}},
             role::reduction);
}

}  // namespace pulvis
