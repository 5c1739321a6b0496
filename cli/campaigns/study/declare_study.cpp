#include "cli/campaigns/study/declare_study.hpp"

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

// Keys of tables that take one number from every run; `when` has these choices.
template <class Spec>
std::vector<Key<Spec>> quantity_keys(const std::vector<Choice>& when) {
  return {
      {{.name = "series",
        .kind = Kind::text,
        .required = true,
        .doc = "A series of `history.csv`, a derived series, or a value of the run (see "
               "above)."},
       text_to(&StudyQuantity::series)},
      {{.name = "at",
        .kind = Kind::bound,
        .doc = "Value of the series where `against` first reaches this value, by linear "
               "interpolation.",
        .fallback_doc = "given by `when`"},
       bound_to(&StudyQuantity::at)},
      {{.name = "when",
        .kind = Kind::choice,
        .choices = when,
        .doc = "Which value of the series is taken.",
        .fallback_doc = "`\"end\"`, unless `at` is given"},
       word_to(&StudyQuantity::when)},
      {{.name = "against",
        .kind = Kind::text,
        .doc = "Series to which `at`, `from` and `until` refer.",
        .fallback_doc = "`\"relative_density\"`"},
       text_to(&StudyQuantity::against)},
      {{.name = "from",
        .kind = Kind::bound,
        .doc = "Samples before `against` first reaches this value are ignored.",
        .fallback_doc = "all samples are used"},
       bound_to(&StudyQuantity::from)},
      {{.name = "until",
        .kind = Kind::bound,
        .doc = "Samples after `against` first reaches this value are ignored.",
        .fallback_doc = "all samples are used"},
       bound_to(&StudyQuantity::until)},
  };
}

std::vector<Choice> samples() {
  return {{"end", "the last sample"},
          {"max", "the largest sample"},
          {"min", "the smallest sample"},
          {"mean", "the mean of the samples"}};
}

std::vector<Choice> samples_and_roughness() {
  std::vector<Choice> all = samples();
  all.push_back({"roughness",
                 "rms deviation from a moving straight line, fitted to a twentieth of the "
                 "samples around each one, as a fraction of the range (largest minus smallest): "
                 "0 for a smooth curve"});
  return all;
}

std::vector<Key<StudyFit>> strength_keys() {
  return {
      {{.name = "law",
        .kind = Kind::choice,
        .choices = words_of<StudyFit::Law>(
            {{"weibull",
              "P = 1 - exp(-(strength/scale)^modulus) fitted to the strengths of a "
              "variation, one per seed, by maximum likelihood"},
             {"ryshkewitch_duckworth",
              "strength = strength_0 exp(-k porosity), fitted to runs of different density"},
             {"power",
              "value = c key^exponent, fitted to runs that set `key` and agree in all other "
              "varied keys; the exponent is d ln(value)/d ln(key), the relative sensitivity"}}),
        .required = true,
        .doc = "Law to be fitted."},
       word_to(&StudyFit::law)},
      {{.name = "area",
        .kind = Kind::quantity,
        .unit = "m^2",
        .range = above(0, 1e6),
        .doc = "Area by which the force `series` is divided to give the strength.",
        .fallback_doc = "none: the value itself is the strength"},
       to(&StudyFit::area)},
      {{.name = "disc",
        .kind = Kind::text,
        .doc = "Name of a class of discs, one of which is crushed between two platens: the "
               "strength is 2 F/(pi D t) with its diameter D and the scene's thickness t.",
        .fallback_doc = "see `area`"},
       to(&StudyFit::disc)},
      {{.name = "density",
        .kind = Kind::text,
        .only_for = "ryshkewitch_duckworth",
        .doc = "Series of the relative density. Its maximum in a run is the density of the "
               "compact; the porosity is 1 minus this.",
        .fallback_doc = "`\"relative_density\"`"},
       to(&StudyFit::density)},
      {{.name = "by",
        .kind = Kind::texts,
        .only_for = "ryshkewitch_duckworth",
        .doc = "Keys varied in the study: runs with the same values of these keys are fitted "
               "together.",
        .fallback_doc = "none: all runs are fitted together"},
       texts_to(&StudyFit::by)},
      {{.name = "key",
        .kind = Kind::text,
        .required = true,
        .only_for = "power",
        .doc = "Key of the scene varied in the study; its values are numbers or quantities "
               "above 0."},
       to(&StudyFit::key)},
      {{.name = "title",
        .kind = Kind::text,
        .doc = "Title of the chart.",
        .fallback_doc = "built from `law` and `series`"},
       to(&StudyFit::title)},
  };
}

