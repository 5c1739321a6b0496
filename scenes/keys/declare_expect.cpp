// Declarations of the expectations that a run must meet.
#include "scenes/keys/declare.hpp"

namespace pulvis::schema {
namespace {

ExpectSpec::Bound bound_of(const Decoded& value) { return {value.number, value.text}; }

auto bound_to(std::optional<ExpectSpec::Bound> ExpectSpec::*member) {
  return [member](ExpectSpec& spec, const Decoded& value) { spec.*member = bound_of(value); };
}

std::vector<Key<ExpectSpec>> series_keys() {
  return {
      {{.name = "series",
        .kind = Kind::text,
        .doc = "A series of `history.csv`; `momentum/x`, `momentum/y` or `momentum/angular` (about "
               "the origin) of the whole powder; or a value of the whole run: "
               "`energy_balance_error`, "
               "`kinetic_ratio`.",
        .fallback_doc = "none: the expectation concerns the `outcome`",
        .in_3d = {.doc = "A series of `history.csv`; `momentum/x`, `momentum/y`, `momentum/z`, "
                         "`momentum/angular_x`, `momentum/angular_y` or `momentum/angular_z` "
                         "(about the origin) of the whole powder; or a value of the whole run: "
                         "`energy_balance_error`, `kinetic_ratio`."}},
       to(&ExpectSpec::series)},
      {{.name = "when",
        .kind = Kind::choice,
        .choices = words_of<ExpectSpec::When>(
            {{"end", "the last sample"},
             {"always", "every sample"},
             {"max", "the largest sample"},
             {"min", "the smallest sample"},
             {"mean", "the mean of the samples"},
             {"range", "largest minus smallest value: drift or oscillation"}}),
        .needs = "series",
        .doc = "Which value of the series is checked.",
        .fallback_doc = "`\"end\"`; with `like`: `\"always\"`"},
       word_to(&ExpectSpec::when)},
      {{.name = "from",
        .kind = Kind::number,
        .range = within(0, 1),
        .needs = "series",
        .doc = "Fraction of the run time before which samples are ignored.",
        .fallback_doc = "0"},
       to(&ExpectSpec::from)},
      {{.name = "until",
        .kind = Kind::number,
        .range = within(0, 1),
        .needs = "series",
        .doc = "Fraction of the run time after which samples are ignored.",
        .fallback_doc = "1"},
       to(&ExpectSpec::until)},
  };
}

std::vector<Key<ExpectSpec>> bound_keys() {
  return {
      {{.name = "above",
        .kind = Kind::bound,
        .needs = "series",
        .doc = "Lower bound of the value.",
        .fallback_doc = "no lower bound"},
       bound_to(&ExpectSpec::above)},
      {{.name = "below",
        .kind = Kind::bound,
        .needs = "series",
        .doc = "Upper bound of the value.",
        .fallback_doc = "no upper bound"},
       bound_to(&ExpectSpec::below)},
      {{.name = "equals",
        .kind = Kind::bound,
        .needs = "series",
        .doc = "Expected value.",
        .fallback_doc = "none"},
       bound_to(&ExpectSpec::equals)},
      {{.name = "like",
        .kind = Kind::scene,
        .needs = "series",
        .doc = "Reference scene, as a path relative to the folder of this scene. It is run "
               "with the same number of samples, and its series is the expected result.",
        .fallback_doc = "none"},
       to(&ExpectSpec::like)},
      {{.name = "scale",
        .kind = Kind::number,
        .range = within(-1e30, 1e30),
        .fallback = value_of(1.0),
        .needs = "like",
        .doc = "Factor applied to the series of the reference scene."},
       to(&ExpectSpec::scale)},
      {{.name = "within",
        .kind = Kind::number,
        .range = within(0, 1e30),
        .needs = "series",
        .doc = "Tolerance: a fraction of |equals| (an absolute value in SI units if `equals` "
               "is 0), or of the largest value of the reference series. Required with "
               "`equals` and `like`.",
        .fallback_doc = "none"},
       to(&ExpectSpec::within)},
  };
}

std::vector<Key<ExpectSpec>> outcome_keys() {
  return {
      {{.name = "outcome",
        .kind = Kind::choice,
        .choices = {{"stops", "a health check or a limit stops the run"}},
        .doc = "Expected end of the run.",
        .fallback_doc = "the run completes"},
       [](ExpectSpec& spec, const Decoded&) { spec.stops = true; }},
      {{.name = "message",
        .kind = Kind::text,
        .needs = "outcome",
        .doc = "Regular expression (RE2 syntax: no look-around, no back-references) that must "
               "match the error message of the stopped run.",
        .fallback_doc = "required with `outcome`"},
       to(&ExpectSpec::message)},
  };
}

}  // namespace

const TableDeclaration<ExpectSpec>& expect() {
  static const TableDeclaration<ExpectSpec> declaration = [] {
    TableDeclaration<ExpectSpec> made{
        {"expect", true, "",
         "A check on the run: `pulvis run` reports whether it is met, and exits with "
         "code 3 if it is not. It either bounds a series or names an outcome.",
         every_family},
        series_keys()};
    for (const auto& more : {bound_keys(), outcome_keys()})
      made.keys.insert(made.keys.end(), more.begin(), more.end());
    return made;
  }();
  return declaration;
}

}  // namespace pulvis::schema
