// Declarations of reduce.toml: instruments, compact, clocks and the evaluation of the curves.
#include "cli/laboratory/declare_lab.hpp"

#include "cli/laboratory/declare_columns.hpp"
#include "cli/laboratory/volts/declare_volts.hpp"
#include "scenes/keys/declare.hpp"

#include <array>

namespace pulvis::lab {

using namespace schema;

namespace {

std::vector<Key<CompactSpec>> geometry_keys() {
  return {
      {{.name = "die_diameter",
        .kind = Kind::quantity,
        .unit = "m",
        .range = above(0, 1),
        .fallback = value_of("15 mm"),
        .doc = "Diameter D of die and punch (3.1)."},
       to(&CompactSpec::die_diameter)},
      {{.name = "length",
        .kind = Kind::quantity,
        .unit = "m",
        .range = above(0, 1),
        .doc = "Length L of the compact at the start of sliding; from there on, the punch "
               "displacement is subtracted. Alternative to `fill_height`.",
        .fallback_doc = "from `fill_height`"},
       to(&CompactSpec::length)},
      {{.name = "fill_height",
        .kind = Kind::quantity,
        .unit = "m",
        .range = above(0, 1),
        .doc = "Height of the powder at zero punch displacement: L is this height minus the "
               "displacement.",
        .fallback_doc = "from `length`"},
       to(&CompactSpec::fill_height)},
  };
}

std::vector<Key<CompactSpec>> powder_keys() {
  return {
      {{.name = "poissons_ratio",
        .kind = Kind::number,
        .range = within(0, 0.499),
        .doc = "Poisson's ratio of the compact in (3.1). Alternative to `powder`.",
        .fallback_doc = "from `powder`"},
       to(&CompactSpec::poissons_ratio)},
      {{.name = "powder",
        .kind = Kind::choice,
        .choices = powders(),
        .doc = "Powder whose Poisson's ratio is taken from Table 3.2 of the thesis.",
        .fallback_doc = "none"},
       [](CompactSpec& spec, const Decoded& value) { spec.powder = value.index; }},
      {{.name = "stress_ratio",
        .kind = Kind::number,
        .range = above(0, 2),
        .doc = "K in (3.1), the ratio of radial to axial stress in the compact. The report "
               "then also shows the coefficient for an elastic compact.",
        .fallback_doc = "that of an elastic compact, nu/(1 - nu)"},
       to(&CompactSpec::stress_ratio)},
      {{.name = "wall_friction",
        .kind = Kind::number,
        .range = within(0, 5),
        .doc = "Friction coefficient of the die wall in (3.1).",
        .fallback_doc = "that of the target: (3.1) and (3.2) are solved together"},
       to(&CompactSpec::wall_friction)},
  };
}

std::vector<Key<AnalysisSpec>> window_keys() {
  return {
      {{.name = "shortest_sliding",
        .kind = Kind::quantity,
        .unit = "m",
        .range = above(0, 10),
        .fallback = value_of("15 mm"),
        .doc = "A run with a shorter sliding distance is refused. The default is the diameter "
               "of the compact: only beyond it is the whole compact in contact with a fresh "
               "surface."},
       to(&AnalysisSpec::shortest_sliding)},
      {{.name = "static_within",
        .kind = Kind::quantity,
        .unit = "m",
        .range = above(0, 10),
        .fallback = value_of("3 mm"),
        .doc = "The static coefficient is the largest value within this distance from the "
               "start."},
       to(&AnalysisSpec::static_within)},
      {{.name = "dynamic_from",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(0, 10),
        .fallback = value_of("10 mm"),
        .doc = "Distance at which the dynamic mean and the stick-slip analysis begin."},
       to(&AnalysisSpec::dynamic_from)},
      {{.name = "dynamic_until",
        .kind = Kind::quantity,
        .unit = "m",
        .range = above(0, 10),
        .doc = "Distance at which they end.",
        .fallback_doc = "the end of sliding"},
       to(&AnalysisSpec::dynamic_until)},
  };
}

}  // namespace

const TableDeclaration<Settings>& declared_top() {
  static const TableDeclaration<Settings> declaration{
      {"", false, "", "A series of tests with the same powder, surface, load and speed."},
      {{{.name = "title",
         .kind = Kind::text,
         .doc = "Title of the report.",
         .fallback_doc = "none"},
        to(&Settings::title)}}};
  return declaration;
}

const TableDeclaration<PressSpec>& declared_press() {
  static const TableDeclaration<PressSpec> declaration{
      {"press", false, "", "Records of the press: time, normal force, punch displacement."},
      {column_key("time", "time", &PressSpec::time, "Name of the time column of the press."),
       column_key("force", "force", &PressSpec::force,
                  "Name of the column with the force on the punch, of either sign."),
       column_key("displacement", "displacement", &PressSpec::displacement,
                  "Name of the column with the punch displacement; its sign is determined from "
                  "the loading."),
       header_key<PressSpec>(),
       {{.name = "capacity",
         .kind = Kind::quantity,
         .unit = "N",
         .range = above(0, 1e9),
         .fallback = value_of("20 kN"),
         .doc = "A record that reaches this force is refused as saturated (3.2.3)."},
        to(&PressSpec::capacity)},
       {{.name = "hold_tolerance",
         .kind = Kind::number,
         .range = between(0, 1),
         .fallback = value_of(0.1),
         .doc = "The force counts as held while it stays within this fraction of its median "
                "over the upper half."},
        to(&PressSpec::hold_tolerance)}}};
  return declaration;
}

const TableDeclaration<LoggerSpec>& declared_logger() {
  static const TableDeclaration<LoggerSpec> declaration{
      {"logger", false, "", "Records of the data logger: time, load cell strain, LVDT voltage."},
      {column_key("time", "time", &LoggerSpec::time, "Name of the time column of the logger."),
       column_key("strain", "strain", &LoggerSpec::strain,
                  "Name of the column with the load cell strain, in um/m (or ue, ppm, m/m, %)."),
       column_key("lvdt", "lvdt", &LoggerSpec::lvdt,
                  "Name of the column with the LVDT voltage; its sign is determined from the "
                  "motion."),
       header_key<LoggerSpec>(),
       {{.name = "strain_limit",
         .kind = Kind::number,
         .range = above(0, 1),
         .doc = "A record whose strain reaches this magnitude is refused as saturated; 0.003 "
                "is 3000 um/m.",
         .fallback_doc = "none: only records whose samples repeat at an extreme value are refused"},
        to(&LoggerSpec::strain_limit)},
       {{.name = "lvdt_limit",
         .kind = Kind::quantity,
         .unit = "V",
         .range = above(0, 1e3),
         .doc = "A record whose LVDT voltage reaches this magnitude is refused as saturated.",
         .fallback_doc = "none: only records whose samples repeat at an extreme value are refused"},
        to(&LoggerSpec::lvdt_limit)}}};
  return declaration;
}

const TableDeclaration<LoadCellSpec>& declared_load_cell() {
  static const TableDeclaration<LoadCellSpec> declaration{
      {"load_cell", false, "",
       "Calibration of the load cell: shear force = gain x strain + offset (3.2.4)."},
      {{{.name = "gain",
         .kind = Kind::quantity,
         .unit = "N",
         .range = within(-1e12, 1e12),
         .fallback = value_of("0.7257 N/(um/m)"),
         .doc = "Force per strain; negative if the bridge is wired with opposite polarity."},
        to(&LoadCellSpec::gain)},
       {{.name = "offset",
         .kind = Kind::quantity,
         .unit = "N",
         .range = within(-1e6, 1e6),
         .fallback = value_of("1.3795 N"),
         .doc = "Force at zero strain."},
        to(&LoadCellSpec::offset)},
       {{.name = "zero",
         .kind = Kind::choice,
         .choices =
             words_of<LoadCellSpec::Zero>({{"calibration", "the calibrated offset"},
                                           {"standstill", "the mean before sliding starts"}}),
         .fallback = value_of("calibration"),
         .doc = "Definition of zero shear force."},
        word_to(&LoadCellSpec::zero)}}};
  return declaration;
}

const TableDeclaration<LvdtSpec>& declared_lvdt() {
  static const TableDeclaration<LvdtSpec> declaration{
      {"lvdt", false, "", "Calibration of the displacement transducer (3.2.5)."},
      {{{.name = "sensitivity",
         .kind = Kind::quantity,
         .unit = "V/m",
         .range = above(0, 1e9),
         .fallback = value_of("3.58 mV/mm"),
         .doc = "Voltage per displacement."},
        to(&LvdtSpec::sensitivity)}}};
  return declaration;
}

const TableDeclaration<CompactSpec>& declared_compact() {
  static const TableDeclaration<CompactSpec> declaration = [] {
    TableDeclaration<CompactSpec> made{
        {"compact", false, "",
         "The compact, as required by (3.1): force at its bottom = force on the punch x "
         "exp(-4 mu K L / D)."},
        geometry_keys()};
    for (const auto& key : powder_keys()) made.keys.push_back(key);
    return made;
  }();
  return declaration;
}

const TableDeclaration<ClockSpec>& declared_clock() {
  static const TableDeclaration<ClockSpec> declaration{
      {"clock", false, "", "Synchronisation of the clocks of press and logger."},
      {{{.name = "drift",
         .kind = Kind::choice,
         .choices = words_of<ClockSpec::Drift>(
             {{"events",
               "from start and end of sliding, if both records show both and the difference "
               "exceeds three times its uncertainty"},
              {"none", "the clocks run at the same rate; only the start of sliding is used"}}),
         .fallback = value_of("events"),
         .doc = "How the relative rate of the two clocks is determined."},
        word_to(&ClockSpec::drift)},
       {{.name = "largest_drift",
         .kind = Kind::number,
         .range = within(0, 0.5),
         .fallback = value_of(0.001),
         .doc = "Clocks whose rates differ by more than this, and by more than four standard "
                "uncertainties, are refused as belonging to different tests."},
        to(&ClockSpec::largest_drift)},
       {{.name = "window",
         .kind = Kind::quantity,
         .unit = "s",
         .range = above(0, 1e4),
         .fallback = value_of("3 s"),
         .doc = "Time on either side of an event within which two lines are fitted to the "
                "record."},
        to(&ClockSpec::window)},
       {{.name = "longest_gap",
         .kind = Kind::number,
         .range = within(1.5, 1e6),
         .fallback = value_of(5.0),
         .doc = "Maximum time between two samples, in multiples of the median interval of the "
                "record; longer gaps are refused."},
        to(&ClockSpec::longest_gap)}}};
  return declaration;
}

const TableDeclaration<AnalysisSpec>& declared_analysis() {
  static const TableDeclaration<AnalysisSpec> declaration = [] {
    TableDeclaration<AnalysisSpec> made{
        {"analysis", false, "", "Evaluation of the curve of each run and of the set of runs."},
        window_keys()};
    made.keys.push_back({{.name = "confidence",
                          .kind = Kind::number,
                          .range = between(0, 1),
                          .fallback = value_of(0.95),
                          .doc = "Confidence level of the interval of a mean over the runs."},
                         to(&AnalysisSpec::confidence)});
    made.keys.push_back({{.name = "distance_step",
                          .kind = Kind::quantity,
                          .unit = "m",
                          .range = within(1e-6, 1),
                          .fallback = value_of("0.1 mm"),
                          .doc = "Step of the common grid on which curves are compared."},
                         to(&AnalysisSpec::distance_step)});
    return made;
  }();
  return declaration;
}

const TableDeclaration<SimulationSpec>& declared_simulation() {
  static const TableDeclaration<SimulationSpec> declaration{
      {"simulation", false, "", "How a run folder given with `--simulation` is read."},
      {{{.name = "target",
         .kind = Kind::name,
         .fallback = value_of("target"),
         .doc = "Tool that slides under the compact: its forces give the coefficient, its "
                "travel along x the distance."},
        to(&SimulationSpec::target)},
       {{.name = "density",
         .kind = Kind::text,
         .fallback = value_of("relative_density"),
         .doc = "Series of the relative density, for compression curves."},
        to(&SimulationSpec::density)},
       {{.name = "pressure",
         .kind = Kind::text,
         .fallback = value_of("stress/axial_top"),
         .doc = "Series of the axial stress, of either sign, for compression curves. For a "
                "periodic cell: \"cell/stress_yy\"."},
        to(&SimulationSpec::pressure)}}};
  return declaration;
}

const char* powder_name(int powder) {
  static const std::vector<schema::Choice> known = powders();
  return known.at(static_cast<std::size_t>(powder)).word.c_str();
}

double CompactSpec::poisson() const {
  static constexpr std::array table_3_2{0.35, 0.3, 0.252, 0.25};  // in the order of the choices
  return poissons_ratio ? *poissons_ratio : table_3_2.at(static_cast<std::size_t>(powder.value()));
}

const Language& language() {
  static const Language tables{view_of(declared_top()),
                               view_of(declared_press()),
                               view_of(declared_logger()),
                               view_of(declared_load_cell()),
                               view_of(declared_lvdt()),
                               view_of(declared_compact()),
                               view_of(declared_clock()),
                               view_of(declared_analysis()),
                               view_of(declared_simulation()),
                               view_of(declared_wedge()),
                               view_of(volts::declared_afm()),
                               view_of(volts::declared_force_curves()),
                               view_of(volts::declared_lever()),
                               view_of(volts::declared_crosstalk()),
                               view_of(volts::declared_test_probe()),
                               view_of(declared_run()),
                               view_of(declared_die()),
                               view_of(declared_compression()),
                               view_of(declared_curve()),
                               view_of(declared_gauges()),
                               view_of(declared_transmission())};
  return tables;
}

}  // namespace pulvis::lab
