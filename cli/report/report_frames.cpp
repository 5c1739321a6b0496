#include "cli/report/report_frames.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "cli/report/report_cell.hpp"
#include "cli/report/report_encoding.hpp"
#include "cli/report/report_fields.hpp"
#include "cli/report/report_mesh.hpp"
#include "cli/report/report_observed.hpp"
#include "cli/report/report_tags.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_frames = 60, min_frames = 12;
constexpr std::size_t sectors = 12;  // of a particle drawn as a fan
constexpr std::size_t fine_levels = 4094,
                      coarse_levels = 254;  // of a value between minimum and maximum

std::string frame_path(const std::string& frame) { return "/frames/" + frame; }

class Frames {
 public:
  Frames(const hdf5::File& file, std::size_t budget, Json& head,
         std::vector<ReportSection>& sections)
      : file_(file), budget_(budget), head_(head), sections_(sections) {}

  void add() {
    read_mesh();
    choose_frames();
    find_ranges();
    sections_.push_back({"cells", encoded(std::span<const std::int32_t>(drawn_.cells()), 4)});
    if (!frames_.empty()) add_tags(file_, mesh_, drawn_, head_, sections_);
    for (std::size_t i = 0; i < frames_.size(); ++i) add_frame(i);
    describe();
  }

 private:
  void read_mesh() {
    mesh_.quads = file_.read_integers("/mesh/quads");
    mesh_.cell_particle = file_.read_integers("/mesh/cell_particle");
    mesh_.node_particle = file_.read_integers("/mesh/node_particle");
    mesh_.reference = file_.read_doubles("/mesh/reference");
  }

  // Chooses what to draw in how many frames, so that it fits.
  void choose_frames() {
    const auto names = complete_frames(file_);
    all_ = names.size();
    drawn_ = DrawnMesh::whole(mesh_);
    if (names.empty()) return;
    last_ = frame_path(names.back());
    choose_fields(true);
    fans_ = affordable() < std::min(min_frames, all_) && mesh_.cells() > 0;
    if (fans_) {
      drawn_ = DrawnMesh::fans(mesh_, sectors);
      choose_fields(false);
    }
    const auto maximum = std::clamp<std::size_t>(affordable(), 1, max_frames);
    for (const auto i : thinned(all_, maximum)) frames_.push_back(names[i]);
  }

  std::size_t affordable() const {
    std::size_t bytes = 4 * drawn_.node_count();
    bytes += (fans_ ? 1 : 2) * drawn_.cell_count() * fields_.size();
    for (const auto& [lines, each] :
         {std::pair("/contacts/normal_force", 10), {"/bonds/length", 8}, {"/cracks/start", 10}})
      if (file_.contains(last_ + lines))
        bytes += static_cast<std::size_t>(each) * file_.shape(last_ + lines).at(0);
    return budget_ / std::max<std::size_t>(1, bytes);
  }

  void choose_fields(bool tensors) {
    fields_ = cell_fields(file_, last_, {.tensors = tensors, .particles = false});
  }

  ReportCell<TwoD> cell(const std::string& frame) const {
    return {file_, frame_path(frame), mesh_.node_particle};
  }
  std::vector<double> positions(const std::string& frame, const ReportCell<TwoD>& cell) const {
    return drawn_.positions(cell.inside(file_.read_doubles(frame_path(frame) + "/position")));
  }

  std::vector<double> values(const std::string& frame, const CellField& field) const {
    return drawn_.values(
        cell_values(file_, frame_path(frame), field, {mesh_.quads, 4, mesh_.cell_particle}));
  }

  void find_ranges() {
    for (const auto& frame : frames_) {
      const ReportCell<TwoD> of_frame = cell(frame);
      const auto xy = positions(frame, of_frame);
      for (std::size_t i = 0; i < xy.size(); ++i) widen(i % 2 == 0 ? x_ : y_, xy[i]);
      for (const Point& corner : of_frame.corners()) {
        widen(x_, corner[0]);
        widen(y_, corner[1]);
      }
      for (auto& field : fields_)
        for (const double value : values(frame, field)) widen(field.range, value);
    }
    leave_out_empty(fields_);
    if (!(x_.low <= x_.high && y_.low <= y_.high)) x_ = y_ = {0, 0};
  }

  void add_frame(std::size_t number) {
    const std::string& frame = frames_[number];
    const std::string prefix = "frame-" + std::to_string(number) + "-";
    const double width = std::max(x_.high - x_.low, y_.high - y_.low);
    const std::size_t levels = fans_ ? coarse_levels : fine_levels;
    const ReportCell<TwoD> of_frame = cell(frame);
    auto xy = positions(frame, of_frame);  // both axes with the same step length: from 0 to `width`
    for (std::size_t i = 0; i < xy.size(); ++i) xy[i] -= i % 2 == 0 ? x_.low : y_.low;
    sections_.push_back({prefix + "position", encoded(quantised(xy, {0, width}), 2)});
    for (std::size_t k = 0; k < fields_.size(); ++k) {
      const auto codes = quantised(values(frame, fields_[k]), fields_[k].range, levels);
      sections_.push_back({prefix + std::to_string(k), encoded(codes, 1)});
    }
    Json entry{{"time", file_.number_attribute(frame_path(frame), "time")},
               {"step", file_.number_attribute(frame_path(frame), "step")}};
    if (of_frame.here()) entry["cell"] = of_frame.numbers();
    add_observed(file_, frame_path(frame), prefix, of_frame, entry, sections_);
    add_tool_corners(file_, frame_path(frame), prefix, sections_);
    head_["frames"].push_back(entry);
  }

  void describe() {
    const std::set particles(mesh_.node_particle.begin(), mesh_.node_particle.end());
    head_["mesh"] = {{"nodes", mesh_.nodes()},
                     {"cells", mesh_.cells()},
                     {"particles", particles.size()},
                     {"drawn_nodes", drawn_.node_count()},
                     {"drawn_cells", drawn_.cell_count()},
                     {"fans", fans_ ? sectors : 0}};
    head_["all_frames"] = all_;
    if (frames_.empty()) head_["frames"] = Json::array();
    head_["fields"] = Json::array();
    for (const CellField& field : fields_)
      head_["fields"].push_back(described(field, fans_ ? coarse_levels : fine_levels));
    head_["low"] = {x_.low, y_.low};
    head_["high"] = {x_.high, y_.high};
  }

  const hdf5::File& file_;
  std::size_t budget_, all_ = 0;
  Json& head_;
  std::vector<ReportSection>& sections_;
  PlaneMesh mesh_;
  DrawnMesh drawn_;
  bool fans_ = false;
  std::string last_;  // path of the last frame
  std::vector<std::string> frames_;
  std::vector<CellField> fields_;
  Range x_ = nothing_yet, y_ = nothing_yet;
};

}  // namespace

std::vector<std::string> complete_frames(const hdf5::File& file) {
  if (!file.contains("/frames")) return {};
  auto names = file.children("/frames");
  std::erase_if(
      names, [&](const auto& frame) { return !file.has_attribute(frame_path(frame), "complete"); });
  return names;
}

std::vector<std::size_t> thinned(std::size_t count, std::size_t maximum) {
  std::vector<std::size_t> kept;
  const std::size_t keep = std::min(count, maximum);
  for (std::size_t i = 0; i < keep; ++i)
    kept.push_back(keep == 1 ? count - 1 : i * (count - 1) / (keep - 1));
  return kept;
}

void add_frames(const hdf5::File& file, std::size_t budget, Json& head,
                std::vector<ReportSection>& sections) {
  Frames(file, budget, head, sections).add();
}

}  // namespace pulvis
