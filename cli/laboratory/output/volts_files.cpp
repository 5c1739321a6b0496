#include "cli/laboratory/output/volts_files.hpp"

#include <fmt/format.h>

#include "cli/csv_cell.hpp"
#include "cli/laboratory/output/wedge_files.hpp"
#include "cli/save_scene.hpp"
#include "cli/summary.hpp"
#include "engine/files/own_files.hpp"
#include "scenes/language/counted.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

Json mean_json(const lab::Mean& mean) { return {{"value", mean.value}, {"error", mean.error}}; }

Json quantity_json(const volts::Quantity& quantity, const std::vector<std::string>& groups) {
  Json json{{"value", quantity.value}, {"error", quantity.error},
            {"low", quantity.low},     {"high", quantity.high},
            {"mean", quantity.mean},   {"linear_error", quantity.linear}};
  for (std::size_t g = 0; g < groups.size(); ++g)
    json["contributions"][groups[g]] = {{"share", quantity.shares[g].drawn},
                                        {"linear", quantity.shares[g].linear}};
  return json;
}

// The pull-off work is in V m until the normal calibration is known.
Json curves_json(const volts::CurveSet& set, double normal) {
  Json json{{"file", set.file.filename().string()}, {"slope", mean_json(set.mean.slope)}};
  for (std::size_t i = 0; i < set.figures.size(); ++i) {
    const volts::CurveFigures& figures = set.figures[i];
    Json one{{"curve", set.curves[i].name},
             {"approach",
              {{"value", figures.approach.contact.slope}, {"error", figures.approach.slope_error}}},
             {"curvature", figures.approach.curvature},
             {"noise", figures.noise}};
    if (figures.retract)
      one["retract"] = {{"value", figures.retract->contact.slope},
                        {"error", figures.retract->slope_error}};
    one["pull_off_volts"] = mean_json(figures.pull_off);
    one["pull_off_force"] = normal * figures.pull_off.value;
    one["pull_off_work"] = normal * figures.work;
    if (figures.crosstalk) one["crosstalk"] = mean_json(*figures.crosstalk);
    json["curves"].push_back(one);
  }
  return json;
}

Json inputs_json(const volts::Reduced& reduced) {
  Json json = Json::array();
  for (const volts::Input& input : reduced.inputs)
    json.push_back({{"name", input.name},
                    {"unit", input.unit},
                    {"group", reduced.groups[static_cast<std::size_t>(input.group)]},
                    {"value", input.value},
                    {"error", input.error}});
  return json;
}

const volts::Quantity& named(const volts::MonteCarlo& result, std::string_view name) {
  return *std::ranges::find(result.quantities, name, &volts::Quantity::name);
}

std::string loops_csv(const volts::Reduced& reduced) {
  std::string text =
      "load [N],force [N],friction [-],friction_error [-],friction_low [-],friction_high [-]\n";
  const volts::Outcome& out = reduced.result.nominal;
  for (std::size_t i = 0; i < out.load.size(); ++i) {
    const volts::Quantity& mu = named(reduced.result, fmt::format("friction_of_loop_{}", i + 1));
    text += fmt::format("{:.9g},{:.9g},{:.9g},{:.4g},{:.9g},{:.9g}\n", out.load[i], out.force[i],
                        mu.value, mu.error, mu.low, mu.high);
  }
  return text;
}

std::string contributions_csv(const volts::Reduced& reduced) {
  std::string text = "quantity,input,share [-],linear [-]\n";
  for (const volts::Quantity& quantity : reduced.result.quantities)
    for (std::size_t g = 0; g < reduced.groups.size(); ++g)
      text += fmt::format("{},{},{:.6g},{:.6g}\n", quantity.name, csv_word(reduced.groups[g]),
                          quantity.shares[g].drawn, quantity.shares[g].linear);
  return text;
}

std::string line_of(const char* label, const volts::Quantity& q, double scale, const char* unit,
                    double confidence) {
  return fmt::format("{:<32} {:.5g} +- {:.2g} {}({:g} %: {:.4g} to {:.4g})\n", label,
                     q.value * scale, q.error * scale, unit, 100 * confidence, q.low * scale,
                     q.high * scale);
}

}  // namespace

VoltsReduction volts_reduction(const lab::LoadedSettings& loaded) {
  const lab::Settings& settings = loaded.settings;
  const std::filesystem::path folder = settings.file.parent_path();
  volts::WedgeLoops wedge;
  if (!settings.wedge.loops.empty()) wedge.file = folder / settings.wedge.loops;
  wedge.known = {settings.wedge.adhesion, settings.wedge.slope_error, settings.wedge.load_error,
                 settings.wedge.expected_friction};
  wedge.skip = settings.wedge.skip;
  return {loaded, volts::reduce(settings.volts, wedge, folder, settings.analysis.confidence)};
}

std::vector<std::string> volts_files() {
  return {"reduce.toml", "summary.json", "report.html", "friction.csv", "contributions.csv"};
}

