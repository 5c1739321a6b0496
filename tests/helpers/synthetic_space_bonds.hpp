// The bonds of the made-up run in three dimensions: between the lattice's neighbours; the spheres come off one by one.
// Without bonds there is nothing to append.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "engine/files/recorder.hpp"
#include "tests/helpers/synthetic_space_run.hpp"

namespace pulvis::testing {

int spheres(const SyntheticSpaceRun& run);
std::array<double, 3> lattice_place(const SyntheticSpaceRun& run, int sphere);  // m, at the start

void append_bond_fields_in_space(const SyntheticSpaceRun& run, std::vector<FieldInfo>& all);
void append_bond_series_in_space(const SyntheticSpaceRun& run, std::vector<SeriesInfo>& all);
std::vector<TableInfo> bond_tables_in_space(const SyntheticSpaceRun& run);
nlohmann::ordered_json bond_summary_in_space(const SyntheticSpaceRun& run);

// `share`: of the run that is over. Heights are `squeezed`.
void append_bonds_in_space(const SyntheticSpaceRun& run, double share, double squeezed,
                           std::vector<std::vector<double>>& values);
void append_bond_row_in_space(const SyntheticSpaceRun& run, double share,
                              std::vector<double>& values);
void record_cracks_in_space(const SyntheticSpaceRun& run, double share, double time,
                            Recorder& recorder);

}  // namespace pulvis::testing
