#include "cli/campaigns/study/study_quality.hpp"

#include <fmt/format.h>

#include <cmath>

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> loop_flags(const Json& summary) {
  std::vector<std::string> lines;
  if (!summary.contains("loops")) return lines;
  for (const Json& loop : summary["loops"])
    if (loop.contains("settled") && loop["settled"] == false)
      lines.push_back(fmt::format("friction loop of action {:g} without a plateau",
                                  loop.value("action", std::nan(""))));
  return lines;
}

// "hourglass energy 5.4% (limit 3%)": advice is in the report of the run.
std::string without_advice(const std::string& line) { return line.substr(0, line.find("): ") + 1); }

}  // namespace

std::vector<std::string> quality_flags(const StudyResult& result) {
  const Json& s = result.summary;
  if (result.run->scene.afm) return loop_flags(s);
  std::vector<std::string> lines;
  if (!s.contains("quality")) return lines;
  for (const Json& figure : s["quality"])
    if (figure.contains("line")) lines.push_back(without_advice(figure["line"]));
  return lines;
}

}  // namespace pulvis
