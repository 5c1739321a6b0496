#include "cli/laboratory/lab_settings.hpp"
#include "scenes/language/describe_schema.hpp"

#include "cli/laboratory/declare_lab.hpp"
#include "cli/laboratory/volts/declare_volts.hpp"
#include "engine/files/input_file.hpp"
#include "scenes/language/describe.hpp"
#include "scenes/language/override.hpp"
#include "scenes/language/scene_text.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace pulvis::lab {
namespace {

constexpr std::size_t largest_file = 16U << 20U;  // bytes
constexpr const char* introduction = R"(# The settings of `pulvis reduce`

<!-- Generated from the declarations in cli/laboratory/declare_*.cpp: change those, not this file. -->

A TOML file (`reduce.toml`) that describes the instruments, the compact or die, and the records for
`pulvis reduce`. Every key can also be given as `--set key.path=value`. Quantities are strings with a unit,
as in a scene; ranges below are in SI units. Numbers in parentheses, such as (3.1), refer to equations and
sections of the thesis. The evaluation is described in [laboratory.md](laboratory.md).
)";

class SettingsReader {
 public:
  SettingsReader(const document::Table& root, Problems& problems)
      : root_(root), problems_(problems), tables_(root, problems, language()) {}

  Settings read(const std::filesystem::path& file) {
    Settings all;
    all.file = file;
    tables_.read(declared_top(), document::Value{root_, {{1, 1}, -1}}, "", "", all);
    read_one(declared_press(), all.press);
    read_one(declared_logger(), all.logger);
    read_one(declared_load_cell(), all.load_cell);
    read_one(declared_lvdt(), all.lvdt);
    read_one(declared_compact(), all.compact);
    read_one(declared_clock(), all.clock);
    read_one(declared_analysis(), all.analysis);
    read_one(declared_simulation(), all.simulation);
    read_one(declared_wedge(), all.wedge);
    read_one(volts::declared_afm(), all.volts.afm);
    read_one(volts::declared_force_curves(), all.volts.force_curves);
    read_one(volts::declared_lever(), all.volts.lever);
    read_one(volts::declared_crosstalk(), all.volts.crosstalk);
    read_one(volts::declared_test_probe(), all.volts.test_probe);
    read_one(declared_die(), all.die);
    read_one(declared_compression(), all.compression);
    read_each(declared_run(), all.runs);
    read_each(declared_curve(), all.curves);
    read_one(declared_gauges(), all.gauges);
    read_each(declared_transmission(), all.transmissions);
    return all;
  }

  void check_conditions(const std::vector<RunSpec>& runs) {
    const auto stated = [](const RunSpec& run) {
      std::vector<std::string> names;
      if (run.load) names.emplace_back("load");
      if (run.roughness) names.emplace_back("roughness");
      if (!run.direction.empty()) names.emplace_back("direction");
      if (run.speed) names.emplace_back("speed");
      if (run.powder) names.emplace_back("powder");
      return names;
    };
    for (std::size_t i = 1; i < runs.size(); ++i)
      if (stated(runs[i]) != stated(runs.front()))
        add(fmt::format("run[{}]", i),
            fmt::format("states {} as its condition, the first run {}, allowed: the same ones",
                        listed(stated(runs[i])), listed(stated(runs.front()))));
  }

  void check(const Settings& all) {
    for (const volts::Fault& fault : volts::faults_of(all.volts, !all.wedge.loops.empty()))
      add(fault.path, fault.what);
    check_kinds(all);
    if (all.fills_die()) check_die(all);
    if (all.volts.wanted() || !all.wedge.loops.empty() || all.fills_die())
      return;  // no compact on a plate
    const auto every = [&](auto RunSpec::*member) {
      return !all.runs.empty() && std::ranges::all_of(all.runs, [=](const RunSpec& run) {
        return (run.*member).has_value();
      });
    };
    if (!every(&RunSpec::length))
      exactly_one("compact.length", all.compact.length.has_value(), "compact.fill_height",
                  all.compact.fill_height.has_value(), "length = \"10 mm\"");
    if (!every(&RunSpec::powder))
      exactly_one("compact.poissons_ratio", all.compact.poissons_ratio.has_value(),
                  "compact.powder", all.compact.powder.has_value(), "powder = \"316L\"");
    check_conditions(all.runs);
    if (all.load_cell.gain == 0)
      add("load_cell.gain", "is 0 N, allowed: the force of the load cell per unit strain");
    const AnalysisSpec& a = all.analysis;
    if (a.dynamic_until && !(*a.dynamic_until > a.dynamic_from))
      add("analysis.dynamic_until",
          fmt::format("{:g} m is not beyond dynamic_from, allowed: > {:g} m", *a.dynamic_until,
                      a.dynamic_from));
  }

 private:
  template <class Spec>
  void read_one(const schema::TableDeclaration<Spec>& declaration, Spec& spec) {
    if (const document::Entry* entry = document::find(root_, declaration.info.path))
      tables_.read(declaration, entry->value, declaration.info.path, "", spec);
  }

  template <class Spec>
  void read_each(const schema::TableDeclaration<Spec>& declaration, std::vector<Spec>& specs) {
    const document::Array& elements = tables_.elements(root_, "", declaration.info);
    for (std::size_t i = 0; i < elements.size(); ++i) {
      Spec spec;
      spec.mark = elements[i].origin.mark;
      tables_.read(declaration, elements[i], fmt::format("{}[{}]", declaration.info.path, i), "",
                   spec);
      specs.push_back(std::move(spec));
    }
  }

