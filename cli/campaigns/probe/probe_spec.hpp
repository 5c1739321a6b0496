// A probe: powders loaded along paths in a periodic cell; their states at given densities are probed in many directions
// for the stress at which they yield. In two and three dimensions.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/read.hpp"
#include "scenes/spec/cell_spec.hpp"

namespace pulvis {

struct ProbePath {  // [[path]]
  std::string name, scene;
  SourceMark mark;
};

struct ProbePowder {  // [[powder]]
  std::string name;
  std::vector<std::string> overrides;  // as for --set
  SourceMark mark;
};

struct GivenDirection {  // [[direction]]
  std::string name;
  std::array<double, tensor_parts> parts{};  // of the strain, or of the change of stress
  SourceMark mark;
};

struct ProbeSpec {
  enum class Control { strain, stress };
  std::string title;
  std::vector<double> densities;       // -, relative, increasing
  std::vector<std::int64_t> seeds;     // none: those of each scene
  std::vector<std::string> overrides;  // as for --set
  std::vector<ProbePath> paths;
  std::vector<ProbePowder> powders;  // none: that of each scene
  Control control = Control::strain;
  int directions = 12;
  int deviatoric = 6;  // in three dimensions
  std::vector<GivenDirection> given;
  double size = 0.02;            // -, strain; or stress over the pressure of the state
  double duration = 0;           // s, of a probe, and of the unloading before it
  double release = 0.5;          // -, fraction of the state's stress
  double elastic_strain = 2e-4;  // -, up to which a probe is treated as elastic
  double offset_strain = 0.002;  // -
  double dissipation = 0.002;    // -, fraction of pressure times volume
};

// A run that loads a powder, along one path and with one seed; it saves a state at each density.
struct ProbeLoading {
  std::string name;     // "isostatic,rough,seed=1"
  std::string history;  // "isostatic,rough": path and powder
  std::int64_t seed = 1;
  LoadedScene scene;
};

struct Probe {
  ProbeSpec spec;
  std::filesystem::path file;
  std::string text;  // of the file
  std::vector<std::string> overrides;
  std::vector<std::string> histories;  // every path with every powder
  std::vector<ProbeLoading> loadings;
};

}  // namespace pulvis
