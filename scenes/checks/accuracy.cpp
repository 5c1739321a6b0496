#include "scenes/checks/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace pulvis {
namespace {

using document::Entry;
using document::Table;
using document::Value;

struct Setting {
  const char* key;
  std::array<const char*, 3> value;  // draft, standard, fine; TOML
};
struct Preset {
  const char* outline;
  std::vector<Setting> settings;
  std::vector<const char*> sizes;  // other keys that determine the mesh size
};

const std::vector<Preset>& presets() {
  static const std::vector<Setting> star{{"boundary_edges", {"48", "64", "96"}},
                                         {"rings", {"1", "1", "2"}}};
  static const std::vector<Preset> all{
      {"disc",
       {{"boundary_edges", {"48", "72", "96"}},
        {"rings", {"0", "1", "2"}},
        {"core", {"\"coarse\"", "\"coarse\"", "\"coarse\""}}},
       {"refinement", "size"}},
      {"rounded_rectangle", star, {"size"}},
      {"ring", {{"boundary_edges", {"24", "40", "80"}}, {"rings", {"2", "4", "8"}}}, {"size"}},
      {"rectangle", {{"columns", {"4", "8", "16"}}, {"rows", {"4", "8", "16"}}}, {"size"}},
      {"ellipse", star, {"size"}},
      {"superellipse", star, {"size"}},
      {"polygon", star, {"size"}},
      {"points", star, {"size"}},
      {"fourier", star, {"size"}}};
  return all;
}

std::size_t level(const Table& root) {
  const std::string* word = document::find_text(root, "accuracy");
  if (word != nullptr && *word == "draft") return 0;
  return word != nullptr && *word == "fine" ? 2 : 1;
}

bool gives_a_size(const Table& mesh, const Preset& preset) {
  const auto given = [&](const char* key) { return document::find(mesh, key) != nullptr; };
  return std::ranges::any_of(preset.settings, given, &Setting::key) ||
         std::ranges::any_of(preset.sizes, given);
}

Table* mesh_of(Table& particle, const document::Origin& origin) {
  if (Entry* entry = document::find(particle, "mesh")) return entry->value.as<Table>();
  particle.push_back({"mesh", origin, Value{Table{}, origin}});
  return particle.back().value.as<Table>();
}

// Grains are too small for the element counts of a particle.
void refuse_counts(Table& particle, const Preset& preset, Problems& problems, std::size_t number) {
  Entry* mesh = document::find(particle, "mesh");
  if (mesh == nullptr || mesh->value.as<Table>() == nullptr) return;
  for (const Setting& setting : preset.settings)
    if (const Entry* count = document::find(*mesh->value.as<Table>(), setting.key))
      problems.add(count->origin, fmt::format("particle[{}].mesh.{}", number, setting.key),
                   "has no effect on grains, allowed: size, or grains.edges");
}

// True if the particle's mesh came from the preset.
bool fill_mesh(Value& element, std::size_t at, std::size_t number, Problems& problems) {
  Table* particle = element.as<Table>();
  const std::string* outline =
      particle != nullptr ? document::find_text(*particle, "outline") : nullptr;
  if (outline == nullptr) return false;
  for (const Preset& preset : presets()) {
    if (preset.outline != *outline) continue;
    if (document::find(*particle, "grains") != nullptr) {
      refuse_counts(*particle, preset, problems, number);
      return false;
    }
    Table* mesh = mesh_of(*particle, element.origin);
    if (mesh == nullptr || gives_a_size(*mesh, preset)) return false;
    for (const Setting& setting : preset.settings) {
      Value value = *document::parse_value(setting.value[at]);
      value.origin = element.origin;
      mesh->push_back({setting.key, element.origin, std::move(value)});
    }
    return true;
  }
  return false;
}

}  // namespace

void fill_meshes(document::Table& root, Problems& problems) {
  Entry* particles = document::find(root, "particle");
  bool used = false;
  if (particles != nullptr && document::is_array_of_tables(particles->value)) {
    std::size_t number = 0;
    for (Value& element : particles->value.get<document::Array>())
      used |= fill_mesh(element, level(root), number++, problems);
  }
  const std::string* family = document::find_text(root, "family");
  if (family != nullptr && *family == "afm") return;  // refused by the reader
  const Entry* accuracy = document::find(root, "accuracy");
  if (accuracy != nullptr && !used)
    problems.add(accuracy->value.origin, "accuracy",
                 "has no effect: the mesh of every particle sets its own resolution, allowed: a "
                 "particle without these keys");
}

}  // namespace pulvis
