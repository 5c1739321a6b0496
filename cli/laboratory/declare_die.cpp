// Declarations of reduce.toml: records of a press with a filled die, for compression curves.
#include "cli/laboratory/declare_columns.hpp"
#include "cli/laboratory/declare_lab.hpp"
#include "scenes/keys/declare.hpp"

namespace pulvis::lab {

using namespace schema;

namespace {

std::vector<Key<CompressionSpec>> machine_keys() {
  return {
      {{.name = "empty",
        .kind = Kind::file,
        .doc = "Record of the press (CSV) with the punches in direct contact: a polynomial "
               "fitted to its loading gives the compliance of the press.",
        .fallback_doc = "none"},
       to(&CompressionSpec::empty)},
      {{.name = "empty_degree",
        .kind = Kind::integer,
        .range = within(1, 6),
        .fallback = value_of(3),
        .doc = "Degree of this polynomial in the force."},
       integer_to(&CompressionSpec::empty_degree)},
      {{.name = "compliance",
        .kind = Kind::numbers,
        .doc = "Compliance of the press, c1 F + c2 F^2 + ..., in m/N, m/N^2 and so on, if "
               "there is no `empty` record.",
        .fallback_doc = "a rigid press"},
       [](CompressionSpec& spec, const Decoded& value) { spec.compliance = value.numbers; }},
      {{.name = "contact",
        .kind = Kind::number,
        .range = between(0, 0.5),
        .fallback = value_of(0.001),
        .doc = "Loading begins where the force exceeds this fraction of its maximum."},
       to(&CompressionSpec::contact)},
      {{.name = "largest_fall",
        .kind = Kind::number,
        .range = between(0, 1),
        .fallback = value_of(0.03),
        .doc = "A record whose force drops by more than this fraction of its maximum before "
               "the maximum is reached is refused: it is not a single loading."},
       to(&CompressionSpec::largest_fall)},
  };
}

Key<CompressionSpec> pressure_key(const char* name, std::optional<double> CompressionSpec::*member,
                                  const char* doc, const char* otherwise) {
  return {{.name = name,
           .kind = Kind::quantity,
           .unit = "Pa",
           .range = above(0, 1e12),
           .doc = doc,
           .fallback_doc = otherwise},
          to(member)};
}

template <class Spec>
Key<Spec> error_key(const char* name, double Spec::*member, const char* doc) {
  return {{.name = name,
           .kind = Kind::number,
           .range = within(0, 0.5),
           .fallback = value_of(0.0),
           .doc = doc},
          to(member)};
}

// For one filling of the die.
template <class Spec>
std::vector<Key<Spec>> filling_keys() {
  return {
      {{.name = "name",
        .kind = Kind::name,
        .required = true,
        .doc = "Name used for its file and curve."},
       to(&Spec::name)},
      {{.name = "mass",
        .kind = Kind::quantity,
        .unit = "kg",
        .range = above(0, 1e3),
        .required = true,
        .doc = "Mass of the powder in the die."},
       to(&Spec::mass)},
      {{.name = "fill_height",
        .kind = Kind::quantity,
        .unit = "m",
        .range = above(0, 10),
        .doc = "Height of the powder at zero displacement of the punch.",
        .fallback_doc = "from `final_height`, or from `compression.empty`"},
       to(&Spec::fill_height)},
      {{.name = "final_height",
        .kind = Kind::quantity,
        .unit = "m",
        .range = above(0, 10),
        .doc = "Height of the unloaded compact in the die at the end of the record. If "
               "neither height is given, the record of the empty press must have the same "
               "zero of displacement.",
        .fallback_doc = "from `fill_height`, or from `compression.empty`"},
       to(&Spec::final_height)},
  };
}

}  // namespace

const TableDeclaration<DieSpec>& declared_die() {
  static const TableDeclaration<DieSpec> declaration{
      {"die", false, "shape",
       "The die in which the powder is pressed, for `[[curve]]` and "
       "`[[transmission]]`."},
      {{{.name = "shape",
         .kind = Kind::choice,
         .choices = words_of<DieSpec::Shape>(
             {{"round", "a cylindrical die"},
              {"slot", "a rectangular die of two walls, as in a plane-strain model"}}),
         .fallback = value_of("round"),
         .doc = "Cross-section."},
        word_to(&DieSpec::shape)},
       {{.name = "diameter",
         .kind = Kind::quantity,
         .unit = "m",
         .range = above(0, 1),
         .only_for = "round",
         .doc = "Diameter of die and punch.",
         .fallback_doc = "`\"15 mm\"`"},
        to(&DieSpec::diameter)},
       {{.name = "width",
         .kind = Kind::quantity,
         .unit = "m",
         .range = above(0, 10),
         .required = true,
         .only_for = "slot",
         .doc = "Distance between the two walls."},
        to(&DieSpec::width)},
       {{.name = "thickness",
         .kind = Kind::quantity,
         .unit = "m",
         .range = above(0, 10),
         .required = true,
         .only_for = "slot",
         .doc = "Other side length of the punch."},
        to(&DieSpec::thickness)},
       {{.name = "solid_density",
         .kind = Kind::quantity,
         .unit = "kg/m^3",
         .range = above(0, 1e5),
         .doc = "Solid density of the powder; required for `[[curve]]` and `[[transmission]]`.",
         .fallback_doc = "none"},
        to(&DieSpec::solid_density)},
       error_key("mass_error", &DieSpec::mass_error,
                 "Relative standard uncertainty of the ratio of mass to solid density."),
       {{.name = "height_error",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(0, 1),
         .fallback = value_of("0 mm"),
         .doc = "Standard uncertainty of the heights."},
        to(&DieSpec::height_error)}}};
  return declaration;
}

const TableDeclaration<CompressionSpec>& declared_compression() {
  static const TableDeclaration<CompressionSpec> declaration = [] {
    TableDeclaration<CompressionSpec> made{
        {"compression", false, "",
         "Compression curves: compliance of the press and fitted range of the laws."},
        machine_keys()};
    made.keys.push_back(pressure_key("fit_from", &CompressionSpec::fit_from,
                                     "Axial pressure at the start of the fitted range.",
                                     "1% of the maximum"));
    made.keys.push_back(pressure_key("fit_until", &CompressionSpec::fit_until,
                                     "Axial pressure at the end of the fitted range.",
                                     "the maximum"));
    made.keys.push_back(error_key("compliance_error", &CompressionSpec::compliance_error,
                                  "Relative standard uncertainty of the compliance of the press."));
    return made;
  }();
  return declaration;
}

const TableDeclaration<CurveSpec>& declared_curve() {
  static const TableDeclaration<CurveSpec> declaration = [] {
    TableDeclaration<CurveSpec> made{
        {"curve", true, "",
         "One compression: a record of the press, instead of sliding-plate tests."},
        filling_keys<CurveSpec>()};
    made.keys.push_back(
        {{.name = "press",
          .kind = Kind::file,
          .required = true,
          .doc = "Record of the press (CSV), as a path relative to the folder of this file; its "
                 "columns are those of `[press]`."},
         to(&CurveSpec::press)});
    made.keys.push_back({{.name = "initial_density",
                          .kind = Kind::number,
                          .range = between(0, 1),
                          .doc = "Initial relative density in the Kawakita and Cooper-Eaton laws.",
                          .fallback_doc = "that at the start of loading"},
                         to(&CurveSpec::initial_density)});
    return made;
  }();
  return declaration;
}

const TableDeclaration<GaugesSpec>& declared_gauges() {
  static const TableDeclaration<GaugesSpec> declaration = [] {
    TableDeclaration<GaugesSpec> made{
        {"gauges", false, "",
         "Records of an instrumented die: forces on both punches and wall stress."},
        {column_key("time", "time", &GaugesSpec::time, "Name of the time column."),
         column_key("displacement", "displacement", &GaugesSpec::displacement,
                    "Name of the column with the displacement of the top punch."),
         column_key("top", "top", &GaugesSpec::top,
                    "Name of the column with the force on the top punch, which moves."),
         column_key("bottom", "bottom", &GaugesSpec::bottom,
                    "Name of the column with the force on the bottom punch."),
         column_key("radial", "radial", &GaugesSpec::radial,
                    "Name of the column with the wall stress (Pa)."),
         header_key<GaugesSpec>(),
         {{.name = "radial_height",
           .kind = Kind::quantity,
           .unit = "m",
           .range = within(0, 10),
           .doc = "Height of the wall gauge above the bottom punch.",
           .fallback_doc = "none: the gauge measures the mean over the height of the compact"},
          to(&GaugesSpec::radial_height)},
         {{.name = "from",
           .kind = Kind::number,
           .range = above(0, 1),
           .fallback = value_of(0.05),
           .doc = "Fraction of the maximum axial pressure above which K and the friction are "
                  "evaluated."},
          to(&GaugesSpec::from)},
         {{.name = "density_step",
           .kind = Kind::number,
           .range = within(1e-4, 1),
           .fallback = value_of(0.02),
           .doc = "Interval of relative density at which they are reported."},
          to(&GaugesSpec::density_step)}}};
    made.keys.push_back(error_key("top_error", &GaugesSpec::top_error,
                                  "Relative standard uncertainty of the top force."));
    made.keys.push_back(
        error_key("bottom_error", &GaugesSpec::bottom_error,
                  "Relative standard uncertainty of the bottom force; the two are treated as "
                  "independent."));
    made.keys.push_back(error_key("radial_error", &GaugesSpec::radial_error,
                                  "Relative standard uncertainty of the wall stress."));
    return made;
  }();
  return declaration;
}

const TableDeclaration<TransmissionSpec>& declared_transmission() {
  static const TableDeclaration<TransmissionSpec> declaration = [] {
    TableDeclaration<TransmissionSpec> made{
        {"transmission", true, "",
         "One compression in an instrumented die, instead of sliding-plate tests."},
        filling_keys<TransmissionSpec>()};
    made.keys.push_back(
        {{.name = "record",
          .kind = Kind::file,
          .required = true,
          .doc = "Record (CSV), as a path relative to the folder of this file; its columns are "
                 "those of `[gauges]`."},
         to(&TransmissionSpec::record)});
    return made;
  }();
  return declaration;
}

}  // namespace pulvis::lab
