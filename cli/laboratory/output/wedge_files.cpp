#include "cli/laboratory/output/wedge_files.hpp"

#include <fmt/format.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "cli/laboratory/wedge_records.hpp"
#include "cli/save_scene.hpp"
#include "cli/summary.hpp"
#include "engine/files/own_files.hpp"
#include "scenes/language/counted.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;
constexpr double degree = std::numbers::pi / 180;

Json value_json(const wedge::Value& v) {
  Json json{{"value", v.value}};
  if (v.error) json["error"] = *v.error;
  return json;
}

Json facet_json(const wedge::Facet& facet) {
  Json json{{"slope", facet.slope},
            {"loops", facet.loops},
            {"loads", facet.loads},
            {"half_width_by_load", value_json(facet.half_width)},
            {"offset_by_load", value_json(facet.offset)}};
  if (facet.adhesion) json["adhesion"] = value_json(*facet.adhesion);
  if (facet.friction) json["friction"] = value_json(*facet.friction);
  if (facet.sensitivity) json["sensitivity"] = value_json(*facet.sensitivity);
  return json;
}

std::string value_text(const wedge::Value& v, double scale, const char* format_unit) {
  std::string text = fmt::format("{:.5g}", v.value * scale);
  if (v.error) text += fmt::format(" +- {:.2g}", *v.error * scale);
  return *format_unit == 0 ? text : text + " " + format_unit;
}

std::string cell(const std::optional<wedge::Value>& v) {
  if (!v) return ",";
  return v->error ? fmt::format("{:.9g},{:.4g}", v->value, *v->error)
                  : fmt::format("{:.9g},", v->value);
}

std::string facets_csv(const wedge::Calibration& calibration) {
  std::string text =
      "slope [rad],loops [-],loads [-],half_width [V/N],half_width_error [V/N],offset [V/N],"
      "offset_error [V/N],adhesion [N],adhesion_error [N],friction [-],friction_error [-],"
      "sensitivity [N/V],sensitivity_error [N/V]\n";
  for (const wedge::Facet& f : calibration.facets)
    text +=
        fmt::format("{:.9g},{},{},{},{},{},{},{}\n", f.slope, f.loops, f.loads, cell(f.half_width),
                    cell(f.offset), cell(f.adhesion), cell(f.friction), cell(f.sensitivity));
  return text;
}

const char* word_of(wedge::Choice choice) {
  switch (choice) {
    case wedge::Choice::only:
      return "the only one";
    case wedge::Choice::agreement:
      return "agreement of the loops";
    case wedge::Choice::expected:
      return "wedge.expected_friction";
    case wedge::Choice::undecided:
      return "undecided";
    case wedge::Choice::meeting:
      return "double root";
    case wedge::Choice::given:
      break;
  }
  return "given";
}

std::string roots_text(const wedge::Calibration& c) {
  if (c.choice == wedge::Choice::meeting)
    return "both roots for the friction coefficient lie within this uncertainty\n";
  if (!c.other) return "";
  const std::string other = fmt::format("friction {} with {}", value_text(c.other->friction, 1, ""),
                                        value_text(c.other->sensitivity, 1e9, "nN/V"));
  if (c.choice == wedge::Choice::agreement)
    return fmt::format("the loops contradict the other root, {}\n", other);
  if (c.choice == wedge::Choice::expected)
    return fmt::format("wedge.expected_friction excludes the other root, {}\n", other);
  return fmt::format("or else {}: the loops fit both\n", other);
}

}  // namespace

std::vector<std::string> wedge_warnings(const wedge::Calibration& c) {
  if (c.choice == wedge::Choice::meeting)
    return {
        fmt::format("the friction coefficient is near {:.3g}, where loops on slopes hardly depend "
                    "on it: it and "
                    "the sensitivity are known within their uncertainty only",
                    c.friction.value)};
  if (c.choice != wedge::Choice::undecided) return {};
  return {fmt::format(
      "the loops fit a friction coefficient of {:.4g} and one of {:.4g}, and do not decide between "
      "them: measure loops on a flat facet at several loads and on two different slopes, or give "
      "wedge.expected_friction",
      c.friction.value, c.other->friction.value)};
}

nlohmann::ordered_json wedge_root_json(const wedge::Calibration& c) {
  Json json{{"root", c.root == wedge::Root::upper ? "upper" : "lower"},
            {"root_by", word_of(c.choice)}};
  if (c.other)
    json["other_root"] = {{"friction", value_json(c.other->friction)},
                          {"sensitivity", value_json(c.other->sensitivity)}};
  return json;
}

WedgeReduction wedge_reduction(const lab::LoadedSettings& loaded) {
  const lab::WedgeSpec& spec = loaded.settings.wedge;
  WedgeReduction reduction{loaded, loaded.settings.file.parent_path() / spec.loops, {}, {}};
  reduction.loops = wedge::read_loops(reduction.file, spec.skip);
  try {
    reduction.calibration = wedge::calibrate(
        reduction.loops,
        {spec.adhesion, spec.slope_error, spec.load_error, spec.expected_friction});
  } catch (const std::runtime_error& error) {
    throw SceneError({{reduction.file.string(), 1, 1, "", "wedge", error.what()}});
  }
  return reduction;
}

nlohmann::ordered_json wedge_json(const WedgeReduction& reduction) {
  const wedge::Calibration& calibration = reduction.calibration;
  Json json{{"title", reduction.loaded.settings.title},
            {"version", program_version()},
            {"commit", program_commit()},
            {"friction", value_json(calibration.friction)},
            {"sensitivity", value_json(calibration.sensitivity)}};
  if (calibration.crosstalk) json["crosstalk"] = value_json(*calibration.crosstalk);
  if (calibration.flat_friction) json["flat_friction"] = *calibration.flat_friction;
  json.update(wedge_root_json(calibration));
  for (const wedge::Facet& facet : calibration.facets) json["facets"].push_back(facet_json(facet));
  json["warnings"] = wedge_warnings(calibration);
  return json;
}

void write_wedge(const std::filesystem::path& folder, const WedgeReduction& reduction) {
  write_own(folder / "facets.csv", role::reduction, facets_csv(reduction.calibration));
  save_inputs(folder, reduction.loaded.inputs);
  write_own(folder / "reduce.toml", role::reduction, reduction.loaded.text);
  write_own(folder / "summary.json", role::reduction,
            wedge_json(reduction).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::string wedge_text(const wedge::Calibration& calibration) {
  std::string text;
  for (const wedge::Facet& f : calibration.facets) {
    text += fmt::format("slope {:+.4g} deg, {} at {}: W {}, Delta {}\n", f.slope / degree,
                        counted(f.loops, "loop"), counted(f.loads, "load"),
                        value_text(f.half_width, 1, "V/N"), value_text(f.offset, 1, "V/N"));
    if (f.friction)
      text += fmt::format("  friction {}, sensitivity {}\n", value_text(*f.friction, 1, ""),
                          value_text(*f.sensitivity, 1e9, "nN/V"));
    if (f.adhesion) text += fmt::format("  adhesion {}\n", value_text(*f.adhesion, 1e9, "nN"));
  }
  text +=
      fmt::format("friction {}\nlateral sensitivity {}\n", value_text(calibration.friction, 1, ""),
                  value_text(calibration.sensitivity, 1e9, "nN/V"));
  text += roots_text(calibration);
  if (calibration.crosstalk)
    text +=
        fmt::format("crosstalk of the load {} was subtracted; friction on the flat facet {:.5g}\n",
                    value_text(*calibration.crosstalk, 1, "V/N"), *calibration.flat_friction);
  return text;
}

}  // namespace pulvis