nlohmann::ordered_json volts_json(const VoltsReduction& reduction) {
  const lab::Settings& settings = reduction.loaded.settings;
  const volts::Reduced& reduced = reduction.reduced;
  const volts::MonteCarlo& result = reduced.result;
  Json json{
      {"title", settings.title},
      {"version", program_version()},
      {"commit", program_commit()},
      {"lateral", settings.volts.lateral() == volts::LateralMethod::wedge ? "wedge" : "test_probe"},
      {"confidence", settings.analysis.confidence},
      {"draws", result.draws},
      {"failed_draws", result.failed},
      {"seed", settings.volts.afm.seed}};
  for (const volts::Quantity& quantity : result.quantities)
    json[quantity.name] = quantity_json(quantity, reduced.groups);
  if (reduced.slopes) {
    json["slopes"] = wedge_root_json(*reduced.slopes);
    json["warnings"] = wedge_warnings(*reduced.slopes);
  }
  if (reduced.other_root)
    for (const char* name : {"friction", "lateral_sensitivity"})
      json["with_other_root"][name] =
          quantity_json(named(*reduced.other_root, name), reduced.groups);
  for (std::size_t i = 0; i < result.nominal.load.size(); ++i)
    json["loops"].push_back({{"load", result.nominal.load[i]},
                             {"force", result.nominal.force[i]},
                             {"friction", result.nominal.friction_of_loop[i]}});
  json["force_curves"]["hard"] = curves_json(reduced.hard, result.nominal.normal);
  if (reduced.sample)
    json["force_curves"]["sample"] = curves_json(*reduced.sample, result.nominal.normal);
  if (reduced.side) json["side_contacts"] = mean_json(reduced.side->mean.slope);
  if (reduced.measured.crosstalk) json["crosstalk"] = mean_json(*reduced.measured.crosstalk);
  json["inputs"] = inputs_json(reduced);
  return json;
}

void write_volts(const std::filesystem::path& folder, const VoltsReduction& reduction) {
  write_own(folder / "friction.csv", role::reduction, loops_csv(reduction.reduced));
  write_own(folder / "contributions.csv", role::reduction, contributions_csv(reduction.reduced));
  save_inputs(folder, reduction.loaded.inputs);
  write_own(folder / "reduce.toml", role::reduction, reduction.loaded.text);
  write_own(folder / "summary.json", role::reduction,
            volts_json(reduction).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::string volts_text(const VoltsReduction& reduction) {
  const volts::Reduced& reduced = reduction.reduced;
  const volts::MonteCarlo& result = reduced.result;
  const double confidence = reduction.loaded.settings.analysis.confidence;
  const auto line = [&](const char* label, const char* name, double scale, const char* unit) {
    return line_of(label, named(result, name), scale, unit, confidence);
  };
  const lab::Mean& slope = reduced.hard.mean.slope;
  std::string text = fmt::format("{:<32} {:.5g} +- {:.2g} V/nm over {}\n", "slope of force curves",
                                 slope.value * 1e-9, slope.error * 1e-9,
                                 counted(reduced.hard.curves.size(), "curve"));
  if (reduced.measured.crosstalk)
    text += fmt::format("{:<32} {:.5g} +- {:.2g} V/V, removed\n", "crosstalk",
                        reduced.measured.crosstalk->value, reduced.measured.crosstalk->error);
  text += line("normal sensitivity", "normal_sensitivity", 1e9, "nN/V ");
  text += line("lateral sensitivity", "lateral_sensitivity", 1e9, "nN/V ");
  text += line("adhesion, pull-off", "adhesion", 1e9, "nN ");
  if (result.nominal.adhesion_of_line)
    text += line("adhesion, friction at zero load", "adhesion_of_line", 1e9, "nN ");
  const bool has_line = result.nominal.adhesion_of_line.has_value();
  text += line(has_line ? "friction, slope over the loads" : "friction", "friction", 1, "");
  if (has_line) text += line("friction, mean of the loops", "friction_of_loops", 1, "");
  if (reduced.other_root) {
    const volts::MonteCarlo& other = *reduced.other_root;
    text += line_of("or, with the other root: lateral", named(other, "lateral_sensitivity"), 1e9,
                    "nN/V ", confidence);
    text +=
        line_of("or, with the other root: friction", named(other, "friction"), 1, "", confidence);
  }
  text += "contributions to the variance of the friction coefficient\n";
  for (std::size_t g = 0; g < reduced.groups.size(); ++g) {
    const volts::Share& share = named(result, "friction").shares[g];
    if (share.drawn == 0 && share.linear == 0) continue;
    text += fmt::format("  {:<36} {:5.1f} % (linear {:.1f} %)\n", reduced.groups[g],
                        100 * share.drawn, 100 * share.linear);
  }
  if (result.failed > 0)
    text += fmt::format("{} of {} draws gave no valid friction and were left out\n", result.failed,
                        result.draws);
  return text;
}

}  // namespace pulvis
