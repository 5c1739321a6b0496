#include "cli/campaigns/probe/probe_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/keys/tables.hpp"
#include "scenes/language/scene_text.hpp"

namespace pulvis {
namespace {

constexpr std::int64_t samples = 400, frames = 2;  // per probe
constexpr double sheared = 0.05;  // of the pressure: shear stresses above it are unloaded, too

document::Value parsed_table(const std::string& text) { return {document::parse(text), {}}; }

void set(document::Table& table, const std::string& key, document::Value value) {
  if (document::Entry* entry = document::find(table, key))
    entry->value = std::move(value);
  else
    table.push_back({key, {}, std::move(value)});
}

document::Table& output_of(document::Table& root) {
  if (document::find(root, "output") == nullptr) set(root, "output", {document::Table{}, {}});
  return document::find(root, "output")->value.get<document::Table>();
}

// Expectations of the path's own scene do not apply to these. The contact network is that of all runs from one powder.
document::Table own_scene(const LoadedScene& scene) {
  document::Table root = document::parse(scene.text);
  std::erase_if(root, [](const document::Entry& entry) { return entry.key == "expect"; });
  set(output_of(root), "contacts", {true, {}});
  return root;
}

std::string written(const document::Table& root) { return scene_text(root, language_of(root)); }

// The components that a cell of this dimension has.
std::vector<std::size_t> parts_of_cell(bool in_space) {
  return in_space ? std::vector<std::size_t>{0, 1, 2, 3, 4, 5} : std::vector<std::size_t>{0, 1, 3};
}

std::string from_state(const LoadedScene& scene, const std::string& file,
                       const std::string& stages) {
  document::Table root = own_scene(scene);
  document::Table made = document::parse(stages);
  set(root, "stage", std::move(made.front().value));
  set(root, "initial_state", {file, {}});
  document::Table& output = output_of(root);
  set(output, "samples", {samples, {}});
  set(output, "frames", {frames, {}});
  return written(root);
}

}  // namespace

std::string density_name(double density) { return fmt::format("{:g}", density); }
std::string state_file(const std::string& stage) { return fmt::format("state-{}.h5", stage); }

std::string loading_scene(const LoadedScene& scene, const ProbeSpec& spec) {
  document::Table root = own_scene(scene);
  auto& stages = document::find(root, "stage")->value.get<document::Array>();
  document::Value last = std::move(stages.back());
  stages.pop_back();
  for (const double density : spec.densities) {
    document::Value stage = last;
    auto& table = stage.get<document::Table>();
    set(table, "name", {density_name(density), {}});
    set(table, "keep_state", {true, {}});
    set(table, "until", parsed_table(fmt::format("relative_density = {:.17g}", density)));
    stages.push_back(std::move(stage));
  }
  return written(root);
}

std::string release_scene(const LoadedScene& scene, const ProbeSpec& spec,
                          const ProbeStart& start) {
  std::string stresses;
  const TensorParts stress = parts_of(start.stress);
  for (const std::size_t k : parts_of_cell(scene.scene.in_space()))
    if (k < 3 || std::abs(stress[k]) > sheared * start.pressure)
      stresses += fmt::format("stress_{} = \"{:.17g} Pa\"\n", tensor_part_names[k],
                              spec.release * stress[k]);
  return from_state(scene, start.file,
                    fmt::format(R"([[stage]]
name = "{}"
kind = "unload"
duration = "{:.17g} s"
keep_state = true
[stage.cell]
{}rise = 0.6
tolerance = 1e9
)",
                                release_stage, spec.duration, stresses));
}

std::string probing_scene(const LoadedScene& scene, const ProbeSpec& spec, const ProbeStart& start,
                          const ProbeDirection& direction) {
  const bool by_strain = spec.control == ProbeSpec::Control::strain;
  const TensorParts unit = parts_of(direction.unit), stress = parts_of(start.stress);
  std::string drive = by_strain ? "" : "rise = 1\ntolerance = 1e9\n";
  for (const std::size_t k : parts_of_cell(scene.scene.in_space())) {
    if (by_strain && unit[k] != 0)
      drive += fmt::format("strain_{} = {:.17g}\n", tensor_part_names[k], spec.size * unit[k]);
    if (!by_strain && (unit[k] != 0 || k < 3))
      drive += fmt::format("stress_{} = \"{:.17g} Pa\"\n", tensor_part_names[k],
                           stress[k] + spec.size * start.pressure * unit[k]);
  }
  return from_state(scene, start.file,
                    fmt::format(R"([[stage]]
name = "{}"
kind = "compact"
duration = "{:.17g} s"
[stage.cell]
{})",
                                probe_stage, spec.duration, drive));
}

}  // namespace pulvis
