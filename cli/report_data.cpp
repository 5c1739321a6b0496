#include "cli/report_data.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/report_encoding.hpp"
#include "cli/report_observed.hpp"
#include "engine/hdf5.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_frames = 60;
constexpr std::size_t most_frame_bytes = 11'000'000;  // base64 makes 4/3 of it, deflate much less
constexpr std::size_t most_samples = 5000;

struct CellField {  // one number a cell: a field of one component, or one component of a field
  std::string dataset, label;
  std::size_t component = 0, stored = 1;
  Range range;
};

std::string frame_path(const std::string& frame) { return "/frames/" + frame; }

// At most `most` of `count` positions, evenly, the last one among them.
std::vector<std::size_t> thinned(std::size_t count, std::size_t most) {
  std::vector<std::size_t> kept;
  const std::size_t keep = std::min(count, most);
  for (std::size_t i = 0; i < keep; ++i) {
    kept.push_back(keep == 1 ? count - 1 : i * (count - 1) / (keep - 1));
  }
  return kept;
}

void widen(Range& range, double value) {
  if (!std::isfinite(value)) return;
  range.low = std::min(range.low, value);
  range.high = std::max(range.high, value);
}

constexpr Range nothing_yet{std::numeric_limits<double>::infinity(),
                            -std::numeric_limits<double>::infinity()};

class Reader {
 public:
  explicit Reader(const std::filesystem::path& folder)
      : folder_(folder), file_(hdf5::File::open(folder / "run.h5")) {}

  ReportData read() {
    read_summary();
    read_mesh();
    read_history();
    choose_frames();
    choose_fields();
    find_ranges();
    for (std::size_t i = 0; i < frames_.size(); ++i) add_frame(i);
    describe_fields();
    if (!frames_.empty()) add_observed(file_, frame_path(frames_.back()), head_, sections_);
    return {title_, head_.dump(-1, ' ', false, Json::error_handler_t::replace),
            std::move(sections_)};
  }

 private:
  std::string text(const char* name) const {
    return file_.has_attribute("/", name) ? file_.text_attribute("/", name) : std::string();
  }

  void read_summary() {
    Json summary = Json::object();
    if (std::ifstream stream(folder_ / "summary.json"); stream) {
      const Json read = Json::parse(stream, nullptr, false);  // a broken summary costs no report
      if (read.is_object()) summary = read;
    }
    for (const char* name : {"title", "version", "commit", "scene_hash", "outcome"}) {
      if (!summary.contains(name) && !text(name).empty()) summary[name] = text(name);
    }
    for (const char* name : {"seed", "threads"}) {
      if (!summary.contains(name) && file_.has_attribute("/", name)) {
        summary[name] = file_.unsigned_attribute("/", name);
      }
    }
    const bool named = summary.contains("title") && summary["title"].is_string();
    title_ = named ? summary["title"].get<std::string>() : std::string();
    if (title_.empty()) title_ = std::filesystem::absolute(folder_).filename().string();
    head_["title"] = title_;
    head_["summary"] = summary;
  }

  void read_mesh() {
    const auto quads = file_.read_integers("/mesh/quads");
    const auto particle = file_.read_integers("/mesh/node_particle");
    nodes_ = particle.size();
    cells_ = quads.size() / 4;
    const auto particles = std::set<std::int32_t>(particle.begin(), particle.end()).size();
    head_["mesh"] = {{"nodes", nodes_}, {"cells", cells_}, {"particles", particles}};
    sections_.push_back({"quads", encoded(std::span<const std::int32_t>(quads), 4)});
  }

  void read_history() {
    auto names = file_.datasets_below("/history");
    std::erase(names, "time");
    names.insert(names.begin(), "time");
    const std::size_t samples = file_.shape("/history/time").at(0);
    const auto kept = thinned(samples, most_samples);
    std::vector<float> values;
    head_["samples"] = kept.size();
    head_["series"] = Json::array();
    for (const auto& name : names) {
      auto series = file_.read_doubles("/history/" + name);
      series.resize(samples, std::nan(""));
      for (const auto sample : kept) values.push_back(static_cast<float>(series[sample]));
      head_["series"].push_back(description("/history/" + name, name));
    }
    sections_.push_back({"history", encoded(values)});
  }

  Json description(const std::string& dataset, const std::string& name) const {
    return {{"name", name},
            {"unit", file_.text_attribute(dataset, "unit")},
            {"meaning", file_.text_attribute(dataset, "meaning")}};
  }

  void choose_frames() {
    auto names = file_.children("/frames");
    std::erase_if(names, [&](const auto& frame) {
      return !file_.has_attribute(frame_path(frame), "complete");
    });
    if (names.empty()) return;
    std::size_t numbers = 2 * nodes_;
    for (const auto& name : file_.children(frame_path(names.back()))) {
      numbers += cells_of(name, names);
    }
    const std::size_t most = most_frame_bytes / std::max<std::size_t>(1, numbers * 2);
    for (const auto i : thinned(names.size(), std::clamp<std::size_t>(most, 1, most_frames))) {
      frames_.push_back(names[i]);
    }
  }

