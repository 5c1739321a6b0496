#include "cli/campaigns/probe/probe_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/portable_math.hpp"
#include "scenes/keys/tables.hpp"
#include "scenes/language/scene_text.hpp"

namespace pulvis {
namespace {

constexpr std::int64_t samples = 400, frames = 2;  // per probe

document::Value parsed_table(const std::string& text) { return {document::parse(text), {}}; }

void set(document::Table& table, const std::string& key, document::Value value) {
  if (document::Entry* entry = document::find(table, key))
    entry->value = std::move(value);
  else
    table.push_back({key, {}, std::move(value)});
}

// Expectations of the path's own scene do not apply to these.
document::Table without_expectations(const LoadedScene& scene) {
  document::Table root = document::parse(scene.text);
  std::erase_if(root, [](const document::Entry& entry) { return entry.key == "expect"; });
  return root;
}

std::string written(const document::Table& root) { return scene_text(root, language_of(root)); }

}  // namespace

std::string density_name(double density) { return fmt::format("{:g}", density); }

std::string loading_scene(const LoadedScene& scene, const ProbeSpec& spec) {
  document::Table root = without_expectations(scene);
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

std::string probing_scene(const LoadedScene& scene, const ProbeSpec& spec, const ProbeStart& start,
                          std::optional<double> angle) {
  document::Table root = without_expectations(scene);
  const double xx = spec.release * start.stress[0], yy = spec.release * start.stress[1];
  std::string drive;
  const bool by_strain = spec.control == ProbeSpec::Control::strain;
  if (!angle && by_strain) {
    drive = fmt::format("strain_xy = {:.17g}\n", spec.size);
  } else if (!angle) {
    drive = fmt::format("stress_xy = \"{:.17g} Pa\"\nrise = 1\ntolerance = 1e9\n",
                        spec.size * start.pressure);
  } else if (by_strain) {
    drive = fmt::format("strain_xx = {:.17g}\nstrain_yy = {:.17g}\n",
                        spec.size * portable::cos(*angle), spec.size * portable::sin(*angle));
  } else {
    const double size = spec.size * start.pressure;
    drive = fmt::format(
        "stress_xx = \"{:.17g} Pa\"\nstress_yy = \"{:.17g} Pa\"\nrise = 1\ntolerance = 1e9\n",
        xx + size * portable::cos(*angle), yy + size * portable::sin(*angle));
  }
  const std::string stages = fmt::format(
      R"([[stage]]
name = "{}"
kind = "unload"
duration = "{:.17g} s"
[stage.cell]
stress_xx = "{:.17g} Pa"
stress_yy = "{:.17g} Pa"
rise = 0.6
tolerance = 1e9
[[stage]]
name = "{}"
kind = "compact"
duration = "{:.17g} s"
[stage.cell]
{})",
      release_stage, spec.duration, xx, yy, probe_stage, spec.duration, drive);
  document::Table made = document::parse(stages);
  set(root, "stage", std::move(made.front().value));
  set(root, "initial_state", {start.state, {}});
  auto& output = document::find(root, "output")->value.get<document::Table>();
  set(output, "samples", {samples, {}});
  set(output, "frames", {frames, {}});
  return written(root);
}

}  // namespace pulvis
