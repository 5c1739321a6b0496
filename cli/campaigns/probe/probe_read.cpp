#include "cli/campaigns/probe/probe_read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "cli/campaigns/probe/declare_probe.hpp"
#include "cli/campaigns/probe/probe_directions.hpp"
#include "cli/campaigns/probe/probe_scenes.hpp"
#include "scenes/language/describe.hpp"
#include "scenes/language/seed_list.hpp"
#include "scenes/language/table_reader.hpp"

namespace pulvis {
namespace {

const char* const introduction = R"(# The probe file

<!-- Generated from the declarations in cli/campaigns/probe/declare_probe.cpp: change those, not this file. -->

A probe determines the yield surface of a powder. The probe file is a TOML file that names scenes of a powder in a
periodic cell. `pulvis probe PROBE.toml` loads the powder along every path and saves its state at every density. From each
state it unloads slightly and then loads in many directions, several runs at once. It reports and plots the yield points,
the elastic moduli and the parameters of cap models. If interrupted, the same command resumes.

```toml
densities = [0.85, 0.90, 0.95]
seeds = [1, 2]

[[path]]
name = "isostatic"
scene = "copper-isostatic.toml"

[probe]
duration = "0.2 ms"
```

Strains and stresses have the sign convention of scenes: tension > 0. A direction is an angle in a plane of strains, or of
stresses. In two dimensions it is the plane of (xx, yy): 225 degrees is equal compression in both. In three it is that of
(sqrt(2) times xx = yy, zz): 215.3 degrees is equal compression in all, 270 degrees compression along z alone. Errors in the probe file or in a scene it names are reported before the first run
as `file:line:col: key: what is wrong, allowed: what is allowed`.
)";

class ProbeReader {
 public:
  ProbeReader(const std::filesystem::path& file, const std::vector<std::string>& overrides)
      : overrides_(overrides), problems_(file, overrides) {
    probe_.file = file;
    probe_.text = toml_file_text(file, "a probe");
    probe_.overrides = overrides;
    probe_.spec.title = file.stem().string();
  }

  Probe read() {
    const document::Value root{parsed(), {{1, 1}, -1}};
    const auto& table = root.get<document::Table>();
    schema::TableReader reader(table, problems_, schema::probe_language());
    reader.read(schema::probe_top_level(), root, "", "", probe_.spec);
    for (const auto* one : {&schema::probe_probe(), &schema::probe_yield()}) {
      const document::Entry* entry = document::find(table, one->info.path);
      const document::Value none{document::Table{}, {{1, 1}, -1}};
      reader.read(*one, entry != nullptr ? entry->value : none, one->info.path, "", probe_.spec);
    }
    read_all(reader, table, schema::probe_path(), probe_.spec.paths);
    read_all(reader, table, schema::probe_powder(), probe_.spec.powders);
    read_all(reader, table, schema::probe_direction(), probe_.spec.given);
    problems_.throw_if_any();
    check(reader.origins());
    problems_.throw_if_any();
    const std::size_t powders = std::max<std::size_t>(1, probe_.spec.powders.size());
    for (std::size_t i = 0; i < probe_.spec.paths.size(); ++i)
      for (std::size_t k = 0; k < powders; ++k) load(i, k, reader.origins());
    problems_.throw_if_any();
    check_dimensions(reader.origins());
    problems_.throw_if_any();
    return std::move(probe_);
  }

 private:
  template <class Element>
  static void read_all(schema::TableReader& reader, const document::Table& table,
                       const schema::TableDeclaration<Element>& declaration,
                       std::vector<Element>& all) {
    const document::Array& elements = reader.elements(table, "", declaration.info);
    for (std::size_t i = 0; i < elements.size(); ++i) {
      all.emplace_back().mark = elements[i].origin.mark;
      reader.read(declaration, elements[i], fmt::format("{}[{}]", declaration.info.path, i), "",
                  all.back());
    }
  }

  document::Table parsed() {
    try {
      return document::parse(probe_.text);
    } catch (const document::SyntaxError& error) {
      problems_.add({error.mark, -1}, "syntax", error.what());
      problems_.throw_if_any();
      throw;  // not reached
    }
  }

  void check(const schema::Origins& origins) {
    const std::vector<double>& densities = probe_.spec.densities;
    if (std::ranges::adjacent_find(densities, std::greater_equal()) != densities.end())
      problems_.add(origins.at("densities"), "densities",
                    "they do not increase, allowed: each larger than the one before");
    if (repeats_a_seed(probe_.spec.seeds))
      problems_.add(origins.at("seeds"), "seeds", repeated_seed);
    if (probe_.spec.paths.empty())
      problems_.add({{1, 1}, -1}, "path", "none is given, allowed: at least one [[path]]");
    for (std::size_t i = 0; i < probe_.spec.given.size(); ++i) {
      const GivenDirection& one = probe_.spec.given[i];
      if (std::ranges::all_of(one.parts, [](double part) { return part == 0; }))
        problems_.add({one.mark, -1}, fmt::format("direction[{}]", i),
                      "all components are zero, allowed: at least one that is not");
      if (one.name == release_stage)
        problems_.add({one.mark, -1}, fmt::format("direction[{}].name", i),
                      "it is that of the run that unloads, allowed: another name");
    }
  }

