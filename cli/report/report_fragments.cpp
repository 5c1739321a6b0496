#include "cli/report/report_fragments.hpp"

#include <algorithm>

#include "cli/report/report_encoding.hpp"
#include "scenes/results/fragment_sizes.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_sizes = 100;  // fragments per frame

// Of each its position and further numbers. If a run was killed, the table of cracks may lack the newest rows.
struct Dots {
  std::size_t all = 0;
  std::vector<float> drawn;

  // `ways`: m, by which each is shifted.
  Dots(std::vector<double> position, const std::vector<Point3>& ways,
       const std::vector<std::vector<double>>& more)
      : all(position.size() / 3) {
    for (std::size_t i = 0; i < ways.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) position[3 * i + k] += ways[i][k];
    for (const auto& numbers : more) all = std::min(all, numbers.size());
    for (std::size_t i = 0; i < all; i += (all + max_dots - 1) / max_dots) {
      for (std::size_t k = 0; k < 3; ++k) drawn.push_back(static_cast<float>(position[3 * i + k]));
      for (const auto& numbers : more) drawn.push_back(static_cast<float>(numbers[i]));
    }
  }
};

}  // namespace

Json fragments_of(const hdf5::File& file, const std::string& frame) {
  const bool space = file.contains(frame + "/fragments/volume");
  const std::string kind = space ? "volume" : "area";
  std::vector<FragmentSize> fragments;
  for (const double size : file.read_doubles(frame + "/fragments/" + kind))
    fragments.push_back({0, 1, size});
  using Weight = SizeDistribution::Weight;
  const int dimensions = space ? 3 : 2;
  const SizeDistribution by_number(fragments, Weight::number, dimensions),
      by_size(fragments, Weight::size, dimensions);
  const std::size_t count = std::min(fragments.size(), max_sizes);
  std::vector<double> diameter, number, share;
  for (std::size_t i = 1; i <= count; ++i) {  // the last is the largest
    const std::size_t at = i * fragments.size() / count - 1;
    diameter.push_back(by_number.diameters()[at]);
    number.push_back(by_number.shares()[at]);
    share.push_back(by_size.shares()[at]);
  }
  return {{"count", fragments.size()},
          {"diameter", rounded(diameter)},
          {"number", rounded(number)},
          {kind, rounded(share)}};
}

void add_space_bonds(const hdf5::File& file, const std::string& frame, const std::string& prefix,
                     const ReportCell<ThreeD>& cell, Json& entry,
                     std::vector<ReportSection>& sections) {
  if (!file.contains(frame + "/bonds")) return;
  const auto dots = [&](const std::string& group, const std::vector<std::vector<double>>& more) {
    std::vector<double> position = file.read_doubles(frame + "/" + group + "/position");
    const std::size_t count = position.size() / 3;
    return Dots(std::move(position), cell.ways_of_bonds(file, frame, group, count), more);
  };
  const Dots bonds = dots("bonds", {file.read_doubles(frame + "/bonds/area")});
  const Dots cracks =
      dots("cracks", {file.read_doubles("/cracks/area"), file.read_doubles("/cracks/shear")});
  entry["fragments"] = fragments_of(file, frame);
  entry["bonds"] = bonds.all;
  entry["cracks"] = cracks.all;
  if (bonds.all > 0) sections.push_back({prefix + "bonds", encoded(bonds.drawn)});
  if (cracks.all > 0) sections.push_back({prefix + "cracks", encoded(cracks.drawn)});
}

}  // namespace pulvis
