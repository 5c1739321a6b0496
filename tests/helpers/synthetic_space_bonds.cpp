#include "tests/helpers/synthetic_space_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pulvis::testing {
namespace {

// How many spheres have come off.
int loose_spheres(const SyntheticSpaceRun& run, double share) {
  return std::min(spheres(run) - 1, static_cast<int>(share * spheres(run)));
}

// Pairs of neighbours, lowest sphere first; a pair is broken once its first sphere has come off.
std::vector<std::array<int, 2>> bonded_pairs(const SyntheticSpaceRun& run) {
  const int c = run.columns, layer = c * c;
  std::vector<std::array<int, 2>> pairs;
  for (int sphere = 0; sphere < spheres(run); ++sphere) {
    if (sphere % c + 1 < c) pairs.push_back({sphere, sphere + 1});
    if (sphere / c % c + 1 < c) pairs.push_back({sphere, sphere + c});
    if (sphere + layer < spheres(run)) pairs.push_back({sphere, sphere + layer});
  }
  return pairs;
}

double bonded_area(const SyntheticSpaceRun& run) { return 0.02 * run.diameter * run.diameter; }

// m, halfway between the centres of a pair.
std::array<double, 3> middle_of(const SyntheticSpaceRun& run, const std::array<int, 2>& pair) {
  const auto first = lattice_place(run, pair[0]), second = lattice_place(run, pair[1]);
  return {(first[0] + second[0]) / 2, (first[1] + second[1]) / 2, (first[2] + second[2]) / 2};
}

}  // namespace

int spheres(const SyntheticSpaceRun& run) { return run.columns * run.columns * run.layers; }

std::array<double, 3> lattice_place(const SyntheticSpaceRun& run, int sphere) {
  const int c = run.columns;
  return {run.diameter * (sphere % c + 0.5), run.diameter * (sphere / c % c + 0.5),
          run.diameter * (sphere / (c * c) + 0.5)};
}

void append_bond_fields_in_space(const SyntheticSpaceRun& run, std::vector<FieldInfo>& all) {
  if (!run.bonds) return;
  const auto add = [&](const char* name, const char* unit, FieldPlace place, int components,
                       bool whole = false) {
    all.push_back({name, unit, "", "made up", place, components, whole});
  };
  add("bonds/area", "m^2", FieldPlace::list, 1);
  for (const char* name : {"bonds/position", "cracks/position"})
    add(name, "m", FieldPlace::list, 3);
  add("fragments/number", "-", FieldPlace::list, 1, true);
  add("fragments/volume", "m^3", FieldPlace::list, 1);
  add("fragment", "-", FieldPlace::particle, 1, true);
  add("damage", "-", FieldPlace::particle, 1);
}

void append_bond_series_in_space(const SyntheticSpaceRun& run, std::vector<SeriesInfo>& all) {
  if (!run.bonds) return;
  for (const auto& [name, unit] : {std::pair("energy/bonds", "J"),
                                   {"energy/fracture", "J"},
                                   {"bonds/crack_area", "m^2"},
                                   {"bonds/fragments", "-"},
                                   {"bonds/damage", "-"},
                                   {"bonds/largest_fragment", "-"}})
    all.push_back({name, unit, "", "made up"});
}

nlohmann::ordered_json bond_summary_in_space(const SyntheticSpaceRun& run) {
  return {{"made", bonded_pairs(run).size()},
          {"broken", bonded_pairs(run).size()},
          {"crack_area", (spheres(run) - 1) * bonded_area(run)},
          {"mode_2_share", 0.5},
          {"fragments", spheres(run)},
          {"largest_fragment", 1.0 / spheres(run)}};
}

void append_bond_row_in_space(const SyntheticSpaceRun& run, double share,
                              std::vector<double>& values) {
  if (!run.bonds) return;
  const double loose = loose_spheres(run, share), left = 1 - loose / spheres(run);
  values.insert(values.end(), {1e-7 * (spheres(run) - loose), 1e-6 * loose,
                               loose * bonded_area(run), loose + 1, 1 - left, left});
}

void append_bonds_in_space(const SyntheticSpaceRun& run, double share, double squeezed,
                           std::vector<std::vector<double>>& values) {
  if (!run.bonds) return;
  const int loose = loose_spheres(run, share), whole = spheres(run) - loose;
  const double ball = std::numbers::pi / 6 * std::pow(run.diameter, 3);
  std::vector<double> area, position[2], number, volume, of_particle, damage;  // bonds, cracks
  for (const auto& pair : bonded_pairs(run)) {
    const auto [x, y, z] = middle_of(run, pair);
    std::vector<double>& to = position[pair[0] < loose];
    to.insert(to.end(), {x, y, z * squeezed});
    if (pair[0] >= loose) area.push_back(bonded_area(run));
  }
  for (int fragment = 0; fragment <= loose; ++fragment) {
    number.push_back(fragment);
    volume.push_back(ball * (fragment < loose ? 1 : whole));
  }
  for (int sphere = 0; sphere < spheres(run); ++sphere) {
    of_particle.push_back(std::min(sphere, loose));
    damage.push_back(sphere < loose ? 1 : 0);
  }
  values.insert(values.end(),
                {area, position[0], position[1], number, volume, of_particle, damage});
}

// The points of all pairs that have come apart, in mode I to II.
void record_cracks_in_space(const SyntheticSpaceRun& run, double share, double time,
                            Recorder& recorder) {
  if (!run.bonds) return;
  const auto pairs = bonded_pairs(run);
  while (recorder.rows(0) < std::ssize(pairs)) {
    const auto row = static_cast<std::size_t>(recorder.rows(0));
    const auto& pair = pairs[row];
    if (pair[0] >= loose_spheres(run, share)) return;
    const auto [x, y, z] = middle_of(run, pair);
    recorder.row(
        0, std::vector<double>{time, x, y, z, 1.0 * pair[0], 1.0 * pair[1], 0, bonded_area(run),
                               static_cast<double>(row) / static_cast<double>(pairs.size()), 1e-6});
  }
}

std::vector<TableInfo> bond_tables_in_space(const SyntheticSpaceRun& run) {
  if (!run.bonds) return {};
  std::vector<SeriesInfo> columns;
  for (const auto& [name, unit] : {std::pair("time", "s"),
                                   {"x", "m"},
                                   {"y", "m"},
                                   {"z", "m"},
                                   {"particle", "-"},
                                   {"other", "-"},
                                   {"bond", "-"},
                                   {"area", "m^2"},
                                   {"shear", "-"},
                                   {"energy", "J"}})
    columns.push_back({name, unit, "", "made up"});
  return {{"cracks", columns}};
}

}  // namespace pulvis::testing
