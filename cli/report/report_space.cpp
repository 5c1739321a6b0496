#include "cli/report/report_space.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "cli/report/report_cell.hpp"
#include "cli/report/report_encoding.hpp"
#include "cli/report/report_fields.hpp"
#include "cli/report/report_fragments.hpp"
#include "cli/report/report_frames.hpp"
#include "cli/report/report_profile.hpp"
#include "cli/report/report_space_mesh.hpp"
#include "cli/report/report_space_observed.hpp"
#include "cli/report/report_tags.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;
using Codes = std::vector<std::uint16_t>;

constexpr std::size_t most_frames = 60, fewest_frames = 12;
constexpr std::size_t levels = 4094;  // of a value between minimum and maximum
constexpr std::size_t slices = 20;    // of the density along z

std::string path_of(const std::string& frame) { return "/frames/" + frame; }

SpaceMesh read_mesh(const hdf5::File& file) {
  return {file.read_integers("/mesh/hexahedra"), file.read_integers("/mesh/cell_particle"),
          file.read_integers("/mesh/node_particle"), file.read_doubles("/mesh/reference")};
}

class SpaceFrames {
 public:
  SpaceFrames(const hdf5::File& file, std::size_t budget, Json& head,
              std::vector<ReportSection>& sections)
      : file_(file), budget_(budget), head_(head), sections_(sections), mesh_(read_mesh(file)) {}

  void add() {
    choose_frames();
    find_ranges();
    sections_.push_back({"cells", encoded(std::span(drawn_.cells()), 8)});
    sections_.push_back({"surface", encoded(std::span(drawn_.surface()), 1)});
    sections_.push_back({"cell-particle", encoded(std::span(drawn_.particles()), 1)});
    add_particle_tags(file_, head_, sections_);
    add_tool_faces(file_, head_, sections_);
    describe();
    for (std::size_t i = 0; i < frames_.size(); ++i) add_frame(i);
  }

 private:
  void choose_frames() {
    const auto names = complete_frames(file_);
    all_ = names.size();
    drawn_ = DrawnSpace::whole(mesh_);
    if (names.empty()) return;
    last_ = path_of(names.back());
    fields_ = cell_fields(file_, last_, {.tensors = true});
    if (affordable() < std::min(most_frames, all_))
      fields_ = cell_fields(file_, last_, {.tensors = false});
    pyramids_ = affordable() < std::min(fewest_frames, all_);
    if (pyramids_) drawn_ = DrawnSpace::pyramids(mesh_);
    const auto most = std::clamp<std::size_t>(affordable(), 1, most_frames);
    for (const auto i : thinned(all_, most)) frames_.push_back(path_of(names[i]));
  }

  // Particle values compress to almost nothing.
  std::size_t affordable() const {
    const auto of_cells = std::ranges::count(fields_, false, &CellField::of_particle);
    std::size_t bytes =
        6 * drawn_.node_count() + 2 * drawn_.cell_count() * static_cast<std::size_t>(of_cells);
    for (const auto& [dots, each] : {std::pair("/bonds/area", 10), {"/cracks/position", 12}})
      if (file_.contains(last_ + dots))
        bytes += static_cast<std::size_t>(each) *
                 std::min<std::size_t>(max_dots, file_.shape(last_ + dots).at(0));
    return budget_ / std::max<std::size_t>(1, bytes);
  }

  ReportCell<ThreeD> cell(const std::string& frame) const {
    return {file_, frame, mesh_.node_particle};
  }
  std::vector<double> positions(const std::string& frame, const ReportCell<ThreeD>& cell) const {
    return drawn_.positions(cell.inside(file_.read_doubles(frame + "/position")));
  }
  std::vector<double> values(const std::string& frame, const CellField& field) const {
    return drawn_.values(
        cell_values(file_, frame, field, {mesh_.hexahedra, 8, mesh_.cell_particle}));
  }

  void find_ranges() {
    for (const auto& frame : frames_) {
      const ReportCell<ThreeD> of_frame = cell(frame);
      const auto xyz = positions(frame, of_frame);
      for (std::size_t i = 0; i < xyz.size(); ++i) widen(box_[i % 3], xyz[i]);
      for (const Point3& corner : of_frame.corners())
        for (std::size_t k = 0; k < 3; ++k) widen(box_[k], corner[k]);
      for (auto& field : fields_)
        for (const double value : values(frame, field)) widen(field.range, value);
    }
    leave_out_empty(fields_);
    if (!(box_[0].low <= box_[0].high)) box_ = {};
  }

