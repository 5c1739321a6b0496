#include "cli/laboratory/output/compression_output.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cli/csv_cell.hpp"
#include "cli/laboratory/lab_compression.hpp"
#include "scenes/language/counted.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

struct Compressions {
  lab::Compliance machine;
  std::vector<lab::ReducedCurve> curves;
  std::vector<lab::SimulatedCompression> simulations;
  std::vector<lab::CompressionMisfit> misfits;
  std::vector<lab::OverCurves> over;
  double confidence = 0;
};

Compressions compressed(const lab::LoadedSettings& loaded,
                        const std::vector<std::filesystem::path>& simulations) {
  const lab::Settings& settings = loaded.settings;
  const std::filesystem::path folder = settings.file.parent_path();
  Compressions all;
  all.confidence = settings.analysis.confidence;
  all.machine = lab::machine_of(settings);
  for (const lab::CurveSpec& spec : settings.curves)
    all.curves.push_back(lab::reduce_curve(lab::read_press(folder / spec.press, settings), spec,
                                           settings, all.machine));
  for (const auto& run : simulations)
    all.simulations.push_back(lab::read_compression(run, settings.simulation));
  for (const auto& simulation : all.simulations)
    for (const auto& curve : all.curves) all.misfits.push_back(lab::misfit_of(simulation, curve));
  all.over = lab::over_curves(all.curves);
  return all;
}

std::string curve_csv(const lab::PressCurve& curve) {
  std::vector<double> unloads;
  for (std::size_t i = 0; i < curve.height.size(); ++i) unloads.push_back(i > curve.peak ? 1 : 0);
  return csv_columns({{"pressure [Pa]", &curve.pressure},
                      {"relative_density [-]", &curve.density},
                      {"height [m]", &curve.height},
                      {"is_unloading [-]", &unloads}});
}

Json law_json(const lab::LawFit& law, double confidence) {
  const DensityFit& fit = law.fit;
  if (!fit.not_fitted.empty()) return {{"law", fit.law}, {"not_fitted", fit.not_fitted}};
  Json parameters = Json::array();
  for (const lab::Measured& p : law.parameters) parameters.push_back(measured_json(p, confidence));
  return {
      {"law", fit.law},           {"parameters", parameters},   {"rms", fit.rms},
      {"rms_unit", fit.rms_unit}, {"r_squared", fit.r_squared}, {"rms_density", fit.rms_density}};
}

Json curve_json(const lab::ReducedCurve& reduced, double confidence) {
  const lab::PressCurve& curve = reduced.curve;
  Json json{{"name", reduced.name},
            {"press", reduced.press.string()},
            {"largest_pressure", curve.pressure[curve.peak]},
            {"density_under_it", curve.density[curve.peak]},
            {"density_where_loading_begins", curve.density.front()},
            {"machine_give", curve.machine_give}};
  if (const auto& u = reduced.unloading) {
    json["unloading"] = {{"pressure_left", u->last_pressure},
                         {"relative_density", u->last_density},
                         {"axial_recovery", u->recovery}};
    if (u->modulus) json["unloading"]["modulus"] = *u->modulus;
  }
  const FitRange& range = reduced.range;
  json["fitted"] = {{"samples", range.density.size()}, {"initial_density", range.first_density}};
  if (!range.pressure.empty()) json["fitted"]["from"] = std::ranges::min(range.pressure);
  if (!range.pressure.empty()) json["fitted"]["until"] = std::ranges::max(range.pressure);
  for (const lab::LawFit& law : reduced.laws) json["laws"].push_back(law_json(law, confidence));
  return json;
}

Json machine_json(const lab::Compliance& machine) {
  Json json{{"coefficients", machine.coefficients}};
  if (machine.meeting) {
    json["rms"] = machine.rms;
    json["samples"] = machine.samples;
    json["largest_force"] = machine.largest_force;
  }
  return json;
}

Json misfit_json(const lab::CompressionMisfit& m) {
  if (!m.not_compared.empty())
    return {{"simulation", m.simulation}, {"curve", m.curve}, {"not_compared", m.not_compared}};
  return {{"simulation", m.simulation},
          {"curve", m.curve},
          {"density_from", m.from},
          {"density_until", m.until},
          {"pressure_ratio", std::exp(m.log_pressure)},
          {"rms_log_pressure", m.rms_log_pressure},
          {"rms_density", m.rms_density}};
}