  // How many numbers of a cell field the report would carry; 0: it is none.
  std::size_t cells_of(const std::string& name, const std::vector<std::string>& names) const {
    const std::string dataset = frame_path(names.back()) + "/" + name;
    if (name == "position" || !is_of_cells(dataset)) return 0;
    return cells_ * static_cast<std::size_t>(file_.number_attribute(dataset, "components"));
  }

  bool is_of_cells(const std::string& dataset) const {
    return file_.has_attribute(dataset, "place") &&
           file_.text_attribute(dataset, "place") == "cell";
  }

  void choose_fields() {
    if (frames_.empty()) return;
    for (const auto& name : file_.children(frame_path(frames_.back()))) {
      const std::string dataset = frame_path(frames_.back()) + "/" + name;
      if (name == "position" || !is_of_cells(dataset)) continue;
      const auto shape = file_.shape(dataset);
      const std::size_t stored = shape.size() > 1 ? shape[1] : 1;
      const auto used = static_cast<std::size_t>(file_.number_attribute(dataset, "components"));
      for (std::size_t k = 0; k < used; ++k) {
        fields_.push_back({name, label(name, k, used), k, stored, nothing_yet});
      }
    }
  }

  static std::string label(const std::string& name, std::size_t component, std::size_t count) {
    if (count == 1) return name;
    const bool vector = count <= 3;
    return name + " " + (vector ? std::string(1, "xyz"[component]) : std::to_string(component + 1));
  }

  std::vector<double> positions(const std::string& frame) const {
    return file_.read_doubles(frame_path(frame) + "/position");
  }

  std::vector<double> values(const std::string& frame, const CellField& field) const {
    const auto all = file_.read_doubles(frame_path(frame) + "/" + field.dataset);
    std::vector<double> one(all.size() / field.stored);
    for (std::size_t i = 0; i < one.size(); ++i) one[i] = all[i * field.stored + field.component];
    return one;
  }

  void find_ranges() {
    for (const auto& frame : frames_) {
      const auto xy = positions(frame);
      for (std::size_t i = 0; i < xy.size(); ++i) widen(i % 2 == 0 ? x_ : y_, xy[i]);
      for (auto& field : fields_) {
        for (const double value : values(frame, field)) widen(field.range, value);
      }
    }
  }

  void add_frame(std::size_t number) {
    const std::string& frame = frames_[number];
    const std::string prefix = "frame-" + std::to_string(number) + "-";
    const double width = std::max(x_.high - x_.low, y_.high - y_.low);
    auto xy = positions(frame);  // both axes in steps of one length: from 0 to `width`
    for (std::size_t i = 0; i < xy.size(); ++i) xy[i] -= i % 2 == 0 ? x_.low : y_.low;
    sections_.push_back({prefix + "position", encoded(quantised(xy, {0, width}), 2)});
    for (std::size_t k = 0; k < fields_.size(); ++k) {
      const auto codes = quantised(values(frame, fields_[k]), fields_[k].range);
      sections_.push_back({prefix + std::to_string(k), encoded(codes, 1)});
    }
    head_["frames"].push_back({{"time", file_.number_attribute(frame_path(frame), "time")},
                               {"step", file_.number_attribute(frame_path(frame), "step")}});
  }

  void describe_fields() {
    if (frames_.empty()) head_["frames"] = Json::array();
    head_["fields"] = Json::array();
    for (const auto& field : fields_) {
      const bool any = field.range.low <= field.range.high;
      Json entry = description(frame_path(frames_.back()) + "/" + field.dataset, field.label);
      entry["low"] = any ? field.range.low : 0.0;
      entry["high"] = any ? field.range.high : 0.0;
      head_["fields"].push_back(entry);
    }
    const bool placed = x_.low <= x_.high && y_.low <= y_.high;
    head_["low"] = {placed ? x_.low : 0.0, placed ? y_.low : 0.0};
    head_["high"] = {placed ? x_.high : 0.0, placed ? y_.high : 0.0};
  }

  std::filesystem::path folder_;
  hdf5::File file_;
  std::string title_;
  Json head_ = Json::object();
  std::vector<ReportSection> sections_;
  std::vector<std::string> frames_;
  std::vector<CellField> fields_;
  std::size_t nodes_ = 0, cells_ = 0;
  Range x_ = nothing_yet, y_ = nothing_yet;
};

}  // namespace

ReportData read_report_data(const std::filesystem::path& run_folder) {
  return Reader(run_folder).read();
}

}  // namespace pulvis
