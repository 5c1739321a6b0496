// A fit of a simulated sliding-plate test to a measured one: which keys of a scene are fitted, and the measurement
// that the simulation is compared with.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scenes/read.hpp"

namespace pulvis {

struct SoughtKey {  // [[parameter]]
  std::string key, unit, name;
  double start = 0, low = 0, high = 0, step = 0;
  SourceMark mark = {};

  std::string short_name() const;           // "coefficient" of "friction[0].coefficient"
  std::string text(double value) const;     // with as many digits as its step needs, at least six
  std::string setting(double value) const;  // as used by --set
};

struct PlateMeasured {  // [measured]
  enum class Compare { distance, diameters };
  std::string record, distance, friction;   // file, names of its columns
  double from = 0;                          // m
  std::optional<double> until;              // m
  std::optional<double> error;              // -, of a sample
  std::optional<double> particle_diameter;  // m
  Compare compare = Compare::distance;
  std::optional<double> peak, peak_error, dynamic, dynamic_error;  // -, instead of a record

  bool by_diameters() const { return compare == Compare::diameters; }
};

struct PlateFitSpec {
  std::string title, scene;
  std::vector<std::string> overrides;  // as for --set
  std::vector<SoughtKey> parameters;
  PlateMeasured measured;
  std::string target;
  double static_within = 0, dynamic_from = 0;  // m
  double tolerance = 0, confidence = 0;        // -
  int max_rounds = 0;
};

struct PlateFit {
  PlateFitSpec spec;
  std::filesystem::path file;
  std::string text;  // of the file
  std::vector<std::string> overrides;
  Scene scene;                            // at the start values
  std::set<std::filesystem::path> files;  // that it has read

  std::filesystem::path scene_file() const { return file.parent_path() / spec.scene; }
  std::vector<std::string> settings_at(const std::vector<double>& values) const;
};

// All errors are thrown as one SceneError before anything runs.
PlateFit load_plate_fit(const std::filesystem::path& file,
                        const std::vector<std::string>& overrides = {});

std::string plate_fit_reference();  // docs/fit.md

}  // namespace pulvis
