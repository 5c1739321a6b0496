#include "scenes/checks/contact_defaults.hpp"

#include <algorithm>
#include <string>

namespace pulvis {
namespace {

constexpr document::Origin of_no_file{{1, 1}, -1};
constexpr double default_stiffness = 0.5;
// Solids that stay elastic bear pressures at which softer springs underestimate the force.
constexpr double stiffness_of_elastic_solids = 10;
constexpr double tangential_share = 0.5;  // without costing time steps
constexpr double inerters_above = 2;      // softer springs do not set the time step
constexpr double default_inertance = 0.9;

// By its yield stress, or by a hardening table that starts with it.
bool yields(const document::Table& material) {
  return document::find(material, "yield_stress") != nullptr ||
         document::find(material, "hardening") != nullptr;
}

bool any_material_yields(const document::Table& root) {
  const document::Entry* materials = document::find(root, "material");
  if (materials == nullptr || !document::is_array_of_tables(materials->value)) return false;
  return std::ranges::any_of(materials->value.get<document::Array>(),
                             [](const document::Value& element) {
                               const document::Table* material = element.as<document::Table>();
                               return material != nullptr && yields(*material);
                             });
}

// The table of that name, made if it is missing; null if the name is something else.
document::Table* table_of(document::Table& root, const char* name) {
  if (document::find(root, name) == nullptr)
    root.push_back({name, of_no_file, document::Value{document::Table{}, of_no_file}});
  return document::find(root, name)->value.as<document::Table>();
}

// The number of a key, which is added with `value` if it is missing.
double number_or(document::Table& table, const char* name, double value) {
  if (const document::Entry* given = document::find(table, name)) {
    if (const auto* number = given->value.as<double>()) return *number;
    if (const auto* whole = given->value.as<std::int64_t>()) return static_cast<double>(*whole);
    return value;
  }
  table.push_back({name, of_no_file, document::Value{value, of_no_file}});
  return value;
}

}  // namespace

void fill_contact(document::Table& root, int dimension) {
  const std::string* family = document::find_text(root, "family");
  if (family != nullptr && *family == "afm") return;
  document::Table* contact = table_of(root, "contact");
  if (contact == nullptr) return;
  const bool in_space = dimension == 3, plastic = any_material_yields(root);
  const double stiffness =
      number_or(*contact, "stiffness",
                in_space && !plastic ? stiffness_of_elastic_solids : default_stiffness);
  number_or(*contact, "tangential_stiffness",
            std::min(stiffness, std::max(inerters_above, tangential_share * stiffness)));
  const double inertance =
      number_or(*contact, "inertance", stiffness > inerters_above ? default_inertance : 0);
  document::Table* time = table_of(root, "time");
  if (time == nullptr || document::find(*time, "estimate") != nullptr) return;
  const std::string estimate = inertance > 0 ? "highest-mode" : "element";
  time->push_back({"estimate", of_no_file, document::Value{estimate, of_no_file}});
}

}  // namespace pulvis