  double width() const {
    double most = 0;
    for (const Range& range : box_) most = std::max(most, range.high - range.low);
    return most;
  }

  // All axes with the same step length: from 0 to the width.
  Codes position_codes(const std::string& frame, const ReportCell<ThreeD>& cell) const {
    auto xyz = positions(frame, cell);
    for (std::size_t i = 0; i < xyz.size(); ++i) xyz[i] -= box_[i % 3].low;
    return quantised(xyz, {0, width()});
  }

  void add_frame(std::size_t number) {
    const std::string& frame = frames_[number];
    const std::string prefix = "frame-" + std::to_string(number) + "-";
    const ReportCell<ThreeD> of_frame = cell(frame);
    Codes codes = position_codes(frame, of_frame);
    if (number == 0) first_ = codes;
    if (number > 0)  // wraps around; so does the decoder
      for (std::size_t i = 0; i < codes.size(); ++i)
        codes[i] = static_cast<std::uint16_t>(codes[i] - first_[i]);
    sections_.push_back({prefix + "position", encoded(std::span<const std::uint16_t>(codes), 3)});
    for (std::size_t k = 0; k < fields_.size(); ++k) {
      const auto shown = quantised(values(frame, fields_[k]), fields_[k].range, levels);
      sections_.push_back({prefix + std::to_string(k), encoded(shown, 1)});
    }
    add_tool_corners(file_, frame, prefix, sections_);
    head_["frames"].push_back({{"time", file_.number_attribute(frame, "time")},
                               {"step", file_.number_attribute(frame, "step")}});
    if (of_frame.here())
      head_["frames"].back()["cell"] = of_frame.numbers();
    else  // a powder without walls has no ends
      head_["frames"].back()["profile"] = profile(frame);
    add_space_observed(file_, frame, prefix, of_frame, head_["frames"].back(), sections_);
    add_space_bonds(file_, frame, prefix, of_frame, head_["frames"].back(), sections_);
  }

  Json profile(const std::string& frame) const {
    const auto xyz = file_.read_doubles(frame + "/position");
    const CrossSection section = cross_section(file_, frame, xyz);
    const auto [density, edges] = density_along_z(xyz, mesh_.hexahedra, section, slices);
    return {{"profile", density}, {"y", edges}, {"bound", section.bound}};
  }

  void describe() {
    const std::set particles(mesh_.node_particle.begin(), mesh_.node_particle.end());
    head_["mesh"] = {{"dimension", 3},
                     {"nodes", mesh_.nodes()},
                     {"cells", mesh_.cells()},
                     {"particles", particles.size()},
                     {"drawn_nodes", drawn_.node_count()},
                     {"drawn_cells", drawn_.cell_count()},
                     {"pyramids", pyramids_}};
    head_["all_frames"] = all_;
    head_["frames"] = Json::array();
    head_["fields"] = Json::array();
    for (const CellField& field : fields_) head_["fields"].push_back(described(field, levels));
    for (const Range& range : box_) {
      head_["low"].push_back(range.low);
      head_["high"].push_back(range.high);
    }
  }

  const hdf5::File& file_;
  std::size_t budget_, all_ = 0;
  Json& head_;
  std::vector<ReportSection>& sections_;
  SpaceMesh mesh_;
  DrawnSpace drawn_;
  bool pyramids_ = false;
  std::string last_;  // path of the last frame
  std::vector<std::string> frames_;
  std::vector<CellField> fields_;
  Codes first_;  // positions of the first frame
  std::array<Range, 3> box_{nothing_yet, nothing_yet, nothing_yet};
};

}  // namespace

bool has_particles_in_space(const hdf5::File& file) {
  return file.contains("/mesh/hexahedra") && file.contains("/particles");
}

void add_space(const hdf5::File& file, std::size_t budget, Json& head,
               std::vector<ReportSection>& sections) {
  SpaceFrames(file, budget, head, sections).add();
}

}  // namespace pulvis
