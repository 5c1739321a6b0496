#include "scenes/fit/declare_fit.hpp"

#include "scenes/keys/declare.hpp"

namespace pulvis::schema {

const TableDeclaration<PlateFitSpec>& fit_top_level() {
  static const TableDeclaration<PlateFitSpec> declaration{
      {"", false, "", "Keys before the first table."},
      {{{.name = "title",
         .kind = Kind::text,
         .doc = "What the report is headed with.",
         .fallback_doc = "the name of the file"},
        to(&PlateFitSpec::title)},
       {{.name = "scene",
         .kind = Kind::scene,
         .required = true,
         .doc = "A scene whose target slides under a compact, as a path from this file's folder."},
        to(&PlateFitSpec::scene)},
       {{.name = "overrides",
         .kind = Kind::texts,
         .doc = "Changes of the scene as `--set` makes them, applied after all others but those of "
                "the "
                "command line. The settings that are saved beside results keep here what `--set` "
                "gave.",
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
  return {
      {{.name = "key",
        .kind = Kind::text,
        .required = true,
        .doc = "A key of the scene as in --set: \"friction[0].coefficient\"."},
       to(&SoughtKey::key)},
      {{.name = "name",
        .kind = Kind::name,
        .doc = "What it is called in tables and folders.",
        .fallback_doc = "the key's last part"},
       to(&SoughtKey::name)},
      {{.name = "unit",
        .kind = Kind::text,
        .doc = "Unit of the values below, where the key is a quantity: \"mm\".",
        .fallback_doc = "none"},
       to(&SoughtKey::unit)},
      value_key("start", &SoughtKey::start, "Value of the first run."),
      value_key("low", &SoughtKey::low, "Smallest value that is tried."),
      value_key("high", &SoughtKey::high, "Largest one."),
      {{.name = "step",
        .kind = Kind::number,
        .range = above(0, 1e12),
        .required = true,
        .doc = "Change of the value by which the curve's dependence on it is found: large enough "
               "to show above the simulation's own fluctuation."},
       to(&SoughtKey::step)}};
}

}  // namespace

const TableDeclaration<SoughtKey>& fit_parameter() {
  static const TableDeclaration<SoughtKey> declaration{
      {"parameter", true, "", "A key that is sought; one, two or three of them."},
      parameter_keys()};
  return declaration;
}

namespace {

std::vector<Key<PlateMeasured>> record_keys() {
  return {
      {{.name = "record",
        .kind = Kind::file,
        .doc = "Measured friction against distance (CSV), as `pulvis reduce` leaves it in "
               "`reduced-<run>.csv`, as a path from this file's folder.",
        .fallback_doc = "none: the coefficients below"},
       to(&PlateMeasured::record)},
      {{.name = "distance",
        .kind = Kind::text,
        .fallback = value_of("distance"),
        .doc = "Name of its column with the distance."},
       to(&PlateMeasured::distance)},
      {{.name = "friction",
        .kind = Kind::text,
        .fallback = value_of("friction"),
        .doc = "Name of its column with the coefficient; \"mean\" in `curves.csv`."},
       to(&PlateMeasured::friction)},
      {{.name = "from",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(0, 10),
        .fallback = value_of("0 mm"),
        .doc = "Simulated distance where the comparison begins: behind the elastic take-up, which "
               "is that of other bodies."},
       to(&PlateMeasured::from)},
      {{.name = "until",
        .kind = Kind::quantity,
        .unit = "m",
        .range = above(0, 10),
        .doc = "Simulated distance where it ends.",
        .fallback_doc = "where record or simulation ends"},
       to(&PlateMeasured::until)},
      {{.name = "error",
        .kind = Kind::number,
        .range = above(0, 1),
        .doc = "Standard uncertainty of each measured coefficient. Where the record scatters more "
               "about the simulation, that counts.",
        .fallback_doc = "the scatter about the simulation"},
       to(&PlateMeasured::error)},
      {{.name = "particle_diameter",
        .kind = Kind::quantity,
        .unit = "m",
        .range = above(0, 1),
        .doc = "Mean particle diameter of the measured powder: it says how many diameters were "
               "slid.",
        .fallback_doc = "not known"},
       to(&PlateMeasured::particle_diameter)},
      {{.name = "compare",
        .kind = Kind::choice,
        .choices = {{"distance", "at equal distances, as wear and slip of the surfaces ask for"},
                    {"diameters",
                     "at equal distances over the particles' diameters, as their "
                     "rearrangement asks for; with `particle_diameter`"}},
        .fallback = value_of("distance"),
        .doc = "What the two curves have in common."},
       index_to(&PlateMeasured::compare)}};
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
        {"measured", false, "", "What was measured: a record, or coefficients."}, record_keys()};
    made.keys.push_back(coefficient_key("static", &PlateMeasured::peak, "static_error",
                                        "Static coefficient, instead of a record."));
    made.keys.push_back(coefficient_key("static_error", &PlateMeasured::peak_error, "static",
                                        "Its standard uncertainty."));
    made.keys.push_back(coefficient_key("dynamic", &PlateMeasured::dynamic, "dynamic_error",
                                        "Dynamic coefficient, instead of a record."));
    made.keys.push_back(coefficient_key("dynamic_error", &PlateMeasured::dynamic_error, "dynamic",
                                        "Its standard uncertainty."));
    return made;
  }();
  return declaration;
}

const TableDeclaration<PlateFitSpec>& fit_fit() {
  static const TableDeclaration<PlateFitSpec> declaration{
      {"fit", false, "", "How it is sought."},
      {{{.name = "target",
         .kind = Kind::name,
         .fallback = value_of("target"),
         .doc = "The tool that slides under the compact."},
        to(&PlateFitSpec::target)},
       {{.name = "static_within",
         .kind = Kind::quantity,
         .unit = "m",
         .range = above(0, 10),
         .fallback = value_of("3 mm"),
         .doc = "The simulated static coefficient is the largest one within this distance."},
        to(&PlateFitSpec::static_within)},
       {{.name = "dynamic_from",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(0, 10),
         .fallback = value_of("10 mm"),
         .doc = "The simulated dynamic coefficient is the mean from this distance on."},
        to(&PlateFitSpec::dynamic_from)},
       {{.name = "tolerance",
         .kind = Kind::number,
         .range = above(0, 1),
         .fallback = value_of(0.01),
         .doc = "It ends when the next move is below this share of every parameter's step."},
        to(&PlateFitSpec::tolerance)},
       {{.name = "confidence",
         .kind = Kind::number,
         .range = between(0, 1),
         .fallback = value_of(0.95),
         .doc = "Level of the intervals."},
        to(&PlateFitSpec::confidence)},
       {{.name = "max_rounds",
         .formerly = "most_rounds",
         .kind = Kind::integer,
         .range = within(1, 100),
         .fallback = value_of(8),
         .doc = "After so many rounds it gives up; each has one run and one for each parameter."},
        integer_to(&PlateFitSpec::max_rounds)}}};
  return declaration;
}

const Language& fit_language() {
  static const Language tables{view_of(fit_top_level()), view_of(fit_parameter()),
                               view_of(fit_measured()), view_of(fit_fit())};
  return tables;
}

}  // namespace pulvis::schema
