#include "scenes/study/declare_study.hpp"

#include "scenes/keys/declare.hpp"

namespace pulvis::schema {
namespace {

using Bound = StudyQuantity::Bound;

auto bound_to(std::optional<Bound> StudyBounds::*member) {
  return [member](auto& spec, const Decoded& value) { spec.*member = {value.number, value.text}; };
}
auto bound_to(std::optional<Bound> StudyQuantity::*member) {
  return [member](auto& spec, const Decoded& value) { spec.*member = {value.number, value.text}; };
}
template <class Spec>
auto texts_to(std::vector<std::string> Spec::*member) {
  return [member](Spec& spec, const Decoded& value) { spec.*member = value.texts; };
}
auto text_to(std::string StudyQuantity::*member) {
  return [member](auto& spec, const Decoded& value) { spec.*member = value.text; };
}

// Of what takes one number of every run; `when` has these words.
template <class Spec>
std::vector<Key<Spec>> quantity_keys(const std::vector<Choice>& when) {
  return {
      {{.name = "series",
        .kind = Kind::text,
        .required = true,
        .doc = "A series of `history.csv`, one made from it, or a value of the run (see above)."},
       text_to(&StudyQuantity::series)},
      {{.name = "at",
        .kind = Kind::bound,
        .doc = "Its value where `against` first passes this one, by linear interpolation.",
        .fallback_doc = "what `when` says"},
       bound_to(&StudyQuantity::at)},
      {{.name = "when",
        .kind = Kind::choice,
        .choices = when,
        .doc = "What of the series is meant.",
        .fallback_doc = "`\"end\"`, or what `at` says"},
       [](Spec& spec, const Decoded& value) {
         spec.when = static_cast<StudyQuantity::When>(value.index);
       }},
      {{.name = "against",
        .kind = Kind::text,
        .doc = "The series that `at`, `from` and `until` are values of.",
        .fallback_doc = "`\"relative_density\"`"},
       text_to(&StudyQuantity::against)},
      {{.name = "from",
        .kind = Kind::bound,
        .doc = "Samples before `against` first reaches this do not count.",
        .fallback_doc = "all count"},
       bound_to(&StudyQuantity::from)},
      {{.name = "until",
        .kind = Kind::bound,
        .doc = "Samples from where `against` first passes this on do not count.",
        .fallback_doc = "all count"},
       bound_to(&StudyQuantity::until)},
  };
}

std::vector<Choice> samples() {
  return {{"end", "its last sample"},
          {"max", "its largest"},
          {"min", "its smallest"},
          {"mean", "the mean of its samples"}};
}

std::vector<Choice> samples_and_roughness() {
  std::vector<Choice> all = samples();
  all.push_back({"roughness",
                 "rms distance from a straight line through the twentieth of the samples "
                 "around each, as a share of largest less smallest: 0 of a smooth curve"});
  return all;
}

std::vector<Key<StudyFit>> strength_keys() {
  return {
      {{.name = "law",
        .kind = Kind::choice,
        .choices = {{"weibull",
                     "P = 1 - exp(-(strength/scale)^modulus) of the strengths of a variation, one "
                     "a seed, by maximum likelihood"},
                    {"ryshkewitch_duckworth",
                     "strength = strength_0 exp(-k porosity) over the runs of different density"},
                    {"power",
                     "value = c key^exponent over the runs that set `key`, those alike in all else "
                     "that varies; the exponent is d ln(value)/d ln(key), the relative "
                     "sensitivity"}},
        .required = true,
        .doc = "The law that is fitted."},
       [](StudyFit& fit, const Decoded& value) {
         fit.law = static_cast<StudyFit::Law>(value.index);
       }},
      {{.name = "area",
        .kind = Kind::quantity,
        .unit = "m^2",
        .range = above(0, 1e6),
        .doc = "The strength is the force that `series` has over this.",
        .fallback_doc = "the strength is the number itself"},
       to(&StudyFit::area)},
      {{.name = "disc",
        .kind = Kind::text,
        .doc = "Name of a class of discs, one of which is crushed between two platens: the "
               "strength is 2 F/(pi D t) of its diameter D and the scene's thickness t.",
        .fallback_doc = "as `area` says"},
       to(&StudyFit::disc)},
      {{.name = "density",
        .kind = Kind::text,
        .only_for = "ryshkewitch_duckworth",
        .doc = "The series of the relative density, whose largest value in a run is that of its "
               "compact; the porosity is what it leaves to 1.",
        .fallback_doc = "`\"relative_density\"`"},
       to(&StudyFit::density)},
      {{.name = "by",
        .kind = Kind::texts,
        .only_for = "ryshkewitch_duckworth",
        .doc = "Keys that the study varies: runs in which they are alike are fitted together.",
        .fallback_doc = "all runs are"},
       texts_to(&StudyFit::by)},
      {{.name = "key",
        .kind = Kind::text,
        .required = true,
        .only_for = "power",
        .doc = "The key of the scene, of numbers or quantities above 0, that the study varies."},
       to(&StudyFit::key)},
      {{.name = "title",
        .kind = Kind::text,
        .doc = "Above the chart.",
        .fallback_doc = "made of `law` and `series`"},
       to(&StudyFit::title)},
  };
}

std::vector<Key<StudyExpect>> across_keys() {
  return {
      {{.name = "order",
        .kind = Kind::texts,
        .doc = "Variations whose values rise or fall in this order.",
        .fallback_doc = "none"},
       texts_to(&StudyExpect::order)},
      {{.name = "trend",
        .kind = Kind::choice,
        .choices = {{"increasing", "each value is larger than the one before"},
                    {"decreasing", "each is smaller"}},
        .needs = "order",
        .doc = "Which direction.",
        .fallback_doc = "required with `order`"},
       [](StudyExpect& spec, const Decoded& value) {
         spec.trend = static_cast<StudyExpect::Trend>(value.index);
       }},
      {{.name = "by",
        .kind = Kind::number,
        .range = within(0, 1e6),
        .needs = "order",
        .doc = "Smallest step between neighbours, as a share of the larger of the two.",
        .fallback_doc = "0"},
       to(&StudyExpect::by)},
      {{.name = "ratio",
        .kind = Kind::texts,
        .doc = "Two variations: the value of the first over that of the second keeps the bounds.",
        .fallback_doc = "none"},
       texts_to(&StudyExpect::ratio)},
      {{.name = "effect",
        .kind = Kind::texts,
        .doc = "Two variations between which the value changes by more (either way) than between "
               "the two of `exceeds`.",
        .fallback_doc = "none"},
       texts_to(&StudyExpect::effect)},
      {{.name = "exceeds",
        .kind = Kind::texts,
        .needs = "effect",
        .doc = "The two variations that `effect` is compared with.",
        .fallback_doc = "required with `effect`"},
       texts_to(&StudyExpect::exceeds)},
      {{.name = "factor",
        .kind = Kind::number,
        .range = above(0, 1e6),
        .needs = "effect",
        .doc = "How many times as large it must at least be.",
        .fallback_doc = "1"},
       to(&StudyExpect::factor)},
      {{.name = "of",
        .kind = Kind::text,
        .doc = "One variation, whose value keeps the bounds.",
        .fallback_doc = "none"},
       to(&StudyExpect::of)},
  };
}

// `of` is what the bounds are of; only_for as in KeyInfo.
template <class Spec>
std::vector<Key<Spec>> bound_keys(const std::string& of, const std::string& smallest,
                                  const std::string& largest, Kind kind, const Words& only_for) {
  const Range range = kind == Kind::number ? within(-1e6, 1e6) : Range{};
  return {
      {{.name = "above",
        .kind = kind,
        .range = range,
        .only_for = only_for,
        .doc = smallest,
        .fallback_doc = "no such bound"},
       bound_to(&StudyBounds::above)},
      {{.name = "below",
        .kind = kind,
        .range = range,
        .only_for = only_for,
        .doc = largest,
        .fallback_doc = "no such bound"},
       bound_to(&StudyBounds::below)},
      {{.name = "equals",
        .kind = kind,
        .range = range,
        .only_for = only_for,
        .doc = "The value that is expected of " + of + ".",
        .fallback_doc = "none"},
       bound_to(&StudyBounds::equals)},
      {{.name = "within",
        .kind = Kind::number,
        .range = within(0, 1e30),
        .only_for = only_for,
        .needs = "equals",
        .doc = "How far off is near enough: a share of |equals|, in the SI unit where that is 0.",
        .fallback_doc = "required with `equals`"},
       [](Spec& spec, const Decoded& value) { spec.within = value.number; }},
  };
}

// A table whose keys are those of the scene.
TableView free_keys(const char* path, const char* doc) { return {{path, false, "", doc}, {}}; }

}  // namespace

const TableDeclaration<StudySpec>& study_top_level() {
  static const TableDeclaration<StudySpec> declaration{
      {"", false, "", "Keys before the first table."},
      {{{.name = "title",
         .kind = Kind::text,
         .doc = "What the report is headed with.",
         .fallback_doc = "the name of the file"},
        to(&StudySpec::title)},
       {{.name = "scene",
         .kind = Kind::scene,
         .doc = "The scene that is varied, as a path from this file's folder.",
         .fallback_doc = "none: every variation names its own"},
        to(&StudySpec::scene)},
       {{.name = "seeds",
         .kind = Kind::integers,
         .range = within(0, 1e15),
         .doc = "Every variation is run once with each of these as the scene's `seed`; the report "
                "shows their mean, standard deviation and the band from smallest to largest.",
         .fallback_doc = "the scene's own, once"},
        [](StudySpec& spec, const Decoded& value) { spec.seeds = value.integers; }},
       {{.name = "overrides",
         .kind = Kind::texts,
         .doc = "Changes of every run's scene as `--set` makes them, applied after all others but "
                "those of the "
                "command line. The settings that are saved beside results keep here what `--set` "
                "gave.",
         .fallback_doc = "none"},
        [](StudySpec& spec, const Decoded& value) { spec.overrides = value.texts; }}}};
  return declaration;
}

const TableDeclaration<VariationSpec>& study_variation() {
  static const TableDeclaration<VariationSpec> declaration{
      {"variation", true, "",
       "One variation of the list. Where there is a `[grid]` too, each of the list is run with "
       "every point of it, and is called `name,key=value,...`."},
      {{{.name = "name",
         .kind = Kind::name,
         .required = true,
         .doc =
             "What it is called in the report, in expectations and as a folder: no name of a file "
             "of the study, and without '.' at the beginning."},
        to(&VariationSpec::name)},
       {{.name = "scene",
         .kind = Kind::scene,
         .doc = "Its scene, as a path from this file's folder.",
         .fallback_doc = "the study's `scene`"},
        to(&VariationSpec::scene)}}};
  return declaration;
}

const TableDeclaration<StudyCurve>& study_curve() {
  static const TableDeclaration<StudyCurve> declaration{
      {"curve", true, "",
       "A chart of the report with one curve a variation. Without any: axial stress over yield "
       "stress and its transmission against relative density, and the top punch's force against "
       "its "
       "travel, as far as the scenes have them."},
      {{{.name = "y", .kind = Kind::text, .required = true, .doc = "The series that is drawn."},
        to(&StudyCurve::y)},
       {{.name = "x",
         .kind = Kind::text,
         .doc = "The series it is drawn against, or `time`.",
         .fallback_doc = "`\"relative_density\"`"},
        to(&StudyCurve::x)},
       {{.name = "title",
         .kind = Kind::text,
         .doc = "Above the chart.",
         .fallback_doc = "made of `x` and `y`"},
        to(&StudyCurve::title)}}};
  return declaration;
}

const TableDeclaration<StudyExpect>& study_expect() {
  static const TableDeclaration<StudyExpect> declaration = [] {
    TableDeclaration<StudyExpect> made{
        {"expect", true, "",
         "Something that must hold across the runs: `pulvis study` says whether it does, and exits "
         "with code 3 if not. One number is taken of each run (`series` with `at` or `when`), over "
         "seeds their mean, and variations are compared by exactly one of `order`, `ratio`, "
         "`effect` or `of`."},
        quantity_keys<StudyExpect>(samples_and_roughness())};
    const auto bounds = bound_keys<StudyExpect>(
        "`of` or `ratio`", "Smallest value of `of` or `ratio` that will do; a ratio is a number.",
        "Largest value of `of` or `ratio` that will do.", Kind::bound, {});
    for (const auto& more : {across_keys(), bounds})
      made.keys.insert(made.keys.end(), more.begin(), more.end());
    return made;
  }();
  return declaration;
}

const TableDeclaration<StudyFit>& study_fit() {
  static const TableDeclaration<StudyFit> declaration = [] {
    TableDeclaration<StudyFit> made{
        {"fit", true, "law",
         "A law fitted across the runs: its parameters and what they were fitted to are in the "
         "report, in `fits.csv` and in `strengths.csv`, of power laws in `sensitivities.csv`. One "
         "number is taken of each run (`series` with `at` or `when`), a strength or, for a power "
         "law, any. A Weibull plot has the probability of failure "
         "P = (i - 0.5)/N of the i-th strength of N; modulus and scale come with limits of 90% "
         "confidence. Of discs of several sizes the weakest link says scale ~ D^(-2/modulus): the "
         "report has the exponent that was found beside it."},
        strength_keys()};
    const auto more = quantity_keys<StudyFit>(samples());
    made.keys.insert(made.keys.begin() + 1, more.begin(), more.end());
    const auto bounds =
        bound_keys<StudyFit>("the exponent", "Smallest exponent that will do.",
                             "Largest exponent that will do.", Kind::number, "power");
    made.keys.insert(made.keys.end(), bounds.begin(), bounds.end());
    return made;
  }();
  return declaration;
}

const Language& study_language() {
  static const Language language{
      view_of(study_top_level()),
      free_keys("set",
                "Keys of the scene that all variations change, as `--set` does: "
                "`output.frames = 20`."),
      free_keys(
          "grid",
          "Keys of the scene, each with a list of values; every combination is a variation: "
          "`contact.friction = [0.001, 0.1, 0.3]` makes `friction=0.001`, `friction=0.1` and "
          "`friction=0.3`. A variation is named by the last word of each key, or by the whole "
          "key where two end in the same word. Elements of repeated tables are reached as in "
          "`--set`, in quotes: `\"stage.press.duration\" = [\"1 ms\", \"2 ms\"]`."),
      view_of(study_variation()),
      free_keys("variation.set", "Keys of the scene that this variation changes."),
      view_of(study_curve()),
      view_of(study_fit()),
      view_of(study_expect())};
  return language;
}

}  // namespace pulvis::schema
