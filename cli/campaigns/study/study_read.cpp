#include "cli/campaigns/study/study_read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

#include "cli/campaigns/study/analysis/study_checks.hpp"
#include "cli/campaigns/study/declare_study.hpp"
#include "scenes/language/describe.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/read.hpp"

namespace pulvis {
namespace {

using document::Entry;
using document::Origin;
using document::Table;
using document::Value;

constexpr std::size_t max_runs = 10'000;

const char* const introduction = R"(# The study file

<!-- Generated from the declarations in cli/campaigns/study/declare_study.cpp: change those, not this file. -->

A study is a TOML file that names a scene and the keys to vary in it. `pulvis study STUDY.toml` runs all
variations, several at once, and collects their values in one table and their curves in one report.

```toml
scene = "../compaction/regular-100.toml"

[grid]
contact.friction = [0.001, 0.1, 0.3]

[[expect]]
series = "stress_ratio/axial"
at = 0.85                              # of the relative density
order = ["friction=0.001", "friction=0.1", "friction=0.3"]
trend = "increasing"
```

Keys of the scene are written as for `--set` (docs/scene.md). Changes are applied in this order: `[set]`, the
variation's own `set`, the grid, the seed, `overrides`, and `--set` on the command line. Later ones replace values of
`[set]`. A key that the study varies is varied in one place only: a change that replaces its value is refused, because
names and tables would state values that the runs do not have. Errors in the study or in any of the resulting scenes are
reported before the first run as `file:line:col: key: what is wrong, allowed: what is allowed`.

**Series** are those of `history.csv` and `time`; for every tool `travel/<tool>`, its displacement since the start
[m]; and in a die of four plane tools `pressure/<tool>`, the force towards the tool divided by the area of its face
[Pa], and `transmission`, the force on the bottom punch divided by that on the top punch.

Studies of levers (scenes with `family = "afm"`) provide the history of the programme versus `actions`, the number of
completed actions. They also provide the **values of a run**: single numbers that need no `when`, the same as in an
`[[expect]]` of the scene (docs/afm.md#studies-of-levers).

```toml
scene = "../afm/calibration-v.toml"

[grid]
tip.height = ["2.7 um", "3.7 um", "4.7 um"]

[[fit]]
law = "power"                          # k_l = c height^exponent
series = "k_l"
key = "tip.height"
above = -2
below = -1.6
```

## Output files

| file | content |
|---|---|
| `study.csv` | one row per run: varied keys, values, quality |
| `variations.csv` | one row per variation: mean and standard deviation (n - 1) of every value over its seeds |
| `effects.csv` | main effects: for each varied key and level, the mean over all runs with this level, and their standard deviation |
| `curves.json` | the curves as plotted; for several seeds, mean (`y`), `standard_deviation`, `low` and `high` |
| `summary.json` | all of the above, the results of the checks, fitted laws with points and line of their plots, labels of the series |
| `report.html` | charts with standard deviation bars, effect plots, the last frame of each run, tables |
| `slurm.sh`, `slurm.json`, `slurm/` | on a cluster: the job script, its list of runs, its output (docs/cluster.md) |

Runs that did not complete appear only in `study.csv` and in the report's table of runs; its notes say how many are left out.
For compaction between four planes, values are also reported at the sample with the highest relative density:
`peak/relative_density`, `peak/top_force`, `peak/bottom_force`, `peak/top_pressure`, `peak/transmission`,
`peak/stress_ratio/axial`, `peak/stress_ratio/lateral`. `quality` lists all quantities of the quality card that exceed their
limits, and for levers all friction loops without a plateau; otherwise it is `within limits`. If the combinations of keys
were not all run equally often, a main effect contains part of the effects of other keys; the report marks it with *. For
variations with their own scenes, keys that some of them do not set have no main effect. The images of the last frames have
at most 3 million pixels in total, one byte each before compression; studies of more than 1302 runs have none.
)";

// Settings of a table whose keys are paths into a scene; nested tables extend the path.
void flatten(const Table& table, const std::string& above, std::vector<StudySetting>& settings) {
  for (const Entry& entry : table) {
    const std::string path = schema::joined_path(above, entry.key);
    if (const auto* inner = entry.value.as<Table>())
      flatten(*inner, path, settings);
    else
      settings.push_back({path, entry.value, entry.value.origin});
  }
}

std::string name_text(const Value& value) {
  if (const auto* array = value.as<document::Array>()) {
    std::string text;
    for (const Value& element : *array) {
      if (!text.empty()) text += '_';
      text += name_text(element);
    }
    return text;
  }
  const auto* string = value.as<std::string>();
  std::string text;
  for (const char c : string != nullptr ? *string : document::value_text(value)) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' ||
                       c == '+' || c == '.';
    if (plain)
      text += c;
    else if (c != ' ')
      text += '-';
  }
  return text;
}

std::string last_word(const std::string& path) { return path.substr(path.rfind('.') + 1); }

// The name of an axis in the names of variations.
std::string axis_name(const StudyAxis& axis, const std::vector<StudyAxis>& all) {
  const auto same = [&](const StudyAxis& other) {
    return last_word(other.path) == last_word(axis.path);
  };
  return std::ranges::count_if(all, same) == 1 ? last_word(axis.path)
                                               : name_text(Value{axis.path, {}});
}

// Files and folders next to the run folders.
constexpr std::array files_of_a_study{
    "study.toml",   "study.csv",   "fits.csv",    "strengths.csv", "sensitivities.csv",
    "summary.json", "curves.json", "report.html", "pictures",      "inputs",
    "slurm.sh",     "slurm.json",  "slurm"};

// Case-insensitive file systems treat two such names as the same.
bool can_be_folder(std::string name) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
  return !name.starts_with('.') &&
         std::ranges::find(files_of_a_study, name) == files_of_a_study.end();
}

