// What a reduction needs besides the records (sliding-plate tests, compressions, an AFM's friction loops):
// reduce.toml.
// Sources of the defaults: Kim (thesis), sections 3.2.2 to 3.2.6; declared in declare_lab.cpp.
#pragma once

#include "cli/laboratory/volts/volts_spec.hpp"
#include "scenes/read.hpp"
#include "scenes/scene_files.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pulvis::lab {

struct PressSpec {
  std::string time, force, displacement;  // names of columns
  int header_line = 0;                    // 0: the first line that is not empty or a comment
  double capacity = 0;                    // N
  double hold_tolerance = 0;              // -, of the held force
};

struct LoggerSpec {
  std::string time, strain, lvdt;  // names of columns
  int header_line = 0;
  std::optional<double> strain_limit;  // -
  std::optional<double> lvdt_limit;    // V
};

struct LoadCellSpec {  // shear force = gain * strain + offset
  enum class Zero { calibration, standstill };
  double gain = 0;    // N
  double offset = 0;  // N
  Zero zero = Zero::calibration;
};

struct LvdtSpec {
  double sensitivity = 0;  // V/m
};

struct CompactSpec {
  double die_diameter = 0;            // m
  std::optional<double> length;       // m, when sliding starts
  std::optional<double> fill_height;  // m, at zero punch displacement
  std::optional<double> poissons_ratio;
  std::optional<double> stress_ratio;   // -, radial over axial
  std::optional<int> powder;            // index in the list of powders
  std::optional<double> wall_friction;  // empty: the measured coefficient

  double poisson() const;  // of the powder where no stress ratio is given
  double elastic_ratio() const { return poisson() / (1 - poisson()); }
  double radial_ratio() const { return stress_ratio.value_or(elastic_ratio()); }
};

struct ClockSpec {
  enum class Drift { events, none };
  Drift drift = Drift::events;
  double largest_drift = 0;  // -
  double window = 0;         // s, to either side of an event
  double longest_gap = 0;    // in units of the median interval between samples
};

struct AnalysisSpec {
  double shortest_sliding = 0;          // m
  double static_within = 0;             // m
  double dynamic_from = 0;              // m
  std::optional<double> dynamic_until;  // m
  double confidence = 0;                // -
  double distance_step = 0;             // m
};

struct SimulationSpec {
  std::string target;
  std::string density, pressure;  // series, for compression curves
};

struct DieSpec {
  enum class Shape { round, slot };
  Shape shape = Shape::round;
  double diameter = 15e-3;   // m, round
  double width = 0;          // m, slot
  double thickness = 0;      // m, slot
  double solid_density = 0;  // kg/m^3; 0: not given
  double mass_error = 0;     // -
  double height_error = 0;   // m

  bool is_slot() const { return shape == Shape::slot; }
  double area() const;         // m^2, of the punch
  double wall_length() const;  // m, round: D/4; slot: W/2: area over the rubbing perimeter
};

struct Filling {  // of the die
  std::string name;
  double mass = 0;                                  // kg
  std::optional<double> fill_height, final_height;  // m
  SourceMark mark;
};

struct CompressionSpec {
  std::string empty;  // file of the empty press's record
  int empty_degree = 0;
  std::vector<double> compliance;             // m/N, m/N^2, ...
  double contact = 0, largest_fall = 0;       // -, of the largest force
  std::optional<double> fit_from, fit_until;  // Pa
  double compliance_error = 0;                // -
};

struct CurveSpec : Filling {
  std::string press;                      // file
  std::optional<double> initial_density;  // -
};

struct WedgeSpec {         // another kind of record: friction loops of an AFM
  std::string loops;       // file, relative to the settings' folder; empty: sliding-plate tests
  double adhesion = 0;     // N
  double slope_error = 0;  // rad
  double load_error = 0;   // -
  double skip = 0;         // -, of a raw trace at each end
  std::optional<double> expected_friction = {};
};

struct GaugesSpec {                                     // of an instrumented die
  std::string time, displacement, top, bottom, radial;  // names of columns
  int header_line = 0;
  std::optional<double> radial_height;                       // m, above the bottom punch
  double from = 0;                                           // -, of the largest pressure
  double density_step = 0;                                   // -
  double top_error = 0, bottom_error = 0, radial_error = 0;  // -
};

struct TransmissionSpec : Filling {
  std::string record;  // file
};

struct RunSpec {
  std::string name;
  std::string press, logger;     // files, relative to the settings' folder
  std::optional<double> offset;  // s
  // The condition of the test: all runs state the same ones of these.
  std::optional<double> load, roughness, speed;  // N, m, m/s
  std::string direction;
  std::optional<int> powder;     // index in the list of powders
  std::optional<double> length;  // m, of this run's compact
  SourceMark mark = {};

  bool has_condition() const { return load || roughness || speed || powder || !direction.empty(); }
};

const char* powder_name(int powder);

struct Settings {
  std::filesystem::path file;
  std::string title;
  PressSpec press;
  LoggerSpec logger;
  LoadCellSpec load_cell;
  LvdtSpec lvdt;
  CompactSpec compact;
  ClockSpec clock;
  AnalysisSpec analysis;
  SimulationSpec simulation;
  WedgeSpec wedge;
  volts::VoltsSpec volts;
  std::vector<RunSpec> runs;
  DieSpec die;
  CompressionSpec compression;
  std::vector<CurveSpec> curves;
  GaugesSpec gauges;
  std::vector<TransmissionSpec> transmissions;

  // With the compact of one run.
  Settings of_run(const RunSpec& run) const;
  // Records of a filled die as in [die]: no compact on a plate.
  bool fills_die() const { return !curves.empty() || !transmissions.empty(); }
};

struct LoadedSettings {
  Settings settings;
  document::Table root = {};  // the settings as read, with overrides and defaults
  // The same as TOML. It is self-contained: its paths lead to copies of the records next to it.
  std::string text = {};
  std::vector<InputFile> inputs = {};
};

// Appends `runs`, each with records and a name, as [[run]] tables after the existing ones.
void add_runs(LoadedSettings& loaded, const std::vector<RunSpec>& runs);

const schema::Language& language();
std::string reference();    // docs/reduce.md
std::string json_schema();  // docs/reduce.schema.json

// Throws SceneError with all errors. An empty path: defaults and overrides only.
LoadedSettings load_settings(const std::filesystem::path& file,
                             const std::vector<std::string>& overrides);
LoadedSettings load_settings_text(const std::string& text, const std::filesystem::path& file,
                                  const std::vector<std::string>& overrides);

}  // namespace pulvis::lab
