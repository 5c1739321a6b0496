#include "cli/report_observed.hpp"

#include <cmath>

#include "cli/report_encoding.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

class Observed {
 public:
  Observed(const hdf5::File& file, std::string frame) : file_(file), frame_(std::move(frame)) {}

  bool has(const std::string& name) const { return file_.contains(frame_ + "/" + name); }

  Json density() const {
    return {{"cells", rounded("local_density")},
            {"profile", rounded("density_profile")},
            {"x", rounded("density_grid/x")},
            {"y", rounded("density_grid/y")}};
  }

  Json network(std::size_t lines) const {
    return {{"number", rounded("rose/number")},
            {"force", rounded("rose/force")},
            {"lines", lines},
            {"unit", file_.text_attribute(frame_ + "/contacts/normal_force", "unit")}};
  }

  // Lines to draw, five numbers each: from centre to centre, or from a centre to where a tool acts; force.
  std::vector<float> lines() const {
    std::vector<float> all;
    const std::vector<double> centre = numbers("particle_centre");
    for (const char* group : {"contacts", "tool_contacts"}) {
      const bool pairs = std::string(group) == "contacts";
      const auto ids = file_.read_integers(frame_ + "/" + group + "/ids");
      const auto point = numbers(std::string(group) + "/point");
      const auto force = numbers(std::string(group) + "/normal_force");
      for (std::size_t i = 0; i < force.size(); ++i) {
        const double* from = centre.data() + 2 * ids[2 * i];
        const double* to = pairs ? centre.data() + 2 * ids[2 * i + 1] : point.data() + 2 * i;
        for (const double value : {from[0], from[1], to[0], to[1], force[i]})
          all.push_back(static_cast<float>(value));
      }
    }
    return all;
  }

 private:
  std::vector<double> numbers(const std::string& name) const {
    return file_.read_doubles(frame_ + "/" + name);
  }

  // Six figures, as many as anybody reads; what is no number becomes null.
  Json rounded(const std::string& name) const {
    Json list = Json::array();
    for (const double value : numbers(name)) {
      const double size = value == 0 || !std::isfinite(value)
                              ? 1.0
                              : std::pow(10.0, 5 - std::floor(std::log10(std::abs(value))));
      list.push_back(std::round(value * size) / size);
    }
    return list;
  }

  const hdf5::File& file_;
  std::string frame_;
};

}  // namespace

void add_observed(const hdf5::File& file, const std::string& frame, const std::string& prefix,
                  Json& entry, std::vector<ReportSection>& sections) {
  const Observed observed(file, frame);
  if (observed.has("local_density")) entry["density"] = observed.density();
  if (!observed.has("contacts")) return;
  const std::vector<float> lines = observed.lines();
  entry["network"] = observed.network(lines.size() / 5);
  if (!lines.empty()) sections.push_back({prefix + "network", encoded(lines)});
}

}  // namespace pulvis
