#include "cli/report_observed.hpp"

#include "cli/report_encoding.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

class Observed {
 public:
  Observed(const hdf5::File& file, std::string frame) : file_(file), frame_(std::move(frame)) {}

  bool has(const std::string& name) const { return file_.contains(frame_ + "/" + name); }

  Json density() const {  // NaN becomes null
    return {{"cells", numbers("local_density")},
            {"profile", numbers("density_profile")},
            {"x", numbers("density_grid/x")},
            {"y", numbers("density_grid/y")}};
  }

  Json network() const {
    return {{"number", numbers("rose/number")},
            {"force", numbers("rose/force")},
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

  const hdf5::File& file_;
  std::string frame_;
};

}  // namespace

void add_observed(const hdf5::File& file, const std::string& frame, Json& head,
                  std::vector<ReportSection>& sections) {
  const Observed observed(file, frame);
  if (observed.has("local_density")) head["density"] = observed.density();
  if (!observed.has("contacts")) return;
  head["network"] = observed.network();
  sections.push_back({"network", encoded(observed.lines())});
}

}  // namespace pulvis
