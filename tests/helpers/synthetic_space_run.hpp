// A made-up run in three dimensions for the tests of what shows runs: spheres of hexahedra between two punches, in a box
// or a die, squeezed by formulas that look like a compaction and are none. No physics is tested with it.
#pragma once

#include <filesystem>

namespace pulvis::testing {

struct SyntheticSpaceRun {
  int columns = 2, layers = 2;   // spheres on a cubic lattice, columns x columns x layers
  int divisions = 2, rings = 1;  // of a sphere's mesh: divisions^3 + 6 divisions^2 rings hexahedra
  int frames = 5;
  int samples_a_frame = 10;
  bool tools = true;
  bool die = false;        // round, instead of four walls
  bool densities = true;   // in 3 x 2 x 4 cells
  bool contacts = true;    // forces of the lattice's neighbours, and of the punches
  bool bonds = false;      // between the lattice's neighbours; the spheres come off one by one
  double diameter = 1e-3;  // m
};

int elements_of_sphere(const SyntheticSpaceRun& run);

// Writes run.h5, run.xdmf, history.csv and summary.json into the folder.
void record_in_space(const SyntheticSpaceRun& run, const std::filesystem::path& folder);

}  // namespace pulvis::testing
