// report.html of a reduction: the curves on a common grid of distances, and each run's records on a
// common clock. cli/report/page/reduction.js draws them.
#include "cli/laboratory/output/reduction_report.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "cli/report/report_encoding.hpp"
#include "cli/report/report_page.hpp"
#include "engine/files/own_files.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_samples = 4000;  // per curve

class ReportMaker {
 public:
  explicit ReportMaker(const Reduction& reduction) : all_(reduction) {
    const lab::AnalysisSpec& analysis = all_.loaded.settings.analysis;
    double longest = 0;
    for (const lab::ReducedRun& run : all_.runs)
      longest = std::max(longest, run.curve.distance.back());
    step_ = std::max(analysis.distance_step, longest / max_samples);
  }

  ReportData made() {
    add_curves();
    for (std::size_t i = 0; i < all_.runs.size(); ++i) add_record(i);
    head_["summary"] = reduction_json(all_);
    const std::string& named = all_.loaded.settings.title;
    const std::string title = named.empty() ? "Sliding-plate tests" : named;
    head_["title"] = title;
    return {title, head_.dump(-1, ' ', false, Json::error_handler_t::replace),
            std::move(sections_)};
  }

 private:
  using Columns = std::vector<std::vector<double>>;

  // Columns of one table, padded to equal length: one section of the page.
  void add_table(const std::string& name, Json columns, const Columns& values) {
    std::size_t rows = 0;
    for (const auto& column : values) rows = std::max(rows, column.size());
    std::vector<float> numbers;
    for (const auto& column : values)
      for (std::size_t i = 0; i < rows; ++i)
        numbers.push_back(i < column.size() ? static_cast<float>(column[i])
                                            : std::numeric_limits<float>::quiet_NaN());
    head_["tables"][name] = {{"rows", rows}, {"columns", std::move(columns)}};
    sections_.push_back({name, encoded(numbers)});
  }

  static Json column(const std::string& name, const char* unit, const char* kind) {
    return {{"name", name}, {"unit", unit}, {"kind", kind}};
  }

  void add_runs(Json& columns, Columns& values, const char* unit,
                std::vector<double> lab::Curve::*member) const {
    for (const lab::ReducedRun& run : all_.runs) {
      columns.push_back(column(run.name, unit, "run"));
      values.push_back(lab::on_grid(run.curve.distance, run.curve.*member, step_));
    }
  }

  void add_curves() {
    Json friction = Json::array({column("distance", "m", "x")});
    Json shear = friction, mean = friction;
    Columns frictions(1), shears(1), means(4);
    add_runs(friction, frictions, "-", &lab::Curve::friction);
    add_runs(shear, shears, "N", &lab::Curve::shear_force);
    for (const lab::SimulatedCurve& s : all_.simulations) {
      friction.push_back(column(s.name, "-", "simulation"));
      frictions.push_back(lab::on_grid(s.distance, s.friction, step_));
    }
    const double confidence = all_.loaded.settings.analysis.confidence;
    for (const lab::Sample& sample : lab::repeatability(all_.runs, step_).friction) {
      const double half = lab::half_width(sample, confidence).value_or(0);
      means[1].push_back(sample.mean);
      means[2].push_back(sample.mean - half);
      means[3].push_back(sample.mean + half);
    }
    mean.insert(mean.end(), {column("mean", "-", "mean"), column("low", "-", "low"),
                             column("high", "-", "high")});
    for (Columns* columns : {&frictions, &shears, &means}) number_rows(*columns);
    add_table("friction", friction, frictions);
    add_table("shear", shear, shears);
    add_table("mean", mean, means);
  }

  void number_rows(Columns& columns) const {
    std::size_t rows = 0;
    for (const auto& column : columns) rows = std::max(rows, column.size());
    for (std::size_t i = 0; i < rows; ++i) columns[0].push_back(static_cast<double>(i) * step_);
  }

  // All logger samples covered by the press record, with press values interpolated between them.
  void add_record(std::size_t index) {
    const lab::PressRecord& press = all_.presses[index];
    const lab::LoggerRecord& logger = all_.loggers[index];
    const lab::ReducedRun& run = all_.runs[index];
    const double sensitivity = all_.loaded.settings.lvdt.sensitivity;
    const lab::LoadCellSpec& cell = all_.loaded.settings.load_cell;
    const double first_volts = logger.lvdt.front(),
                 sign = logger.lvdt.back() < first_volts ? -1 : 1;
    const std::size_t stride = 1 + logger.time.size() / max_samples;
    Columns values(5);
    for (std::size_t i = 0; i < logger.time.size(); i += stride) {
      const double on_press = run.clocks.press_time(logger.time[i]);
      if (on_press < press.time.front() || on_press > press.time.back()) continue;
      values[0].push_back(logger.time[i] - run.clocks.logger_start.time);
      values[1].push_back(sign * (logger.lvdt[i] - first_volts) / sensitivity);
      values[2].push_back(lab::interpolated(press.time, press.displacement, on_press));
      values[3].push_back(lab::interpolated(press.time, press.force, on_press));
      values[4].push_back(cell.gain * logger.strain[i] + cell.offset - run.shear_zero);
    }
    add_table("record-" + std::to_string(index),
              Json::array({column("time since the start of sliding", "s", "x"),
                           column("plate distance", "m", ""), column("punch displacement", "m", ""),
                           column("force on the punch", "N", ""), column("shear force", "N", "")}),
              values);
  }

  const Reduction& all_;
  double step_ = 0;
  Json head_ = Json::object();
  std::vector<ReportSection> sections_;
};

}  // namespace

void write_reduction_report(const std::filesystem::path& folder, const Reduction& reduction) {
  write_page(folder / "report.html", "reduction.html",
             {"units.js", "payload.js", "save.js", "chart.js", "tables.js", "reduction.js"},
             ReportMaker(reduction).made(), role::reduction);
}

}  // namespace pulvis