std::vector<std::string> warnings_of(const Compressions& all) {
  std::vector<std::string> told;
  for (const auto& curve : all.curves)
    for (const lab::LawFit& law : curve.laws)
      for (const FitParameter& p : law.fit.parameters)
        if (p.is_at_bound)
          told.push_back(
              fmt::format("{}: {} of {} is at the end of its range: its interval is not meaningful",
                          curve.name, p.name, law.fit.law));
  return told;
}

Json compressions_json(const Compressions& all) {
  Json json{{"kind", "compression"},
            {"confidence", all.confidence},
            {"machine", machine_json(all.machine)}};
  for (const auto& curve : all.curves) json["curves"].push_back(curve_json(curve, all.confidence));
  for (const lab::OverCurves& over : all.over) {
    if (over.sample.count < 2) continue;
    json["over_curves"].push_back({{"law", over.law},
                                   {"name", over.name},
                                   {"unit", over.unit},
                                   {"count", over.sample.count},
                                   {"mean", over.sample.mean},
                                   {"deviation", over.sample.deviation},
                                   {"half_width", *lab::half_width(over.sample, all.confidence)}});
  }
  for (const auto& misfit : all.misfits) json["misfits"].push_back(misfit_json(misfit));
  json["warnings"] = warnings_of(all);
  return json;
}

Json densities_chart(const Compressions& all) {
  Json chart = chart_of("Relative density against axial pressure", "axial pressure", "Pa",
                        "relative density");
  for (const auto& one : all.curves)
    chart["lines"].push_back(chart_line(one.name, "-", one.curve.pressure, one.curve.density));
  for (const auto& s : all.simulations) {
    Json line = chart_line("simulation " + s.name, "-", s.pressure, s.density);
    line["isSimulated"] = true;
    chart["lines"].push_back(line);
  }
  chart["note"] =
      "Loading and unloading of each record, corrected for the compliance of the press.";
  return chart;
}

const char* law_title(const std::string& law) {
  return law == "heckel" ? "Heckel" : law == "kawakita" ? "Kawakita" : "Cooper–Eaton";
}

Json laws_chart(const lab::ReducedCurve& one) {
  Json chart = chart_of("Laws fitted to " + one.name, "axial pressure", "Pa", "relative density");
  chart["lines"].push_back(chart_line("measured", "-", one.range.pressure, one.range.density));
  for (const lab::LawFit& law : one.laws)
    if (law.fit.not_fitted.empty())
      chart["lines"].push_back(
          chart_line(law_title(law.fit.law), "-", one.range.pressure, law.fit.densities));
  return chart;
}

Json laws_table(const Compressions& all) {
  Json table{{"title", "Laws"},
             {"head",
              {"curve", "law", "parameter", "value", "due to scatter", "height", "mass",
               "compliance", "empty press", "last sample", "rms of density"}},
             {"rows", Json::array()}};
  for (const auto& curve : all.curves)
    for (const lab::LawFit& law : curve.laws) {
      if (!law.fit.not_fitted.empty())
        table["rows"].push_back(
            {curve.name, law_title(law.fit.law), "not fitted: " + law.fit.not_fitted});
      for (const lab::Measured& p : law.parameters) {
        Json row{curve.name, law_title(law.fit.law), for_page(p.name),
                 measured_cell(p, all.confidence)};
        for (const char* source :
             {"scatter", "height", "mass", "compliance", "empty press", "last sample"}) {
          const auto found = std::ranges::find(p.contributions, source, &lab::Contribution::source);
          row.push_back(found == p.contributions.end() || !std::isfinite(found->error)
                            ? Json(nullptr)
                            : Json{{"value", found->error}, {"unit", p.unit}});
        }
        row.push_back(law.fit.rms_density);
        table["rows"].push_back(row);
      }
    }
  table["note"] = fmt::format(
      "± is the half width of the {:g} % interval. The next columns are one standard uncertainty "
      "each, due to the scatter about the law and to the stated uncertainties of the instruments.",
      100 * all.confidence);
  return table;
}

Json curves_table(const Compressions& all) {
  Json table{
      {"title", "Curves"},
      {"head",
       {"curve", "density at start of loading", "largest pressure", "density at largest pressure",
        "press deflection", "unloaded density", "axial recovery", "unloading modulus"}},
      {"rows", Json::array()}};
  const auto with_unit = [](double value, const char* unit) {
    return Json{{"value", value}, {"unit", unit}};
  };
  for (const auto& one : all.curves) {
    const lab::PressCurve& curve = one.curve;
    Json row{one.name, curve.density.front(), with_unit(curve.pressure[curve.peak], "Pa"),
             curve.density[curve.peak], with_unit(curve.machine_give, "m")};
    row.push_back(one.unloading ? Json(one.unloading->last_density) : Json(nullptr));
    row.push_back(one.unloading ? Json(one.unloading->recovery) : Json(nullptr));
    row.push_back(one.unloading && one.unloading->modulus ? with_unit(*one.unloading->modulus, "Pa")
                                                          : Json(nullptr));
    table["rows"].push_back(row);
  }
  return table;
}

