#include "cli/report/report_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pulvis {
namespace {

std::string label_of(const std::string& name, std::size_t component, std::size_t count) {
  static constexpr std::array plane{"xx", "yy", "zz", "xy"};
  static constexpr std::array in_space{"xx", "yy", "zz", "xy", "yz", "zx"};
  if (count == 1) return name;
  if (count == plane.size()) return name + " " + plane[component];
  if (count == in_space.size()) return name + " " + in_space[component];
  return name + " " +
         (count <= 3 ? std::string(1, "xyz"[component]) : std::to_string(component + 1));
}

// Mean over the corners of a cell.
double speed(const std::vector<double>& velocity, const CellField& field,
             std::span<const std::int32_t> corners) {
  double sum = 0;
  for (const std::int32_t corner : corners) {
    const double* v = &velocity[static_cast<std::size_t>(corner) * field.stored];
    sum += std::hypot(v[0], v[1], field.used > 2 ? v[2] : 0.0);
  }
  return sum / static_cast<double>(corners.size());
}

}  // namespace

void widen(Range& range, double value) {
  if (!std::isfinite(value)) return;
  range.low = std::min(range.low, value);
  range.high = std::max(range.high, value);
}

std::vector<CellField> cell_fields(const hdf5::File& file, const std::string& frame,
                                   const FieldChoice& choice) {
  std::vector<CellField> fields;
  for (const auto& name : file.children(frame)) {
    const std::string dataset = frame + "/" + name;
    if (!file.has_attribute(dataset, "place")) continue;
    const std::string place = file.text_attribute(dataset, "place");
    const bool of_nodes = name == "velocity" && place == "node";
    const bool of_particle =
        place == "particle" && (choice.particles || name == "damage" || name == "fragment");
    if (!of_nodes && !of_particle && place != "cell") continue;
    const auto shape = file.shape(dataset);
    const std::size_t stored = shape.size() > 1 ? shape[1] : 1;
    const auto used = static_cast<std::size_t>(file.number_attribute(dataset, "components"));
    const std::string unit = file.text_attribute(dataset, "unit");
    if (of_nodes)
      fields.push_back({name, "speed", unit, "mean over the corners", 0, stored, used, true});
    if (of_nodes || (used > 1 && (!choice.tensors || (of_particle && choice.particles)))) continue;
    const std::string meaning = file.text_attribute(dataset, "meaning");
    for (std::size_t k = 0; k < used; ++k)
      fields.push_back(
          {name, label_of(name, k, used), unit, meaning, k, stored, used, false, of_particle});
  }
  return fields;
}

std::vector<double> cell_values(const hdf5::File& file, const std::string& frame,
                                const CellField& field, const FieldMesh& mesh) {
  const auto all = file.read_doubles(frame + "/" + field.dataset);
  std::vector<double> one(mesh.cell_particle.size());
  for (std::size_t c = 0; c < one.size(); ++c) {
    const std::size_t place =
        field.of_particle ? static_cast<std::size_t>(mesh.cell_particle[c]) : c;
    one[c] = field.speed ? speed(all, field, mesh.cells.subspan(c * mesh.corners, mesh.corners))
                         : all[place * field.stored + field.component];
  }
  return one;
}

void leave_out_empty(std::vector<CellField>& fields) {
  std::erase_if(fields,
                [](const CellField& field) { return !(field.range.low <= field.range.high); });
}

nlohmann::ordered_json described(const CellField& field, std::size_t levels) {
  return {{"name", field.label}, {"unit", field.unit},     {"meaning", field.meaning},
          {"levels", levels},    {"low", field.range.low}, {"high", field.range.high}};
}

}  // namespace pulvis
