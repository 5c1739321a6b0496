// Declarations of reduce.toml: force curves, lever, crosstalk and lateral calibration of an AFM.
#include "cli/laboratory/volts/declare_volts.hpp"

#include <fmt/format.h>

#include "scenes/keys/declare.hpp"

namespace pulvis::volts {

using namespace schema;

namespace {

constexpr double largest_error = 0.3;  // -, for values that must not change sign

template <class Spec, class Member>
Key<Spec> error_key(const char* name, Member Spec::*member, const char* doc,
                    std::optional<double> fallback = 0.0) {
  Key<Spec> key{{.name = name, .kind = Kind::number, .range = within(0, largest_error), .doc = doc},
                to(member)};
  if (fallback)
    key.info.fallback = value_of(*fallback);
  else
    key.info.fallback_doc = "required where it is used";
  return key;
}

template <class Spec, class Member>
Key<Spec> share_key(const char* name, Member Spec::*member, double low, double high,
                    std::optional<double> fallback, const char* doc, const char* without = "") {
  Key<Spec> key{{.name = name,
                 .kind = Kind::number,
                 .range = within(low, high),
                 .doc = doc,
                 .fallback_doc = without},
                to(member)};
  if (fallback) key.info.fallback = value_of(*fallback);
  return key;
}

template <class Spec>
Key<Spec> quantity_key(const char* name, const char* unit, double high,
                       std::optional<double> Spec::*member, const char* doc, const char* without) {
  return {{.name = name,
           .kind = Kind::quantity,
           .unit = unit,
           .range = above(0, high),
           .doc = doc,
           .fallback_doc = without},
          to(member)};
}

}  // namespace

const TableDeclaration<AfmSpec>& declared_afm() {
  static const TableDeclaration<AfmSpec> declaration{
      {"afm", false, "",
       "From AFM voltages to the friction coefficient of a sample, instead of "
       "sliding-plate tests."},
      {{{.name = "loops",
         .kind = Kind::file,
         .doc = "Friction loops on the flat sample (CSV), as a path relative to the folder of "
                "this file.",
         .fallback_doc = "none: this evaluation is skipped"},
        to(&AfmSpec::loops)},
       {{.name = "lateral",
         .kind = Kind::choice,
         .choices = words_of<LateralMethod>(
             {{"wedge", "from the loops on slopes in `wedge.loops`"},
              {"test_probe",
               "from side contacts of a test probe (`[test_probe]`) and the lever's lateral "
               "stiffness (Cannara, Eglin & Carpick 2006)"}}),
         .fallback = value_of("wedge"),
         .doc = "Calibration of the lateral detector."},
        word_to(&AfmSpec::lateral)},
       {{.name = "level_error",
         .kind = Kind::quantity,
         .unit = "V",
         .range = within(0, 10),
         .fallback = value_of("0 V"),
         .doc = "Standard uncertainty of the free level to which the normal signals of the "
                "sample loops refer, common to all of them: it affects their loads, but not "
                "the slope of the line."},
        to(&AfmSpec::level_error)},
       {{.name = "draws",
         .kind = Kind::integer,
         .range = within(1000, 1000000),
         .fallback = value_of(20000),
         .doc = "Number of Monte Carlo draws over all inputs."},
        integer_to(&AfmSpec::draws)},
       {{.name = "seed",
         .kind = Kind::integer,
         .range = within(0, 1000000000),
         .fallback = value_of(1),
         .doc = "Seed of the random numbers; the same seed gives the same draws on every "
                "machine."},
        integer_to(&AfmSpec::seed)}}};
  return declaration;
}

const TableDeclaration<ForceCurvesSpec>& declared_force_curves() {
  static const TableDeclaration<ForceCurvesSpec> declaration{
      {"force_curves", false, "", "Force curves: piezo displacement versus detector voltage."},
      {{{.name = "hard",
         .kind = Kind::file,
         .doc = "Curves on a hard surface (CSV): their slope is the deflection sensitivity.",
         .fallback_doc = "required with `afm.loops`"},
        to(&ForceCurvesSpec::hard)},
       {{.name = "sample",
         .kind = Kind::file,
         .doc = "Curves on the sample (CSV): their pull-off gives the adhesion.",
         .fallback_doc = "none: the adhesion is taken from the curves of `hard`"},
        to(&ForceCurvesSpec::sample)},
       error_key("piezo_error", &ForceCurvesSpec::piezo_error,
                 "Relative standard uncertainty of the piezo displacement."),
       share_key("free", &ForceCurvesSpec::free, 0.02, 0.9, 0.3,
                 "Fraction of the travel to the turning point over which the probe is free of "
                 "the surface: the zero-force line is fitted there."),
       share_key("from", &ForceCurvesSpec::from, 0, 0.9, 0.25,
                 "Start of the fitted contact line, as a fraction of the maximum signal."),
       share_key("until", &ForceCurvesSpec::until, 0.1, 1, 0.95,
                 "End of the fitted contact line, as a fraction of the maximum signal.")}};
  return declaration;
}

const TableDeclaration<LeverSpec>& declared_lever() {
  static const TableDeclaration<LeverSpec> declaration{
      {"lever", false, "", "The lever, calibrated beforehand."},
      {{{.name = "calibration",
         .kind = Kind::file,
         .doc = "`summary.json` of a run that calibrated the lever; it supplies `k_n`, `k_l`, "
                "`arm` and `share_twist`.",
         .fallback_doc = "the values below"},
        to(&LeverSpec::calibration)},
       quantity_key("k_n", "N/m", 1e6, &LeverSpec::k_n, "Normal stiffness.", "from `calibration`"),
       error_key("k_n_error", &LeverSpec::k_n_error,
                 "Relative standard uncertainty of the normal stiffness, also of one from "
                 "`calibration`: due to dimensions and modulus of the lever.",
                 std::nullopt),
       {{.name = "tilt",
         .kind = Kind::quantity,
         .unit = "rad",
         .range = within(0, 1),
         .doc = "Angle between lever and surface, if `k_n` applies to a force along the "
                "lever's own normal (thermal noise, Sader's method): k_n / cos^2 is then used.",
         .fallback_doc = "none: `k_n` applies along the surface normal"},
        to(&LeverSpec::tilt)},
       quantity_key("k_l", "N/m", 1e9, &LeverSpec::k_l,
                    "Lateral stiffness at the end of the tip, for `lateral = \"test_probe\"`.",
                    "from `calibration`"),
       error_key("k_l_error", &LeverSpec::k_l_error,
                 "Relative standard uncertainty of the lateral stiffness.", std::nullopt),
       quantity_key("arm", "m", 1, &LeverSpec::arm,
                    "Distance of the end of the tip from the mid-plane of the lever, for `k_l`.",
                    "from `calibration`"),
       error_key("arm_error", &LeverSpec::arm_error, "Relative standard uncertainty of the arm."),
       share_key("twist_share", &LeverSpec::twist_share, 0.01, 1, {},
                 "Fraction of the tip's lateral displacement due to twist of the lever.",
                 "from `calibration`, otherwise 1")}};
  return declaration;
}

const TableDeclaration<CrosstalkSpec>& declared_crosstalk() {
  static const TableDeclaration<CrosstalkSpec> declaration{
      {"crosstalk", false, "method",
       "Crosstalk from the normal to the lateral signal: lateral = true lateral + "
       "coefficient x normal."},
      {{{.name = "method",
         .kind = Kind::choice,
         .choices = words_of<CrosstalkMethod>(
             {{"force_curves",
               "the slope of the lateral versus the normal signal in the contact part of the "
               "curves of `force_curves.hard` if they have a column `lateral`; otherwise no "
               "correction"},
              {"given", "given by `coefficient`"},
              {"none", "no correction"}}),
         .fallback = value_of("force_curves"),
         .doc = "Source of the coefficient."},
        word_to(&CrosstalkSpec::method)},
       {{.name = "coefficient",
         .kind = Kind::number,
         .range = within(-10, 10),
         .required = true,
         .only_for = "given",
         .doc = "Lateral volts per normal volt."},
        to(&CrosstalkSpec::coefficient)},
       {{.name = "error",
         .kind = Kind::number,
         .range = within(0, 1),
         .fallback = value_of(0.0),
         .only_for = "given",
         .doc = "Standard uncertainty of the coefficient."},
        to(&CrosstalkSpec::error)}}};
  return declaration;
}

const TableDeclaration<TestProbeSpec>& declared_test_probe() {
  static const TableDeclaration<TestProbeSpec> declaration{
      {"test_probe", false, "",
       "A lever of the same type with a large ball, pressed sideways against a wall: "
       "the slope of the lateral signal gives the volts per twist (Cannara, Eglin & "
       "Carpick 2006)."},
      {{{.name = "contacts",
         .kind = Kind::file,
         .doc = "Side contacts (CSV): piezo `displacement` along the sample versus `lateral` "
                "signal.",
         .fallback_doc = "required with `lateral = \"test_probe\"`"},
        to(&TestProbeSpec::contacts)},
       quantity_key("arm", "m", 1, &TestProbeSpec::arm,
                    "Distance of the contact point from the mid-plane of the test lever: for a "
                    "ball, its radius plus half the lever thickness.",
                    "required with `contacts`"),
       error_key("arm_error", &TestProbeSpec::arm_error,
                 "Relative standard uncertainty of the arm."),
       share_key("twist_share", &TestProbeSpec::twist_share, 0.01, 1, 1.0,
                 "Fraction of the lateral displacement due to twist of the test lever."),
       share_key("intensity_ratio", &TestProbeSpec::intensity_ratio, 0.01, 100, 1.0,
                 "Ratio of the light intensity on the detector with the lever to that with the "
                 "test lever."),
       error_key("intensity_error", &TestProbeSpec::intensity_error,
                 "Relative standard uncertainty of the ratio."),
       error_key("piezo_error", &TestProbeSpec::piezo_error,
                 "Relative standard uncertainty of the lateral piezo displacement.")}};
  return declaration;
}

namespace {

void check_lever(const VoltsSpec& spec, std::vector<Fault>& faults) {
  const LeverSpec& lever = spec.lever;
  const auto missing = [&](const std::string& path, bool given, const char* example) {
    if (!given) faults.push_back({path, fmt::format("is missing, allowed: {}", example)});
  };
  const auto twice = [&](const std::string& path, bool given) {
    if (given && !lever.calibration.empty())
      faults.push_back(
          {path, "is given together with `lever.calibration`, allowed: only one of them"});
  };
  twice("lever.k_n", lever.k_n.has_value());
  twice("lever.k_l", lever.k_l.has_value());
  twice("lever.arm", lever.arm.has_value());
  twice("lever.twist_share", lever.twist_share.has_value());
  twice("lever.tilt", lever.tilt.has_value());
  const bool by_run = !lever.calibration.empty();
  missing("lever.k_n", by_run || lever.k_n, "k_n = \"0.32 N/m\", or `calibration`");
  missing("lever.k_n_error", lever.k_n_error.has_value(), "k_n_error = 0.05, a fraction of k_n");
  if (spec.lateral() != LateralMethod::test_probe) return;
  missing("lever.k_l", by_run || lever.k_l, "k_l = \"76 N/m\", or `calibration`");
  missing("lever.arm", by_run || lever.arm, "arm = \"14.8 um\", or `calibration`");
  missing("lever.k_l_error", lever.k_l_error.has_value(), "k_l_error = 0.05, a fraction of k_l");
  missing("test_probe.contacts", !spec.test_probe.contacts.empty(), "a file of side contacts");
  missing("test_probe.arm", spec.test_probe.arm.has_value(), "arm = \"25 um\"");
}

}  // namespace

std::vector<Fault> faults_of(const VoltsSpec& spec, bool has_wedge) {
  std::vector<Fault> faults;
  const ForceCurvesSpec& curves = spec.force_curves;
  if (!spec.wanted()) {
    if (!curves.hard.empty() || !curves.sample.empty())
      faults.push_back({"afm.loops", "is missing, allowed: friction loops on the sample (CSV)"});
    return faults;
  }
  if (curves.hard.empty())
    faults.push_back(
        {"force_curves.hard", "is missing, allowed: force curves on a hard surface (CSV)"});
  if (!(curves.until >= curves.from + 0.1))
    faults.push_back(
        {"force_curves.until", fmt::format("{:g} leaves no line above {:g}, allowed: >= {:g}",
                                           curves.until, curves.from, curves.from + 0.1)});
  if (spec.lateral() == LateralMethod::wedge && !has_wedge)
    faults.push_back({"wedge.loops",
                      "is missing, allowed: friction loops on slopes (CSV), or "
                      "lateral = \"test_probe\""});
  check_lever(spec, faults);
  return faults;
}

}  // namespace pulvis::volts