  // Once the dimensions of the paths are known.
  void check_dimensions(const schema::Origins& origins) {
    const auto in_space = [](const ProbeLoading& one) { return one.scene.scene.in_space(); };
    const bool any_space = std::ranges::any_of(probe_.loadings, in_space);
    const bool any_plane = !std::ranges::all_of(probe_.loadings, in_space);
    if (const auto given = origins.find("probe.deviatoric"); given != origins.end() && !any_space)
      problems_.add(given->second, "probe.deviatoric",
                    "no path has three dimensions, allowed: only with a scene that does");
    for (std::size_t i = 0; i < probe_.spec.given.size(); ++i) {
      const GivenDirection& one = probe_.spec.given[i];
      const document::Origin at{one.mark, -1};
      for (const std::size_t k : {2, 4, 5})
        if (any_plane && one.parts[k] != 0)
          problems_.add(at, fmt::format("direction[{}].{}", i, tensor_part_names[k]),
                        "a path has two dimensions, allowed there: xx, yy and xy");
      for (const bool space : {false, true})
        for (const ProbeDirection& own : directions_of({}, space))
          if ((space ? any_space : any_plane) && own.name == one.name)
            problems_.add(at, fmt::format("direction[{}].name", i),
                          fmt::format("'{}' is the name of a direction that is probed anyway, "
                                      "allowed: another name",
                                      one.name));
    }
  }

  // With the k-th powder.
  void load(std::size_t i, std::size_t k, const schema::Origins& origins) {
    const ProbePath& path = probe_.spec.paths[i];
    const document::Origin at = origins.at(fmt::format("path[{}].scene", i));
    std::string history = path.name;
    std::vector<std::string> changes = probe_.spec.overrides;
    if (k < probe_.spec.powders.size()) {
      const ProbePowder& powder = probe_.spec.powders[k];
      history += "," + powder.name;
      changes.insert(changes.end(), powder.overrides.begin(), powder.overrides.end());
    }
    probe_.histories.push_back(history);
    std::vector<std::int64_t> seeds = probe_.spec.seeds;
    const bool own = seeds.empty();
    if (own) seeds.push_back(0);
    for (const std::int64_t seed : seeds) {
      std::vector<std::string> overrides = changes;
      overrides.insert(overrides.end(), overrides_.begin(), overrides_.end());
      if (!own) overrides.push_back(fmt::format("seed={}", seed));
      ProbeLoading loading{history, history, seed, {}};
      try {
        loading.scene = load_scene(probe_.file.parent_path() / path.scene, overrides);
      } catch (const SceneError& error) {
        for (const SceneProblem& problem : error.errors())
          problems_.add(at, "scene", problem.text());
        return;
      }
      refuse_replaced(loading.scene.replaced, changes.size(), origins);
      const Scene& scene = loading.scene.scene;
      if (scene.afm || !scene.cell || scene.stages.empty() || !scene.stages.back().cell) {
        problems_.add(at, "scene",
                      "its last stage does not deform a periodic cell, allowed: a scene with "
                      "[cell] whose last stage has [stage.cell]");
        return;
      }
      loading.seed = static_cast<std::int64_t>(scene.seed);
      if (!own) loading.name += fmt::format(",seed={}", seed);
      probe_.loadings.push_back(std::move(loading));
    }
  }

  static document::Origin file_overrides(const schema::Origins& origins) {
    const auto found = std::ranges::find_if(origins, [](const auto& one) {
      return one.first == "overrides" || one.first.ends_with(".overrides");
    });
    return found == origins.end() ? document::Origin{{1, 1}, -1} : found->second;
  }

  // The seed of the probe is the last setting: one of the scene's own would have no effect.
  // `listed` come from the file.
  void refuse_replaced(const std::vector<ReplacedOverride>& replaced, std::size_t listed,
                       const schema::Origins& origins) {
    for (const auto [earlier, later] : replaced)
      if (later == listed + overrides_.size() && !std::exchange(seed_told_, true))
        problems_.add(earlier < listed ? file_overrides(origins)
                                       : document::Origin{{}, static_cast<int>(earlier - listed)},
                      earlier < listed ? "overrides" : "seed",
                      "the probe has its own `seeds`, allowed: a seed in one of the two places");
  }

  std::vector<std::string> overrides_;
  Problems problems_;
  Probe probe_;
  bool seed_told_ = false;
};

}  // namespace

Probe load_probe(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return ProbeReader(file, overrides).read();
}

std::string probe_reference() { return reference_of(introduction, schema::probe_language()); }

}  // namespace pulvis