std::vector<Key<StudyExpect>> across_keys() {
  return {
      {{.name = "order",
        .kind = Kind::texts,
        .doc = "Variations whose values increase or decrease in this order.",
        .fallback_doc = "none"},
       texts_to(&StudyExpect::order)},
      {{.name = "trend",
        .kind = Kind::choice,
        .choices = words_of<StudyExpect::Trend>(
            {{"increasing", "each value is larger than the one before"},
             {"decreasing", "each value is smaller than the one before"}}),
        .needs = "order",
        .doc = "Required trend.",
        .fallback_doc = "required with `order`"},
       word_to(&StudyExpect::trend)},
      {{.name = "by",
        .kind = Kind::number,
        .range = within(0, 1e6),
        .needs = "order",
        .doc = "Minimum step between neighbours, as a fraction of the larger of the two.",
        .fallback_doc = "0"},
       to(&StudyExpect::by)},
      {{.name = "ratio",
        .kind = Kind::texts,
        .doc = "Two variations: the ratio of the first value to the second must lie within "
               "the bounds.",
        .fallback_doc = "none"},
       texts_to(&StudyExpect::ratio)},
      {{.name = "effect",
        .kind = Kind::texts,
        .doc = "Two variations whose values must differ by more, in either direction, than "
               "those of the two in `exceeds`.",
        .fallback_doc = "none"},
       texts_to(&StudyExpect::effect)},
      {{.name = "exceeds",
        .kind = Kind::texts,
        .needs = "effect",
        .doc = "The two variations with which `effect` is compared.",
        .fallback_doc = "required with `effect`"},
       texts_to(&StudyExpect::exceeds)},
      {{.name = "factor",
        .kind = Kind::number,
        .range = above(0, 1e6),
        .needs = "effect",
        .doc = "Minimum ratio of the two differences.",
        .fallback_doc = "1"},
       to(&StudyExpect::factor)},
      {{.name = "of",
        .kind = Kind::text,
        .doc = "One variation, whose value must lie within the bounds.",
        .fallback_doc = "none"},
       to(&StudyExpect::of)},
  };
}

// `of` is the quantity that the bounds apply to; only_for as in KeyInfo.
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
        .fallback_doc = "no lower bound"},
       bound_to(&StudyBounds::above)},
      {{.name = "below",
        .kind = kind,
        .range = range,
        .only_for = only_for,
        .doc = largest,
        .fallback_doc = "no upper bound"},
       bound_to(&StudyBounds::below)},
      {{.name = "equals",
        .kind = kind,
        .range = range,
        .only_for = only_for,
        .doc = "Expected value of " + of + ".",
        .fallback_doc = "none"},
       bound_to(&StudyBounds::equals)},
      {{.name = "within",
        .kind = Kind::number,
        .range = within(0, 1e30),
        .only_for = only_for,
        .needs = "equals",
        .doc = "Tolerance: a fraction of |equals|, or an absolute value in SI units if "
               "`equals` is 0.",
        .fallback_doc = "required with `equals`"},
       [](Spec& spec, const Decoded& value) { spec.within = value.number; }},
  };
}

// A table whose keys are keys of the scene.
TableView free_keys(const char* path, const char* doc) { return {{path, false, "", doc}, {}}; }

}  // namespace

const TableDeclaration<StudySpec>& study_top_level() {
  static const TableDeclaration<StudySpec> declaration{
      {"", false, "", "Keys at the top level of the file."},
      {{{.name = "title",
         .kind = Kind::text,
         .doc = "Title of the report.",
         .fallback_doc = "the name of the file"},
        to(&StudySpec::title)},
       {{.name = "scene",
         .kind = Kind::scene,
         .doc = "Scene to be varied, as a path relative to the folder of this file.",
         .fallback_doc = "none: every variation names its own"},
        to(&StudySpec::scene)},
       {{.name = "seeds",
         .kind = Kind::integers,
         .range = within(0, 1e15),
         .doc = "Values of the scene's `seed`. Every variation is run once with each of them; "
                "the report shows the mean, the standard deviation and the range.",
         .fallback_doc = "one run with the scene's own seed"},
        [](StudySpec& spec, const Decoded& value) { spec.seeds = value.integers; }},
       {{.name = "overrides",
         .kind = Kind::texts,
         .doc = "Changes to the scene of every run, written as for `--set`. They are applied "
                "after all others except those on the command line. In the settings saved with "
                "the results, this key records the `--set` options.",
         .fallback_doc = "none"},
        [](StudySpec& spec, const Decoded& value) { spec.overrides = value.texts; }}}};
  return declaration;
}