class StudyReader {
 public:
  StudyReader(const std::filesystem::path& file, const std::vector<std::string>& overrides)
      : overrides_(overrides), problems_(file, overrides) {
    study_.file = file;
    study_.text = toml_file_text(file, "a study");
    study_.overrides = overrides;
  }

  Study read() {
    Value root{parsed(), {{1, 1}, -1}};
    const Table& table = root.get<Table>();
    schema::TableReader reader(table, problems_, schema::study_language());
    reader.read(schema::study_top_level(), root, "", "", study_.spec);
    study_.spec.common = free_table(table, "set", "set");
    read_grid(table);
    study_.spec.list = elements(reader, schema::study_variation(), table);
    read_variation_settings(reader, table);
    study_.spec.curves = elements(reader, schema::study_curve(), table);
    study_.spec.fits = elements(reader, schema::study_fit(), table);
    study_.spec.expects = elements(reader, schema::study_expect(), table);
    problems_.throw_if_any();
    const auto origin_of = [&](const char* key) {
      const Entry* entry = document::find(table, key);
      return entry == nullptr ? root.origin : entry->value.origin;
    };
    scene_origin_ = origin_of("scene");
    overrides_origin_ = origin_of("overrides");
    make_runs();
    problems_.throw_if_any();
    complete_and_check_study(study_, reader.origins(), problems_);
    problems_.throw_if_any();
    return std::move(study_);
  }

 private:
  Table parsed() {
    try {
      Table root = document::parse(study_.text);
      if (root.empty()) problems_.add({{1, 1}, -1}, "study", "is empty, allowed: a study (TOML)");
      problems_.throw_if_any();
      return root;
    } catch (const document::SyntaxError& error) {
      problems_.add({error.mark, -1}, "syntax", error.what());
      problems_.throw_if_any();
      throw;  // not reached
    }
  }

  template <class Spec>
  std::vector<Spec> elements(schema::TableReader& reader,
                             const schema::TableDeclaration<Spec>& declaration, const Table& root) {
    const document::Array& array = reader.elements(root, "", declaration.info);
    std::vector<Spec> specs(array.size());
    for (std::size_t i = 0; i < array.size(); ++i) {
      specs[i].mark = array[i].origin.mark;
      reader.read(declaration, array[i], fmt::format("{}[{}]", declaration.info.path, i), "",
                  specs[i]);
    }
    return specs;
  }

