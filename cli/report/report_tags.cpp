#include "cli/report/report_tags.hpp"

#include <algorithm>
#include <cstdint>

#include "cli/report/report_encoding.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

Json names_of(const hdf5::File& file, const std::string& dataset) {
  return file.has_attribute(dataset, "names")
             ? Json(lines_of(file.text_attribute(dataset, "names")))
             : Json::array();
}

// A tool's lines join its corners in order, and the last one with the first.
Json tools_of(const hdf5::File& file) {
  Json tools = names_of(file, "/tools/line_tool");
  std::vector<int> count(tools.size());
  for (const std::int32_t tool : file.read_integers("/tools/line_tool"))
    ++count.at(static_cast<std::size_t>(tool));
  int first = 0;
  for (std::size_t t = 0; t < tools.size(); ++t) {
    tools[t] = {{"name", tools[t]}, {"first", first}, {"count", count[t]}};
    first += count[t];
  }
  return tools;
}

}  // namespace

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    lines.push_back(text.substr(from, end - from));
    from = end + 1;
  }
  return lines;
}

void add_particle_tags(const hdf5::File& file, Json& head, std::vector<ReportSection>& sections) {
  head["tags"] = Json::array();
  for (const std::string name : {"material", "class"}) {
    const std::string dataset = "/particles/" + name;
    if (!file.contains(dataset)) continue;
    head["tags"].push_back({{"name", name}, {"names", names_of(file, dataset)}});
    sections.push_back({"particle-" + name, encoded(file.read_integers(dataset), 1)});
  }
}

void add_tool_faces(const hdf5::File& file, Json& head, std::vector<ReportSection>& sections) {
  if (!file.contains("/tools/quads")) return;
  const std::string of_tool = "/tools/quad_tool";
  const auto names = lines_of(file.text_attribute(of_tool, "names"));
  const auto kinds = lines_of(file.text_attribute(of_tool, "kinds"));
  head["tools"] = Json::array();
  for (std::size_t t = 0; t < names.size(); ++t)
    head["tools"].push_back({{"name", names[t]}, {"kind", kinds.at(t)}});
  sections.push_back({"tool-quads", encoded(file.read_integers("/tools/quads"), 4)});
  sections.push_back({"tool-of-quad", encoded(file.read_integers(of_tool), 1)});
}

void add_tags(const hdf5::File& file, const PlaneMesh& mesh, const DrawnMesh& drawn, Json& head,
              std::vector<ReportSection>& sections) {
  sections.push_back({"cell-particle", encoded(drawn.particles(mesh), 1)});
  add_particle_tags(file, head, sections);
  if (file.contains("/tools")) head["tools"] = tools_of(file);
}

void add_tool_corners(const hdf5::File& file, const std::string& frame, const std::string& prefix,
                      std::vector<ReportSection>& sections) {
  if (!file.contains(frame + "/tools/outline")) return;
  const std::vector<double> corners = file.read_doubles(frame + "/tools/outline");
  sections.push_back(
      {prefix + "tools", encoded(std::vector<float>(corners.begin(), corners.end()))});
}

}  // namespace pulvis
