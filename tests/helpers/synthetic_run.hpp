// A small made-up run for the tests of what shows runs: discs between two punches, squeezed by
// formulas that look like a compaction and are none. No physics is tested with it.
#pragma once

#include <filesystem>

namespace pulvis::testing {

struct SyntheticRun {
  int columns = 4, rows = 4;  // discs on a square lattice
  int divisions = 12;         // quads along a disc's width; the disc has their square
  int frames = 6;
  int samples_a_frame = 20;
  bool pictures = true;  // frames; without them it has its history alone
  bool tools = true;     // punches with their series, and densities
  bool observed =
      false;           // local densities (two columns of cells, one of them all tool) and contacts
  bool bonds = false;  // discs that come apart column by column
  bool cell = false;   // a periodic cell around all of them, its left side after the first column
  double diameter = 1e-3;  // m
};

// Writes run.h5, run.xdmf, history.csv and summary.json into the folder.
void record(const SyntheticRun& run, const std::filesystem::path& folder);

}  // namespace pulvis::testing
