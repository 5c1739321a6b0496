// Declarations of reduce.toml: one sliding-plate test, its records and its test condition.
#include "cli/laboratory/declare_columns.hpp"
#include "cli/laboratory/declare_lab.hpp"
#include "scenes/keys/declare.hpp"

namespace pulvis::lab {

using namespace schema;

namespace {

std::vector<Key<RunSpec>> record_keys() {
  return {{{.name = "name",
            .kind = Kind::name,
            .doc = "Name used for the run's file and curve.",
            .fallback_doc = "`run-1`, `run-2`, ..."},
           to(&RunSpec::name)},
          {{.name = "press",
            .kind = Kind::file,
            .required = true,
            .doc = "Record of the press (CSV), as a path relative to the folder of this file."},
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
            .doc = "Time on the press clock minus time on the logger clock, if known from a "
                   "trigger; the press record is then not searched for an event.",
            .fallback_doc = "determined from the start of sliding"},
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
  return {condition_key(
              "load", "N", 1e9, &RunSpec::load,
              "Condition: normal force. If runs state conditions, all runs must state the "
              "same ones; a table of the conditions with the effect of each is then produced."),
          condition_key("roughness", "m", 1, &RunSpec::roughness,
                        "Condition: roughness Ra of the target."),
          {{.name = "direction",
            .kind = Kind::name,
            .doc = "Condition: sliding direction relative to the lay, such as \"aligned\" or "
                   "\"transverse\".",
            .fallback_doc = "none"},
           to(&RunSpec::direction)},
          condition_key("speed", "m/s", 1e3, &RunSpec::speed, "Condition: target speed."),
          {{.name = "powder",
            .kind = Kind::choice,
            .choices = powders(),
            .doc = "Condition: powder; its Poisson's ratio replaces that of `[compact]`.",
            .fallback_doc = "none: that of `[compact]`"},
           [](RunSpec& spec, const Decoded& value) { spec.powder = value.index; }},
          {{.name = "length",
            .kind = Kind::quantity,
            .unit = "m",
            .range = above(0, 1),
            .doc = "Length of the compact in this run at the start of sliding. Not a condition.",
            .fallback_doc = "that of `[compact]`"},
           to(&RunSpec::length)}};
}

}  // namespace

const TableDeclaration<RunSpec>& declared_run() {
  static const TableDeclaration<RunSpec> declaration = [] {
    TableDeclaration<RunSpec> made{
        {"run", true, "", "One test. Records given on the command line are appended to these."},
        record_keys()};
    for (const auto& key : condition_keys()) made.keys.push_back(key);
    return made;
  }();
  return declaration;
}

}  // namespace pulvis::lab
