// Declarations of what must hold of a run.
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
        .fallback_doc = "none: the expectation is about the `outcome`"},
       to(&ExpectSpec::series)},
      {{.name = "when",
        .kind = Kind::choice,
        .choices = {{"end", "the last sample"},
                    {"always", "every sample"},
                    {"max", "the largest sample"},
                    {"min", "the smallest sample"},
                    {"mean", "the mean of the samples"},
                    {"range", "the largest less the smallest: how far it drifts or swings"}},
        .needs = "series",
        .doc = "What of the series is meant.",
        .fallback_doc = "`\"end\"`; with `like`: `\"always\"`"},
       [](ExpectSpec& spec, const Decoded& value) {
         spec.when = static_cast<ExpectSpec::When>(value.index);
       }},
      {{.name = "from",
        .kind = Kind::number,
        .range = within(0, 1),
        .needs = "series",
        .doc = "Share of the run's time before which samples do not count.",
        .fallback_doc = "0"},
       to(&ExpectSpec::from)},
      {{.name = "until",
        .kind = Kind::number,
        .range = within(0, 1),
        .needs = "series",
        .doc = "Share of the run's time after which samples do not count.",
        .fallback_doc = "1"},
       to(&ExpectSpec::until)},
  };
}

std::vector<Key<ExpectSpec>> bound_keys() {
  return {
      {{.name = "above",
        .kind = Kind::bound,
        .needs = "series",
        .doc = "Smallest value that will do.",
        .fallback_doc = "no such bound"},
       bound_to(&ExpectSpec::above)},
      {{.name = "below",
        .kind = Kind::bound,
        .needs = "series",
        .doc = "Largest value that will do.",
        .fallback_doc = "no such bound"},
       bound_to(&ExpectSpec::below)},
      {{.name = "equals",
        .kind = Kind::bound,
        .needs = "series",
        .doc = "The value that the law gives.",
        .fallback_doc = "no such value"},
       bound_to(&ExpectSpec::equals)},
      {{.name = "like",
        .kind = Kind::scene,
        .needs = "series",
        .doc = "Another scene, as a path from this one's folder. It is run too, with as many "
               "samples, and its series is the value that is expected.",
        .fallback_doc = "none"},
       to(&ExpectSpec::like)},
      {{.name = "scale",
        .kind = Kind::number,
        .range = within(-1e30, 1e30),
        .fallback = value_of(1.0),
        .needs = "like",
        .doc = "The series of the other scene times this."},
       to(&ExpectSpec::scale)},
      {{.name = "within",
        .kind = Kind::number,
        .range = within(0, 1e30),
        .needs = "series",
        .doc = "How far off is near enough: a share of |equals| (in the SI unit where `equals` is "
               "0), or of the largest value of the other scene's series. Required with `equals` "
               "and `like`.",
        .fallback_doc = "none"},
       to(&ExpectSpec::within)},
  };
}

std::vector<Key<ExpectSpec>> outcome_keys() {
  return {
      {{.name = "outcome",
        .kind = Kind::choice,
        .choices = {{"stops", "a health check or a limit stops the run"}},
        .doc = "How the run ends.",
        .fallback_doc = "it reaches its end"},
       [](ExpectSpec& spec, const Decoded&) { spec.stops = true; }},
      {{.name = "message",
        .kind = Kind::text,
        .needs = "outcome",
        .doc = "Regular expression (RE2's syntax: no look-around, no back-references) that must be "
               "found "
               "in what the stopped run says.",
        .fallback_doc = "required with `outcome`"},
       to(&ExpectSpec::message)},
  };
}

}  // namespace

const TableDeclaration<ExpectSpec>& expect() {
  static const TableDeclaration<ExpectSpec> declaration = [] {
    TableDeclaration<ExpectSpec> made{
        {"expect", true, "",
         "Something that must hold of the run: `pulvis run` says whether it does, and exits with "
         "code 3 if not. Either a series that keeps bounds, or an outcome.",
         every_family},
        series_keys()};
    for (const auto& more : {bound_keys(), outcome_keys()})
      made.keys.insert(made.keys.end(), more.begin(), more.end());
    return made;
  }();
  return declaration;
}

}  // namespace pulvis::schema