Json warnings_table(const std::vector<std::string>& warnings) {
  Json table{{"title", "Warnings"}, {"head", Json::array()}, {"rows", Json::array()}};
  for (const std::string& warning : warnings) table["rows"].push_back({warning});
  return table;
}

Json misfits_table(const Compressions& all) {
  Json table{{"title", "Simulations against records"},
             {"head",
              {"simulation", "curve", "densities", "simulated / measured pressure",
               "rms of its logarithm", "rms of density at equal pressure"}},
             {"rows", Json::array()}};
  for (const auto& m : all.misfits) {
    if (!m.not_compared.empty())
      table["rows"].push_back({m.simulation, m.curve, "not compared: " + m.not_compared});
    else
      table["rows"].push_back({m.simulation, m.curve,
                               fmt::format("{:.4f} to {:.4f}", m.from, m.until),
                               std::exp(m.log_pressure), m.rms_log_pressure, m.rms_density});
  }
  return table;
}

std::string compressions_text(const Compressions& all) {
  std::string text;
  for (const auto& curve : all.curves) {
    text += fmt::format("{}: density {:.4f} at {:.4g} MPa", curve.name,
                        curve.curve.density[curve.curve.peak],
                        curve.curve.pressure[curve.curve.peak] * 1e-6);
    if (curve.unloading) text += fmt::format(", {:.4f} unloaded", curve.unloading->last_density);
    text += "\n";
    for (const lab::LawFit& law : curve.laws) {
      text += "  " + law.fit.law + ": ";
      if (!law.fit.not_fitted.empty()) text += "not fitted: " + law.fit.not_fitted;
      for (std::size_t i = 0; i < law.parameters.size(); ++i)
        text += (i > 0 ? ", " : "") + measured_text(law.parameters[i], all.confidence);
      text += "\n";
    }
  }
  for (const auto& m : all.misfits)
    text += m.not_compared.empty() ? fmt::format(
                                         "{} against {}: pressure {:.3f} times the measured one, "
                                         "rms of its logarithm {:.3f}, of the density {:.4f}\n",
                                         m.simulation, m.curve, std::exp(m.log_pressure),
                                         m.rms_log_pressure, m.rms_density)
                                   : fmt::format("{} against {}: not compared: {}\n", m.simulation,
                                                 m.curve, m.not_compared);
  for (const std::string& warning : warnings_of(all)) text += "warning: " + warning + "\n";
  return text;
}

std::string lead_of(const Compressions& all) {
  const std::size_t count = all.curves.size();
  std::string lead = counted(count, "compression curve");
  if (all.machine.meeting)
    lead += fmt::format(
        "; the press deflects {:.4g} mm at {:.4g} kN (record of the empty press, {:.2g} µm rms "
        "about the polynomial)",
        1e3 * all.machine.at(all.machine.largest_force), 1e-3 * all.machine.largest_force,
        1e6 * all.machine.rms);
  else if (all.machine.coefficients.empty())
    lead += "; the press is assumed rigid: no compliance is given";
  return lead + ".";
}

}  // namespace

LabOutput compression_output(const lab::LoadedSettings& loaded,
                             const std::vector<std::filesystem::path>& simulations) {
  const Compressions all = compressed(loaded, simulations);
  const std::string& named = loaded.settings.title;
  LabOutput output;
  output.title = named.empty() ? "Compression curves" : named;
  output.lead = lead_of(all);
  output.summary = compressions_json(all);
  for (const auto& one : all.curves)
    output.files.emplace_back("curve-" + one.name + ".csv", curve_csv(one.curve));
  output.charts.push_back(densities_chart(all));
  for (const auto& one : all.curves) output.charts.push_back(laws_chart(one));
  output.tables.push_back(curves_table(all));
  output.tables.push_back(laws_table(all));
  if (!all.misfits.empty()) output.tables.push_back(misfits_table(all));
  if (const auto warnings = warnings_of(all); !warnings.empty())
    output.tables.push_back(warnings_table(warnings));
  output.told = compressions_text(all);
  return output;
}

}  // namespace pulvis
