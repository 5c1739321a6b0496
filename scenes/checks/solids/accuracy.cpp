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

}  // namespace

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
