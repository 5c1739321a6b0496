#include "scenes/checks/solids/accuracy.hpp"

#include <algorithm>
#include <array>

namespace pulvis::space {
namespace {

using document::Entry;
using document::Table;
using document::Value;

struct Counts {
  const char* word;
  std::int64_t divisions, rings;
};
// The contact resolution is what matters; more layers cost time and change little (docs/accuracy.md).
constexpr std::array<Counts, 3> presets_in_space{
    {{"draft", 4, 1}, {"standard", 7, 1}, {"fine", 8, 2}}};

const Counts& counts_of(const Table& root) {
  const std::string* word = document::find_text(root, "accuracy");
  for (const Counts& counts : presets_in_space)
    if (word != nullptr && *word == counts.word) return counts;
  return presets_in_space[1];
}

Table* table_of_mesh(Table& particle, const document::Origin& origin) {
  if (Entry* entry = document::find(particle, "mesh")) return entry->value.as<Table>();
  particle.push_back({"mesh", origin, Value{Table{}, origin}});
  return particle.back().value.as<Table>();
}

// True if the particle's mesh came from the preset.
bool fill_counts(Value& element, const Counts& counts) {
  Table* particle = element.as<Table>();
  Table* mesh = particle == nullptr ? nullptr : table_of_mesh(*particle, element.origin);
  if (mesh == nullptr || document::find(*mesh, "divisions") != nullptr ||
      document::find(*mesh, "rings") != nullptr)
    return false;
  mesh->push_back({"divisions", element.origin, {counts.divisions, element.origin}});
  mesh->push_back({"rings", element.origin, {counts.rings, element.origin}});
  return true;
}

constexpr double stiffness_of_elastic_contacts = 10;
constexpr document::Origin of_no_file{{1, 1}, -1};

// By its yield stress, or by a hardening table that starts with it.
bool yields(const Table& material) {
  return document::find(material, "yield_stress") != nullptr ||
         document::find(material, "hardening") != nullptr;
}

bool any_material_yields(const Table& root) {
  const Entry* materials = document::find(root, "material");
  if (materials == nullptr || !document::is_array_of_tables(materials->value)) return false;
  return std::ranges::any_of(materials->value.get<document::Array>(), [](const Value& element) {
    const Table* material = element.as<Table>();
    return material != nullptr && yields(*material);
  });
}

}  // namespace

void fill_contact_stiffness(Table& root) {
  if (any_material_yields(root)) return;
  if (document::find(root, "contact") == nullptr)
    root.push_back({"contact", of_no_file, Value{Table{}, of_no_file}});
  Table* contact = document::find(root, "contact")->value.as<Table>();
  if (contact == nullptr || document::find(*contact, "stiffness") != nullptr) return;
  contact->push_back({"stiffness", of_no_file, Value{stiffness_of_elastic_contacts, of_no_file}});
}

void fill_meshes(Table& root, Problems& problems) {
  Entry* particles = document::find(root, "particle");
  bool used = false;
  if (particles != nullptr && document::is_array_of_tables(particles->value))
    for (Value& element : particles->value.get<document::Array>())
      used |= fill_counts(element, counts_of(root));
  const Entry* accuracy = document::find(root, "accuracy");
  if (accuracy != nullptr && !used)
    problems.add(accuracy->value.origin, "accuracy",
                 "has no effect: the mesh of every particle sets its own resolution, allowed: a "
                 "particle without these keys");
}

}  // namespace pulvis::space
