// Declarations of reduce.toml: one sliding-plate test, its records and the condition it was made under.
#include "scenes/keys/declare.hpp"
#include "scenes/records/declare_columns.hpp"
#include "scenes/records/declare_lab.hpp"

namespace pulvis::lab {

using namespace schema;

namespace {

std::vector<Key<RunSpec>> record_keys() {
  return {
      {{.name = "name",
        .kind = Kind::name,
        .doc = "Names the run's file and curve.",
        .fallback_doc = "`run-1`, `run-2`, ..."},
       to(&RunSpec::name)},
      {{.name = "press",
        .kind = Kind::file,
        .required = true,
        .doc = "Record of the press (CSV), as a path from the folder of this file."},
       to(&RunSpec::press)},
      {{.name = "logger",
        .kind = Kind::file,
        .required = true,
        .doc = "Record of the data logger (CSV), likewise."},
       to(&RunSpec::logger)},
      {{.name = "offset",
        .kind = Kind::quantity,
        .unit = "s",
        .range = within(-1e9, 1e9),
        .doc = "Time on the press's clock less that on the logger's, where a trigger told it; no "
               "event is looked for in the press's record then.",
        .fallback_doc = "found from the start of sliding"},
       to(&RunSpec::offset)}};
}

Key<RunSpec> condition_key(const char* name, const char* unit, double largest,
                           std::optional<double> RunSpec::*member, const char* doc) {
  return {{.name = name,
           .kind = Kind::quantity,
           .unit = unit,
           .range = above(0, largest),
           .doc = doc,
           .fallback_doc = "none"},
          to(member)};
}

std::vector<Key<RunSpec>> condition_keys() {
  return {
      condition_key("load", "N", 1e9, &RunSpec::load,
                    "Condition: the normal force. Where runs state conditions, all state the same "
                    "ones, and a table over the conditions with the effect of each is made."),
      condition_key("roughness", "m", 1, &RunSpec::roughness,
                    "Condition: roughness Ra of the target."),
      {{.name = "direction",
        .kind = Kind::name,
        .doc = "Condition: sliding along or across the lay, as \"aligned\", \"transverse\".",
        .fallback_doc = "none"},
       to(&RunSpec::direction)},
      condition_key("speed", "m/s", 1e3, &RunSpec::speed, "Condition: speed of the target."),
      {{.name = "powder",
        .kind = Kind::choice,
        .choices = powders(),
        .doc = "Condition: the powder; its Poisson's ratio stands for that of `[compact]`.",
        .fallback_doc = "none: that of `[compact]`"},
       [](RunSpec& spec, const Decoded& value) { spec.powder = value.index; }},
      {{.name = "length",
        .kind = Kind::quantity,
        .unit = "m",
        .range = above(0, 1),
        .doc = "Length of this run's compact when sliding starts. No condition.",
        .fallback_doc = "that of `[compact]`"},
       to(&RunSpec::length)}};
}

}  // namespace

const TableDeclaration<RunSpec>& declared_run() {
  static const TableDeclaration<RunSpec> declaration = [] {
    TableDeclaration<RunSpec> made{
        {"run", true, "", "One test. Records given on the command line are added behind these."},
        record_keys()};
    for (const auto& key : condition_keys()) made.keys.push_back(key);
    return made;
  }();
  return declaration;
}

}  // namespace pulvis::lab
