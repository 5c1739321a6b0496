#include "cli/python/module/limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "scenes/keys/tables.hpp"

namespace pulvis::python {

const schema::KeyInfo& declared_key(const Scene& scene, const std::string& table,
                                    const std::string& key) {
  const schema::Language& language = schema::scene_language(scene.dimension);
  return *schema::find_key(*schema::find_table(table, language), key);
}

const WritableColumn* writable_column(const std::string& name) {
  const auto* found =
      std::ranges::find(writable_columns, std::string_view(name),
                        [](const WritableColumn& c) { return std::string_view(c.name); });
  return found == std::end(writable_columns) ? nullptr : found;
}

schema::KeyInfo limits_of(const WritableColumn& column, const Scene& scene, int material) {
  schema::KeyInfo limits = declared_key(scene, column.table, column.key);
  limits.kind = schema::Kind::quantity;  // also of the components of a vector
  schema::Range& range = limits.range;
  const std::string_view key = column.key;
  // As in check_materials.
  const double youngs_modulus =
      scene.materials.at(static_cast<std::size_t>(material)).youngs_modulus;
  if (key == "yield_stress" || key == "hardening_modulus")
    range.high = std::min(range.high, youngs_modulus);
  if (key == "yield_stress") range.without_high = true;
  // As in the checks of cells: it damps the motion relative to a fixed frame.
  if (key == "mass_proportional" && scene.cell) range.high = 0;
  return limits;
}

std::string fault_of(double value, const schema::KeyInfo& limits) {
  if (limits.range.holds(value)) return "";
  return fmt::format("{:.6g} {}{}, allowed: {}", value, limits.unit,
                     std::isfinite(value) ? "" : " is not finite", schema::allowed(limits));
}

}  // namespace pulvis::python
