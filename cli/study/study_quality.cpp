#include "cli/study/study_quality.hpp"

#include <fmt/format.h>

#include <cmath>

#include "scenes/results/contact_findings.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

constexpr double hourglass_limit = 0.03;       // of the internal energy, as in the report of a run
constexpr double energy_balance_limit = 0.05;  // of runs that tell none

double number_at(const Json& json, const char* key) {
  return json.contains(key) && json[key].is_number() ? json[key].get<double>() : std::nan("");
}

Json part_of(const Json& json, const char* key) {
  return json.contains(key) && json[key].is_object() ? json[key] : Json::object();
}

double peak_of(const StudyResult& result, const char* series) {
  double maximum = 0;
  for (const double value : result.series(series))
    if (std::isfinite(value)) maximum = std::max(maximum, std::abs(value));
  return maximum;
}

class Flags {
 public:
  void judge(const char* name, double value, double limit) {
    if (std::isfinite(value) && std::isfinite(limit) && std::abs(value) > limit)
      lines.push_back(fmt::format("{} {:.3g}% (limit {:.3g}%)", name, 100 * value, 100 * limit));
  }

  std::vector<std::string> lines;
};

void judge_contacts(Flags& flags, const Json& contacts, const Json& limits) {
  flags.judge("closest points not found", number_at(contacts, "unconverged_share"),
              number_at(limits, "unconverged_projections"));
  const double lost = -number_at(contacts, "force_error");
  if (lost > 0) flags.judge("force lost to penetration", lost, ContactFindings::max_force_error);
  flags.judge("force on narrow contacts", number_at(contacts, "narrow_share"),
              ContactFindings::most_narrow);
}

std::vector<std::string> loop_flags(const Json& summary) {
  std::vector<std::string> lines;
  if (!summary.contains("loops")) return lines;
  for (const Json& loop : summary["loops"])
    if (loop.contains("settled") && loop["settled"] == false)
      lines.push_back(
          fmt::format("friction loop of action {:g} without a plateau", number_at(loop, "action")));
  return lines;
}

}  // namespace

std::vector<std::string> quality_flags(const StudyResult& result) {
  const Json& s = result.summary;
  if (result.run->scene.afm) return loop_flags(s);
  if (s.empty()) return {};
  Flags flags;
  const Json limits = part_of(s, "limits");
  const double set = number_at(limits, "energy_balance");
  flags.judge("energy balance error", number_at(s, "energy_balance_error"),
              std::isfinite(set) ? set : energy_balance_limit);
  flags.judge("kinetic over internal energy", number_at(s, "kinetic_ratio"),
              number_at(limits, "kinetic_energy"));
  const double internal =
      std::max(peak_of(result, "energy/elastic"), peak_of(result, "energy/plastic"));
  if (internal > 0)
    flags.judge("hourglass over internal energy", peak_of(result, "energy/hourglass") / internal,
                hourglass_limit);
  flags.judge("penetration over edge length", peak_of(result, "penetration"),
              number_at(limits, "penetration"));
  judge_contacts(flags, part_of(s, "contact_quality"), limits);
  return flags.lines;
}

}  // namespace pulvis