  std::vector<StudySetting> free_table(const Table& parent, const std::string& key,
                                       const std::string& path) {
    std::vector<StudySetting> settings;
    const Entry* entry = document::find(parent, key);
    if (entry == nullptr) return settings;
    if (const auto* table = entry->value.as<Table>())
      flatten(*table, "", settings);
    else
      problems_.add(entry->origin, path,
                    fmt::format("wrong type, {} is given, allowed: a table of keys of the scene",
                                document::type_name(entry->value)));
    return settings;
  }

  void read_grid(const Table& root) {
    for (const StudySetting& line : free_table(root, "grid", "grid")) {
      const auto* values = line.value.as<document::Array>();
      if (values == nullptr || values->empty()) {
        problems_.add(
            line.origin, "grid." + line.path,
            fmt::format("{} is given, allowed: one or more values, [0.1, 0.3]",
                        values == nullptr ? document::type_name(line.value) : "an empty array"));
        continue;
      }
      StudyAxis axis{line.path, {}};
      for (const Value& value : *values) axis.settings.push_back({line.path, value, value.origin});
      study_.spec.grid.push_back(std::move(axis));
    }
  }

  void read_variation_settings(schema::TableReader& reader, const Table& root) {
    const document::Array& array = reader.elements(root, "", schema::study_variation().info);
    for (std::size_t i = 0; i < study_.spec.list.size(); ++i)
      study_.spec.list[i].settings =
          free_table(array[i].get<Table>(), "set", fmt::format("variation[{}].set", i));
  }

  // Expands grid, list and seeds; the last axis changes fastest, seeds faster still.
  void make_runs() {
    std::vector<VariationSpec> list = study_.spec.list;
    if (list.empty()) list.push_back({"", "", {}, scene_origin_.mark});
    std::size_t points = 1;
    for (const StudyAxis& axis : study_.spec.grid) points *= axis.settings.size();
    const std::size_t seeds = std::max<std::size_t>(1, study_.spec.seeds.size());
    if (points > max_runs || list.size() * points * seeds > max_runs) {
      problems_.add(scene_origin_, "grid",
                    fmt::format("makes more than {} runs, allowed: at most as many", max_runs));
      return;
    }
    for (const VariationSpec& one : list)
      for (std::size_t point = 0; point < points; ++point) add_variation(one, point);
  }

  void add_variation(const VariationSpec& one, std::size_t point) {
    StudyRun run;
    run.varied = one.settings;
    std::vector<std::string> name;
    if (!one.name.empty()) name.push_back(one.name);
    std::size_t left = point;
    std::vector<const StudySetting*> chosen(study_.spec.grid.size());
    for (std::size_t a = chosen.size(); a-- > 0;) {
      const std::vector<StudySetting>& settings = study_.spec.grid[a].settings;
      chosen[a] = &settings[left % settings.size()];
      left /= settings.size();
    }
    for (std::size_t a = 0; a < chosen.size(); ++a) {
      name.push_back(axis_name(study_.spec.grid[a], study_.spec.grid) + "=" +
                     name_text(chosen[a]->value));
      run.varied.push_back(*chosen[a]);
    }
    run.variation = name.empty() ? "base" : fmt::format("{}", fmt::join(name, ","));
    const Origin origin{chosen.empty() ? one.mark : chosen.front()->origin.mark, -1};
    if (std::ranges::find(study_.variations, run.variation) != study_.variations.end())
      problems_.add(origin, "variation",
                    fmt::format("two are called '{}', allowed: each name once", run.variation));
    if (!can_be_folder(run.variation))
      problems_.add(origin, "variation.name",
                    fmt::format("'{}' cannot be the folder name of a run, allowed: a name that "
                                "does not begin with '.' and is not a file of the study ({})",
                                run.variation, fmt::join(files_of_a_study, ", ")));
    study_.variations.push_back(run.variation);
    const std::string& scene = one.scene.empty() ? study_.spec.scene : one.scene;
    if (scene.empty()) {
      problems_.add({one.mark, -1}, "scene",
                    "required key is missing, allowed: the path of a scene, here or in every "
                    "[[variation]]");
      return;
    }
    run.file = study_.file.parent_path() / scene;
    add_seeds(run, one.scene.empty() ? scene_origin_ : Origin{one.mark, -1});
  }