const TableDeclaration<VariationSpec>& study_variation() {
  static const TableDeclaration<VariationSpec> declaration{
      {"variation", true, "",
       "A single variation. If there is also a `[grid]`, each of these is run with "
       "every point of the grid and named `name,key=value,...`."},
      {{{.name = "name",
         .kind = Kind::name,
         .required = true,
         .doc = "Name used in the report, in expectations and for the folder. It must not be "
                "the name of a file of the study or begin with '.'."},
        to(&VariationSpec::name)},
       {{.name = "scene",
         .kind = Kind::scene,
         .doc = "Scene of the variation, as a path relative to the folder of this file.",
         .fallback_doc = "the study's `scene`"},
        to(&VariationSpec::scene)}}};
  return declaration;
}

const TableDeclaration<StudyCurve>& study_curve() {
  static const TableDeclaration<StudyCurve> declaration{
      {"curve", true, "",
       "A chart of the report with one curve per variation. By default: axial stress "
       "divided by yield stress and its transmission versus relative density, and the "
       "force on the top punch versus its travel, where the scenes provide them."},
      {{{.name = "y", .kind = Kind::text, .required = true, .doc = "Series on the y axis."},
        to(&StudyCurve::y)},
       {{.name = "x",
         .kind = Kind::text,
         .doc = "Series on the x axis, or `time`.",
         .fallback_doc = "`\"relative_density\"`"},
        to(&StudyCurve::x)},
       {{.name = "title",
         .kind = Kind::text,
         .doc = "Title of the chart.",
         .fallback_doc = "built from `x` and `y`"},
        to(&StudyCurve::title)}}};
  return declaration;
}

const TableDeclaration<StudyExpect>& study_expect() {
  static const TableDeclaration<StudyExpect> declaration = [] {
    TableDeclaration<StudyExpect> made{
        {"expect", true, "",
         "A check across the runs: `pulvis study` reports whether it is met, and exits "
         "with code 3 if it is not. One number is taken from each run (`series` with "
         "`at` or `when`) and averaged over seeds. Variations are compared by exactly "
         "one of `order`, `ratio`, `effect` and `of`."},
        quantity_keys<StudyExpect>(samples_and_roughness())};
    const auto bounds = bound_keys<StudyExpect>(
        "`of` or `ratio`", "Lower bound of `of` or `ratio`; a ratio is dimensionless.",
        "Upper bound of `of` or `ratio`.", Kind::bound, {});
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
         "A law fitted across the runs. Its parameters and the fitted data are in the "
         "report, in `fits.csv` and in `strengths.csv`, for power laws in "
         "`sensitivities.csv`. One number is taken from each run (`series` with `at` or "
         "`when`): a strength or, for a power law, any value. A Weibull plot shows the "
         "probability of failure P = (i - 0.5)/N of the i-th strength of N; modulus and "
         "scale have 90% confidence limits. For discs of several sizes, weakest-link "
         "theory predicts scale ~ D^(-2/modulus); the report also gives the exponent "
         "found."},
        strength_keys()};
    const auto more = quantity_keys<StudyFit>(samples());
    made.keys.insert(made.keys.begin() + 1, more.begin(), more.end());
    const auto bounds = bound_keys<StudyFit>("the exponent", "Lower bound of the exponent.",
                                             "Upper bound of the exponent.", Kind::number, "power");
    made.keys.insert(made.keys.end(), bounds.begin(), bounds.end());
    return made;
  }();
  return declaration;
}

const Language& study_language() {
  static const Language language{
      view_of(study_top_level()),
      free_keys("set",
                "Keys of the scene that are changed in all variations, as by `--set`: "
                "`output.frames = 20`."),
      free_keys("grid",
                "Keys of the scene, each with a list of values; every combination is a "
                "variation: `contact.friction = [0.001, 0.1, 0.3]` gives `friction=0.001`, "
                "`friction=0.1` and `friction=0.3`. A variation is named by the last part of "
                "each key, or by the whole key if two end in the same part. Elements of "
                "repeated tables are addressed as in `--set`, in quotes: "
                "`\"stage.press.duration\" = [\"1 ms\", \"2 ms\"]`."),
      view_of(study_variation()),
      free_keys("variation.set", "Keys of the scene changed in this variation."),
      view_of(study_curve()),
      view_of(study_fit()),
      view_of(study_expect())};
  return language;
}

}  // namespace pulvis::schema
