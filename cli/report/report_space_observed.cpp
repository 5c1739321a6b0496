#include "cli/report/report_space_observed.hpp"

#include "cli/report/report_encoding.hpp"

namespace pulvis {
namespace {

// Lines to draw, seven numbers each: from centre to centre, or from a centre to where a tool acts; normal force.
std::vector<float> space_network_lines(const hdf5::File& file, const std::string& frame) {
  std::vector<float> lines;
  const std::vector<double> centre = file.read_doubles(frame + "/particle_centre");
  const auto add_point = [&](const std::vector<double>& points, std::size_t number) {
    for (std::size_t k = 0; k < 3; ++k) lines.push_back(static_cast<float>(points[3 * number + k]));
  };
  for (const char* name : {"/contacts", "/tool_contacts"}) {
    const std::string group = frame + name;
    const bool pairs = group == frame + "/contacts";
    const auto ids = file.read_integers(group + "/ids");
    const auto point = file.read_doubles(group + "/point");
    const auto force = file.read_doubles(group + "/normal_force");
    for (std::size_t i = 0; i < force.size(); ++i) {
      add_point(centre, static_cast<std::size_t>(ids[2 * i]));
      if (pairs)
        add_point(centre, static_cast<std::size_t>(ids[2 * i + 1]));
      else
        add_point(point, i);
      lines.push_back(static_cast<float>(force[i]));
    }
  }
  return lines;
}

}  // namespace

void add_space_observed(const hdf5::File& file, const std::string& frame, const std::string& prefix,
                        nlohmann::ordered_json& entry, std::vector<ReportSection>& sections) {
  if (!file.contains(frame + "/contacts")) return;
  const std::vector<float> lines = space_network_lines(file, frame);
  entry["network"] = {{"lines", lines.size() / 7},
                      {"unit", file.text_attribute(frame + "/contacts/normal_force", "unit")}};
  if (!lines.empty()) sections.push_back({prefix + "network", encoded(lines)});
}

}  // namespace pulvis
