#include "scenes/checks/contact_defaults.hpp"

#include <algorithm>
#include <string>

namespace pulvis {
namespace {

constexpr document::Origin of_no_file{{1, 1}, -1};
// By the errors of unloading and loading over run time (docs/accuracy.md).
constexpr double default_stiffness = 14, default_stiffness_in_space = 20, default_hardness = 3;
// Stiffness of bonds over that of the springs: as stiff as the springs where these are stiff by default.
constexpr double bonds_over_springs = 20, bonds_over_default_springs = 1;
constexpr double hardness_above = 5;      // softer springs give way before a surface indents
constexpr double tangential_share = 0.4;  // costs few time steps
constexpr double inerters_above = 2;      // softer springs do not set the time step
constexpr double default_inertance = 0.9;

// It yields, by its yield stress or by a hardening table that starts with it, at a stress that its state tells.
bool indents(const document::Table& material) {
  return (document::find(material, "yield_stress") != nullptr ||
          document::find(material, "hardening") != nullptr) &&
         document::find(material, "rate") == nullptr;
}

// Calls act(table) for every one of that name.
template <class Act>
void for_each_table(document::Table& root, const char* name, const Act& act) {
  document::Entry* entry = document::find(root, name);
  if (entry == nullptr || !document::is_array_of_tables(entry->value)) return;
  for (document::Value& element : entry->value.get<document::Array>())
    if (auto* table = element.as<document::Table>()) act(*table);
}

bool any_material_indents(document::Table& root) {
  bool any = false;
  for_each_table(root, "material",
                 [&](const document::Table& material) { any |= indents(material); });
  return any;
}

// A body that is alone touches nothing.
bool touches(const document::Table& root) {
  const auto has = [&](const char* name) { return document::find(root, name) != nullptr; };
  const document::Entry* bodies = document::find(root, "body");
  const auto* list = bodies != nullptr ? bodies->value.as<document::Array>() : nullptr;
  return has("tool") || has("cell") || has("die") || has("packing") ||
         (list != nullptr && list->size() > 1);
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
  const bool stiff_by_default = document::find(*contact, "stiffness") == nullptr;
  const double stiffness = number_or(
      *contact, "stiffness", dimension == 3 ? default_stiffness_in_space : default_stiffness);
  for_each_table(root, "bond", [&](document::Table& bond) {
    const std::string* origin = document::find_text(bond, "origin");
    if (origin != nullptr && *origin != "adhesion")  // which has no stiffness
      number_or(bond, "stiffness",
                stiff_by_default ? bonds_over_default_springs : bonds_over_springs);
  });
  number_or(*contact, "tangential_stiffness",
            std::min(stiffness, std::max(inerters_above, tangential_share * stiffness)));
  if (stiffness >= hardness_above && any_material_indents(root))
    number_or(*contact, "hardness", default_hardness);
  const double inertance = number_or(
      *contact, "inertance", stiffness > inerters_above && touches(root) ? default_inertance : 0);
  document::Table* time = table_of(root, "time");
  if (time == nullptr || document::find(*time, "estimate") != nullptr) return;
  const std::string estimate = inertance > 0 ? "highest-mode" : "element";
  time->push_back({"estimate", of_no_file, document::Value{estimate, of_no_file}});
}

}  // namespace pulvis