  void add_seeds(const StudyRun& variation, const Origin& scene_origin) {
    std::vector<std::optional<std::int64_t>> seeds{std::nullopt};
    if (!study_.spec.seeds.empty()) seeds = {study_.spec.seeds.begin(), study_.spec.seeds.end()};
    for (const std::optional<std::int64_t>& seed : seeds) {
      StudyRun run = variation;
      run.seed = seed;
      run.name = run.variation + (seed ? fmt::format(",seed={}", *seed) : "");
      load(run, scene_origin);
      study_.runs.push_back(std::move(run));
    }
  }

  // Reads the run's scene; errors are reported at the line of the study that caused them.
  void load(StudyRun& run, const Origin& scene_origin) {
    std::vector<Origin> origins;
    for (const auto* settings : {&study_.spec.common, &run.varied})
      for (const StudySetting& setting : *settings) {
        run.overrides.push_back(setting.text());
        origins.push_back(setting.origin);
      }
    if (run.seed) {
      run.overrides.push_back(fmt::format("seed={}", *run.seed));
      origins.push_back(scene_origin);
    }
    for (const std::string& change : study_.spec.overrides) {
      run.overrides.push_back(change);
      origins.push_back(overrides_origin_);
    }
    for (std::size_t i = 0; i < overrides_.size(); ++i) {
      run.overrides.push_back(overrides_[i]);
      origins.push_back({{}, static_cast<int>(i)});
    }
    try {
      LoadedScene loaded = load_scene(run.file, run.overrides);
      run.scene = std::move(loaded.scene);
      run.hash = loaded.hash;
      for (const InputFile& input : loaded.inputs) study_.files.insert(input.source);
      refuse_replaced(loaded.replaced, run, origins);
    } catch (const SceneError& error) {
      for (const SceneProblem& problem : error.errors()) tell(problem, run, origins, scene_origin);
    }
  }

  // Names and tables of the study give the varied values, which must be those of the runs.
  void refuse_replaced(const std::vector<ReplacedOverride>& replaced, const StudyRun& run,
                       const std::vector<Origin>& origins) {
    const std::size_t first = study_.spec.common.size();
    const std::size_t end = first + run.varied.size() + (run.seed ? 1 : 0);
    for (const auto [earlier, later] : replaced) {
      if (earlier < first || earlier >= end) continue;
      const std::string key = key_of(run.overrides[later]);
      const std::string what =
          "replaces a value that the study varies, allowed: one place that sets this key (the "
          "[grid], the `set` of variations, `seeds`, `overrides` or --set)";
      if (told_.insert(fmt::format("{} {}", key, origins[later].override_index)).second)
        problems_.add(origins[later], key, what);
    }
  }

  void tell(const SceneProblem& problem, const StudyRun& run, const std::vector<Origin>& origins,
            const Origin& scene_origin) {
    if (!told_.insert(problem.text()).second) return;  // otherwise every run would repeat it
    const auto cause = std::ranges::find(run.overrides, problem.override_text);
    if (problem.override_text.empty() || cause == run.overrides.end())
      problems_.add(scene_origin, "scene", problem.text());
    else
      problems_.add(origins[static_cast<std::size_t>(cause - run.overrides.begin())], problem.key,
                    problem.message);
  }

  std::vector<std::string> overrides_;
  Problems problems_;
  Study study_;
  Origin scene_origin_, overrides_origin_;
  std::set<std::string> told_;
};

}  // namespace

std::string StudySetting::text() const { return path + "=" + document::value_text(value); }

Study load_study(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return StudyReader(file, overrides).read();
}

std::string study_reference() { return reference_of(introduction, schema::study_language()); }

}  // namespace pulvis