  // Records of one kind only: each kind has its own tables.
  void check_kinds(const Settings& all) {
    std::vector<std::string> kinds;
    if (!all.wedge.loops.empty()) kinds.emplace_back("wedge");
    if (!all.runs.empty()) kinds.emplace_back("run");
    if (!all.curves.empty()) kinds.emplace_back("curve");
    if (!all.transmissions.empty()) kinds.emplace_back("transmission");
    if (kinds.size() > 1)
      add(kinds.back(),
          fmt::format("is given together with {}, allowed: records of one kind in one file",
                      kinds.front()));
  }

  template <class Spec>
  void check_fillings(const std::string& table, const std::vector<Spec>& fillings,
                      bool empty_press) {
    std::set<std::string> names;
    for (std::size_t i = 0; i < fillings.size(); ++i) {
      const Filling& one = fillings[i];
      const std::string path = fmt::format("{}[{}]", table, i);
      if (!names.insert(one.name).second)
        add(path + ".name",
            fmt::format("'{}' is the name of another, allowed: each name once", one.name));
      if (one.fill_height && one.final_height)
        add(path + ".final_height",
            "is given together with fill_height, allowed: only one of them");
      if (!one.fill_height && !one.final_height && !empty_press)
        add(path,
            "has no height, allowed: fill_height, final_height, or compression.empty with the same "
            "zero");
    }
  }

  void check_die(const Settings& all) {
    const CompressionSpec& c = all.compression;
    if (all.die.solid_density == 0)
      add("die.solid_density", "is not given, allowed: > 0 kg/m^3, for relative densities");
    if (!c.empty.empty() && !c.compliance.empty())
      add("compression.compliance",
          "is given together with compression.empty, allowed: only one of them");
    if (c.fit_from && c.fit_until && !(*c.fit_until > *c.fit_from))
      add("compression.fit_until", fmt::format("{:g} Pa is not beyond fit_from, allowed: > {:g} Pa",
                                               *c.fit_until, *c.fit_from));
    check_fillings("curve", all.curves, !c.empty.empty());
    check_fillings("transmission", all.transmissions, !c.empty.empty());
  }

  void add(const std::string& path, const std::string& message) {
    const auto& origins = tables_.origins();
    const std::string table = path.substr(0, path.find('.'));
    const std::string element = path.substr(0, path.rfind('.'));
    const auto found = origins.contains(path)      ? origins.find(path)
                       : origins.contains(element) ? origins.find(element)
                                                   : origins.find(table);
    problems_.add(found == origins.end() ? document::Origin{{1, 1}, -1} : found->second, path,
                  message);
  }

  void exactly_one(const std::string& a, bool has_a, const std::string& b, bool has_b,
                   const std::string& example) {
    if (has_a == has_b)
      add(a, fmt::format("{} given, allowed: either {} or {}, e.g. {}",
                         has_a ? "two are" : "none is", a, b, example));
  }

  const document::Table& root_;
  Problems& problems_;
  schema::TableReader tables_;
};

}  // namespace

Settings Settings::of_run(const RunSpec& run) const {
  Settings own = *this;
  if (run.length) own.compact.length = run.length;
  if (run.length) own.compact.fill_height.reset();
  if (run.powder) own.compact.powder = run.powder;
  if (run.powder) own.compact.poissons_ratio.reset();
  return own;
}

namespace {

document::Table parsed(const std::string& text, Problems& problems) {
  try {
    return document::parse(text);
  } catch (const document::SyntaxError& error) {
    problems.add({error.mark, -1}, "syntax", error.what());
    problems.throw_if_any();
    throw;  // not reached
  }
}

void make_complete(LoadedSettings& loaded) {
  document::Table root = loaded.root;
  loaded.inputs = keep_inputs(root, loaded.settings.file.parent_path(), {}, language());
  loaded.text = scene_text(root, language());
}

}  // namespace

std::string reference() { return reference_of(introduction, language()); }

std::string json_schema() {
  return json_schema_of("Pulvis: settings of the reduction of sliding-plate tests",
                        "cli/laboratory/declare_lab.cpp", language());
}

LoadedSettings load_settings_text(const std::string& text, const std::filesystem::path& file,
                                  const std::vector<std::string>& overrides) {
  Problems problems(file, overrides);
  document::Table root = parsed(text, problems);
  apply_overrides(root, overrides, problems);
  problems.throw_if_any();
  schema::fill_defaults(root, language());
  SettingsReader reader(root, problems);
  LoadedSettings loaded{reader.read(file)};
  problems.throw_if_any();
  reader.check(loaded.settings);
  problems.throw_if_any();
  loaded.root = std::move(root);
  make_complete(loaded);
  return loaded;
}

void add_runs(LoadedSettings& loaded, const std::vector<RunSpec>& runs) {
  if (runs.empty()) return;
  if (document::find(loaded.root, "run") == nullptr)
    loaded.root.push_back({"run", {}, {document::Array{}, {}}});
  auto& tables = document::find(loaded.root, "run")->value.get<document::Array>();
  for (const RunSpec& run : runs)
    tables.push_back({document::Table{{"name", {}, {run.name, {}}},
                                      {"press", {}, {run.press, {}}},
                                      {"logger", {}, {run.logger, {}}}},
                      {}});
  make_complete(loaded);
}

LoadedSettings load_settings(const std::filesystem::path& file,
                             const std::vector<std::string>& overrides) {
  if (file.empty()) return load_settings_text("", "reduce.toml (none given)", overrides);
  try {
    return load_settings_text(text_of_input(file, largest_file), file, overrides);
  } catch (const UnfitInput& unfit) {
    throw SceneError({{file.string(), 1, 1, "", "settings",
                       fmt::format("{}, allowed: settings of a reduction (TOML)", unfit.what())}});
  }
}

}  // namespace pulvis::lab
