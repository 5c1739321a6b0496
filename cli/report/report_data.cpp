#include "cli/report/report_data.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/report/report_encoding.hpp"
#include "cli/report/report_frames.hpp"
#include "cli/report/report_images.hpp"
#include "cli/report/report_solid.hpp"
#include "cli/report/report_space.hpp"
#include "engine/files/hdf5.hpp"
#include "engine/files/input_file.hpp"
#include "scenes/lever/afm_figures.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t frame_budget = 20'000'000;  // bytes; about 15 MB when packed and in base64
constexpr double space_budget = 1.6;              // times that: positions in space compress better
constexpr std::size_t max_samples = 5000;

class Reader {
 public:
  Reader(const std::filesystem::path& folder, std::size_t budget)
      : folder_(folder), file_(hdf5::File::open(folder / "run.h5")) {
    read_summary();
    read_scene();
    read_history();
    add_pictures(budget);
    read_labels();
    add_images(file_, head, sections);
  }

  Json head = Json::object();
  std::vector<ReportSection> sections;
  std::string title;
  bool in_space = false;

 private:
  void add_pictures(std::size_t budget) {
    in_space = has_particles_in_space(file_);
    if (in_space)
      add_space(file_, static_cast<std::size_t>(space_budget * static_cast<double>(budget)), head,
                sections);
    else if (file_.contains("/mesh/hexahedra"))
      add_solid(file_, head, sections);
    else
      add_frames(file_, budget, head, sections);
  }

  std::string text(const char* name) const {
    return file_.has_attribute("/", name) ? file_.text_attribute("/", name) : std::string();
  }

  // The report is written even if a file beside run.h5 is missing or broken.
  std::string text_of(const char* name) const {
    constexpr std::size_t maximum = 64U << 20U;  // bytes
    try {
      return text_of_input(folder_ / name, maximum);
    } catch (const UnfitInput&) {
      return {};
    }
  }

  void read_summary() {
    Json summary = Json::object();
    const Json read = Json::parse(text_of("summary.json"), nullptr, false);
    if (read.is_object()) summary = read;
    for (const char* name : {"title", "version", "commit", "scene_hash", "outcome"}) {
      if (!summary.contains(name) && !text(name).empty()) summary[name] = text(name);
    }
    for (const char* name : {"seed", "threads"}) {
      if (!summary.contains(name) && file_.has_attribute("/", name)) {
        summary[name] = file_.unsigned_attribute("/", name);
      }
    }
    const bool named = summary.contains("title") && summary["title"].is_string();
    const auto folder = std::filesystem::weakly_canonical(folder_).filename().string();
    title = named ? summary["title"].get<std::string>() : std::string();
    if (title.empty()) title = folder;
    head["title"] = title;
    head["folder"] = folder;
    head["summary"] = summary;
    if (!summary.contains("values") || !summary["values"].is_object()) return;
    for (const SeriesInfo& info : afm_figures())
      if (summary["values"].contains(info.name)) {
        head["units"][info.name] = info.unit;
        head["labels"][info.name] = info.label;
      }
  }

  void read_scene() {
    const std::string scene = text_of("scene.toml");
    if (!scene.empty()) head["scene"] = scene;
  }

  // Of fields and series; runs of older versions have none.
  void read_labels() {
    const std::vector<std::string> frames = complete_frames(file_);
    if (!frames.empty()) keep_labels("/frames/" + frames.back());
    if (file_.contains("/particles")) keep_labels("/particles");
    keep_labels("/history");
  }

  void keep_labels(const std::string& group) {
    for (const std::string& name : file_.datasets_below(group))
      if (file_.has_attribute(group + "/" + name, "label"))
        head["labels"][name] = file_.text_attribute(group + "/" + name, "label");
  }

  void read_history() {
    auto names = file_.datasets_below("/history");
    std::erase(names, "time");
    names.insert(names.begin(), "time");
    const std::size_t samples = file_.shape("/history/time").at(0);
    const auto kept = thinned(samples, max_samples);
    std::vector<float> values;
    head["samples"] = kept.size();
    head["all_samples"] = samples;
    head["series"] = Json::array();
    for (const auto& name : names) {
      auto series = file_.read_doubles("/history/" + name);
      series.resize(samples, std::nan(""));
      for (const auto sample : kept) values.push_back(static_cast<float>(series[sample]));
      head["series"].push_back({{"name", name},
                                {"unit", file_.text_attribute("/history/" + name, "unit")},
                                {"meaning", file_.text_attribute("/history/" + name, "meaning")}});
    }
    sections.push_back({"history", encoded(values)});
  }

  std::filesystem::path folder_;
  hdf5::File file_;
};

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

ReportData read_report_data(const std::filesystem::path& run_folder) {
  Reader run(run_folder, frame_budget);
  return {run.title, text_of(run.head), std::move(run.sections), run.in_space};
}

ReportData read_comparison(const std::vector<std::filesystem::path>& run_folders) {
  Json head{{"runs", Json::array()}};
  ReportData data{"Comparison: ", "", {}, false};
  for (std::size_t i = 0; i < run_folders.size(); ++i) {
    Reader run(run_folders[i], frame_budget / run_folders.size());
    for (auto& section : run.sections)
      data.sections.push_back({"run-" + std::to_string(i) + "-" + section.name, section.text});
    data.in_space = data.in_space || run.in_space;
    data.title += (i == 0 ? "" : " · ") + run.title;
    head["runs"].push_back(std::move(run.head));
  }
  data.head = text_of(head);
  return data;
}

}  // namespace pulvis
