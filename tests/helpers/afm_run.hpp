// Programmes for tests: what they leave behind.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "scenes/lever/afm_loop.hpp"
#include "tests/helpers/lever.hpp"
#include "tests/helpers/paths.hpp"

namespace pulvis {

inline AfmHistory history_of(AfmSimulation& simulation) {
  AfmHistory history;
  simulation.run([&](double time, const std::vector<double>& row) {
    history.times.push_back(time);
    history.rows.push_back(row);
    return true;
  });
  return history;
}
inline AfmHistory history_of(const Scene& scene, int threads = 1) {
  AfmSimulation simulation(scene, threads);
  return history_of(simulation);
}

inline double last(const AfmHistory& h, const std::string& series) {
  return h.value(h.rows.size() - 1, series);
}

// history.csv by the names of its series.
struct FiledHistory {
  std::map<std::string, std::vector<double>> series;
  std::size_t samples() const { return series.empty() ? 0 : series.begin()->second.size(); }
  double value(std::size_t sample, const std::string& name) const {
    return series.at(name).at(sample);
  }
};

inline FiledHistory history_in(const std::filesystem::path& file) {
  FiledHistory history;
  std::ifstream lines(file);
  std::vector<std::string> names;
  std::string line, cell;
  std::getline(lines, line);
  for (std::istringstream cells(line); std::getline(cells, cell, ',');)
    names.push_back(cell.substr(0, cell.find(" [")));
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    for (std::size_t i = 0; std::getline(cells, cell, ','); ++i)
      history.series[names.at(i)].push_back(std::stod(cell));
  }
  return history;
}

// A shipped scene run by the program, whose exit code says whether the scene's own expectations were met.
inline FiledHistory run_shipped_afm(const std::string& name) {
  namespace fs = std::filesystem;
  const fs::path place = fs::temp_directory_path() / ("pulvis-" + name + std::to_string(getpid()));
  const std::string command = std::string("'") + paths::program() + "' run '" +
                              paths::source_dir() + "/scenes/afm/" + name +
                              ".toml' --threads 1 --overwrite -o '" + place.string() + "' > '" +
                              place.string() + ".txt' 2>&1";
  const int status = std::system(command.c_str());
  std::ostringstream printed;
  printed << std::ifstream(place.string() + ".txt").rdbuf();
  EXPECT_EQ(status, 0) << printed.str();
  FiledHistory history = history_in(place / "history.csv");
  fs::remove_all(place);
  fs::remove(place.string() + ".txt");
  return history;
}

inline constexpr const char* v_with_tip = R"(family = "afm"

[[material]]
name = "lever"
youngs_modulus = "200 GPa"
poissons_ratio = 0.3

[[material]]
name = "stiff"
youngs_modulus = "10 TPa"
poissons_ratio = 0.3

[lever]
shape = "v"
material = "lever"
length = "115 um"
arm_width = "20 um"
half_angle = "30 deg"
thickness = "0.6 um"

[tip]
shape = "block"
material = "stiff"
height = "3.7 um"
foot = "1 um"
set_back = "4 um"
)";
inline const std::string coarse_v_text = on_plates(v_with_tip);
inline const char* const coarse_v = coarse_v_text.c_str();

}  // namespace pulvis
