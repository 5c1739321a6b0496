#include "cli/campaigns/fit/declare_fit.hpp"

#include "scenes/keys/declare.hpp"

namespace pulvis::schema {

const TableDeclaration<PlateFitSpec>& fit_top_level() {
  static const TableDeclaration<PlateFitSpec> declaration{
      {"", false, "", "Keys at the top level of the file."},
      {{{.name = "title",
         .kind = Kind::text,
         .doc = "Title of the report.",
         .fallback_doc = "the name of the file"},
        to(&PlateFitSpec::title)},
       {{.name = "scene",
         .kind = Kind::scene,
         .required = true,
         .doc = "Scene in which a target slides under a compact, as a path relative to the "
                "folder of this file."},
        to(&PlateFitSpec::scene)},
       {{.name = "overrides",
         .kind = Kind::texts,
         .doc = "Changes to the scene, written as for `--set`. They are applied after all "
                "others except those on the command line. In the settings saved with the "
                "results, this key records the `--set` options.",
         .fallback_doc = "none"},
        [](PlateFitSpec& spec, const Decoded& value) { spec.overrides = value.texts; }}}};
  return declaration;
}

namespace {

Key<SoughtKey> value_key(const char* name, double SoughtKey::*member, const char* doc) {
  return {{.name = name,
           .kind = Kind::number,
           .range = within(-1e12, 1e12),
           .required = true,
           .doc = doc},
          to(member)};
}

std::vector<Key<SoughtKey>> parameter_keys() {
  return {{{.name = "key",
            .kind = Kind::text,
            .required = true,
            .doc = "Key of the scene, written as for `--set`: \"friction[0].coefficient\"."},
           to(&SoughtKey::key)},
          {{.name = "name",
            .kind = Kind::name,
            .doc = "Name used in tables and for folders.",
            .fallback_doc = "the last part of the key"},
           to(&SoughtKey::name)},
          {{.name = "unit",
            .kind = Kind::text,
            .doc = "Unit of the values below if the key is a quantity: \"mm\".",
            .fallback_doc = "none"},
           to(&SoughtKey::unit)},
          value_key("start", &SoughtKey::start, "Value used in the first run."),
          value_key("low", &SoughtKey::low, "Lower bound of the values tried."),
          value_key("high", &SoughtKey::high, "Upper bound of the values tried."),
          {{.name = "step",
            .kind = Kind::number,
            .range = above(0, 1e12),
            .required = true,
            .doc = "Change of the value used to compute the sensitivity of the curve to it. It "
                   "must be large enough for the effect to exceed the fluctuations of the "
                   "simulation."},
           to(&SoughtKey::step)}};
}

}  // namespace

const TableDeclaration<SoughtKey>& fit_parameter() {
  static const TableDeclaration<SoughtKey> declaration{
      {"parameter", true, "", "A key to be fitted; one, two or three of them."}, parameter_keys()};
  return declaration;
}

namespace {

std::vector<Key<PlateMeasured>> record_keys() {
  return {
      {{.name = "record",
        .kind = Kind::file,
        .doc = "Measured friction versus distance (CSV), as written by `pulvis reduce` to "
               "`reduced-<run>.csv`; a path relative to the folder of this file.",
        .fallback_doc = "none: the coefficients below"},
       to(&PlateMeasured::record)},
      {{.name = "distance",
        .kind = Kind::text,
        .fallback = value_of("distance"),
        .doc = "Name of the distance column. A return stroke is refused."},
       to(&PlateMeasured::distance)},
      {{.name = "friction",
        .kind = Kind::text,
        .fallback = value_of("friction"),
        .doc = "Name of the coefficient column; \"mean\" in `curves.csv`. Rows without a value in "
               "it are left out."},
       to(&PlateMeasured::friction)},
      {{.name = "from",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(0, 10),
        .fallback = value_of("0 mm"),
        .doc = "Simulated distance where the comparison begins. It should lie beyond the "
               "elastic take-up, which differs between test and simulation."},
       to(&PlateMeasured::from)},
      {{.name = "until",
        .kind = Kind::quantity,
        .unit = "m",
        .range = above(0, 10),
        .doc = "Simulated distance where the comparison ends.",
        .fallback_doc = "the end of the record or of the simulation"},
       to(&PlateMeasured::until)},
      {{.name = "error",
        .kind = Kind::number,
        .range = above(0, 1),
        .doc = "Standard uncertainty of each measured coefficient. If the record scatters "
               "more than this about the simulation, the scatter is used.",
        .fallback_doc = "the scatter about the simulation"},
       to(&PlateMeasured::error)},
      {{.name = "particle_diameter",
        .kind = Kind::quantity,
        .unit = "m",
        .range = above(0, 1),
        .doc = "Mean particle diameter of the measured powder, used to express the sliding "
               "distance in diameters.",
        .fallback_doc = "unknown"},
       to(&PlateMeasured::particle_diameter)},
      {{.name = "compare",
        .kind = Kind::choice,
        .choices = words_of<PlateMeasured::Compare>(
            {{"distance", "at equal distances; appropriate for wear and slip of the surfaces"},
             {"diameters",
              "at equal distances divided by particle diameter; appropriate for particle "
              "rearrangement; needs `particle_diameter`"}}),
        .fallback = value_of("distance"),
        .doc = "How the two curves are aligned."},
       word_to(&PlateMeasured::compare)}};
}

Key<PlateMeasured> coefficient_key(const char* name, std::optional<double> PlateMeasured::*member,
                                   const char* needs, const char* doc) {
  return {{.name = name,
           .kind = Kind::number,
           .range = above(0, 10),
           .needs = needs,
           .doc = doc,
           .fallback_doc = "none"},
          to(member)};
}

}  // namespace

const TableDeclaration<PlateMeasured>& fit_measured() {
  static const TableDeclaration<PlateMeasured> declaration = [] {
    TableDeclaration<PlateMeasured> made{
        {"measured", false, "", "Measured data: a record or coefficients."}, record_keys()};
    made.keys.push_back(coefficient_key("static", &PlateMeasured::peak, "static_error",
                                        "Measured static coefficient, instead of a record."));
    made.keys.push_back(coefficient_key("static_error", &PlateMeasured::peak_error, "static",
                                        "Standard uncertainty of the static coefficient."));
    made.keys.push_back(coefficient_key("dynamic", &PlateMeasured::dynamic, "dynamic_error",
                                        "Measured dynamic coefficient, instead of a record."));
    made.keys.push_back(coefficient_key("dynamic_error", &PlateMeasured::dynamic_error, "dynamic",
                                        "Standard uncertainty of the dynamic coefficient."));
    return made;
  }();
  return declaration;
}

const TableDeclaration<PlateFitSpec>& fit_fit() {
  static const TableDeclaration<PlateFitSpec> declaration{
      {"fit", false, "", "Search settings."},
      {{{.name = "target",
         .kind = Kind::name,
         .fallback = value_of("target"),
         .doc = "Tool that slides under the compact."},
        to(&PlateFitSpec::target)},
       {{.name = "static_within",
         .kind = Kind::quantity,
         .unit = "m",
         .range = above(0, 10),
         .fallback = value_of("3 mm"),
         .doc = "The simulated static coefficient is the largest value within this distance."},
        to(&PlateFitSpec::static_within)},
       {{.name = "dynamic_from",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(0, 10),
         .fallback = value_of("10 mm"),
         .doc = "The simulated dynamic coefficient is the mean beyond this distance."},
        to(&PlateFitSpec::dynamic_from)},
       {{.name = "tolerance",
         .kind = Kind::number,
         .range = above(0, 1),
         .fallback = value_of(0.01),
         .doc = "The search has converged when the next change of every parameter is below "
                "this fraction of its step."},
        to(&PlateFitSpec::tolerance)},
       {{.name = "confidence",
         .kind = Kind::number,
         .range = between(0, 1),
         .fallback = value_of(0.95),
         .doc = "Confidence level of the intervals."},
        to(&PlateFitSpec::confidence)},
       {{.name = "max_rounds",
         .formerly = "most_rounds",
         .kind = Kind::integer,
         .range = within(1, 100),
         .fallback = value_of(8),
         .doc = "Maximum number of rounds. Each round runs the scene once, plus once per "
                "parameter."},
        integer_to(&PlateFitSpec::max_rounds)}}};
  return declaration;
}

const Language& fit_language() {
  static const Language tables{view_of(fit_top_level()), view_of(fit_parameter()),
                               view_of(fit_measured()), view_of(fit_fit())};
  return tables;
}

}  // namespace pulvis::schema
