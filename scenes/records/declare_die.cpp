// Declarations of reduce.toml: records of a press whose die is filled, for compression curves.
#include "scenes/keys/declare.hpp"
#include "scenes/records/declare_columns.hpp"
#include "scenes/records/declare_lab.hpp"

namespace pulvis::lab {

using namespace schema;

namespace {

std::vector<Key<CompressionSpec>> machine_keys() {
  return {
      {{.name = "empty",
        .kind = Kind::file,
        .doc = "Record of the press (CSV) with its punches against each other: a polynomial "
               "through its loading is what the press itself gives.",
        .fallback_doc = "none"},
       to(&CompressionSpec::empty)},
      {{.name = "empty_degree",
        .kind = Kind::integer,
        .range = within(1, 6),
        .fallback = value_of(3),
        .doc = "Degree of that polynomial of the force."},
       integer_to(&CompressionSpec::empty_degree)},
      {{.name = "compliance",
        .kind = Kind::numbers,
        .doc = "What the press itself gives, c1 F + c2 F^2 + ..., in m/N, m/N^2 and so on, where "
               "there is no `empty` record.",
        .fallback_doc = "a rigid press"},
       [](CompressionSpec& spec, const Decoded& value) { spec.compliance = value.numbers; }},
      {{.name = "contact",
        .kind = Kind::number,
        .range = between(0, 0.5),
        .fallback = value_of(0.001),
        .doc = "The loading begins where the force passes this share of its largest value."},
       to(&CompressionSpec::contact)},
      {{.name = "largest_fall",
        .kind = Kind::number,
        .range = between(0, 1),
        .fallback = value_of(0.03),
        .doc = "A record whose force falls by more than this share of its largest value before it "
               "is reached is refused: no single loading."},
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

// Of one filling of the die.
template <class Spec>
std::vector<Key<Spec>> filling_keys() {
  return {
      {{.name = "name",
        .kind = Kind::name,
        .required = true,
        .doc = "Names its file and its curve."},
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
        .doc = "Height of the powder where the displacement of the punch is zero.",
        .fallback_doc = "from `final_height`, or from `compression.empty`"},
       to(&Spec::fill_height)},
      {{.name = "final_height",
        .kind = Kind::quantity,
        .unit = "m",
        .range = above(0, 10),
        .doc = "Height of the compact in the die at the end of the record, unloaded. With neither "
               "height the record of the empty press must count its displacement from the same "
               "zero.",
        .fallback_doc = "from `fill_height`, or from `compression.empty`"},
       to(&Spec::final_height)},
  };
}

}  // namespace

const TableDeclaration<DieSpec>& declared_die() {
  static const TableDeclaration<DieSpec> declaration{
      {"die", false, "shape",
       "The die that a press fills, for `[[curve]]` and `[[transmission]]`."},
      {{{.name = "shape",
         .kind = Kind::choice,
         .choices = {{"round", "a cylinder"}, {"slot", "two walls, as a plane strain model has"}},
         .fallback = value_of("round"),
         .doc = "Cross-section."},
        index_to(&DieSpec::shape)},
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
         .doc = "The other side of the punch."},
        to(&DieSpec::thickness)},
       {{.name = "solid_density",
         .kind = Kind::quantity,
         .unit = "kg/m^3",
         .range = above(0, 1e5),
         .doc = "Density of the powder's solid; required for `[[curve]]` and `[[transmission]]`.",
         .fallback_doc = "none"},
        to(&DieSpec::solid_density)},
       error_key("mass_error", &DieSpec::mass_error,
                 "Standard uncertainty of the masses over the solid density, as a share."),
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
         "Compression curves: the press's own give, and what the laws are fitted to."},
        machine_keys()};
    made.keys.push_back(pressure_key("fit_from", &CompressionSpec::fit_from,
                                     "Axial pressure where the fitted part of the loading begins.",
                                     "1% of the largest"));
    made.keys.push_back(pressure_key("fit_until", &CompressionSpec::fit_until,
                                     "Axial pressure where it ends.", "the largest"));
    made.keys.push_back(error_key("compliance_error", &CompressionSpec::compliance_error,
                                  "Standard uncertainty of what the press gives, as a share."));
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
    made.keys.push_back({{.name = "press",
                          .kind = Kind::file,
                          .required = true,
                          .doc = "Record of the press (CSV), as a path from the folder of this "
                                 "file; its columns are those of `[press]`."},
                         to(&CurveSpec::press)});
    made.keys.push_back(
        {{.name = "initial_density",
          .kind = Kind::number,
          .range = between(0, 1),
          .doc = "Relative density that Kawakita's and Cooper and Eaton's laws begin at.",
          .fallback_doc = "that where the loading begins"},
         to(&CurveSpec::initial_density)});
    return made;
  }();
  return declaration;
}

const TableDeclaration<GaugesSpec>& declared_gauges() {
  static const TableDeclaration<GaugesSpec> declaration = [] {
    TableDeclaration<GaugesSpec> made{
        {"gauges", false, "",
         "Records of an instrumented die: forces on both punches, and the wall's stress."},
        {column_key("time", "time", &GaugesSpec::time, "Name of the column with the time."),
         column_key("displacement", "displacement", &GaugesSpec::displacement,
                    "Name of the column with the displacement of the top punch."),
         column_key("top", "top", &GaugesSpec::top,
                    "Name of the column with the force on the top punch, which is the one that "
                    "moves."),
         column_key("bottom", "bottom", &GaugesSpec::bottom,
                    "Name of the column with the force on the bottom punch."),
         column_key("radial", "radial", &GaugesSpec::radial,
                    "Name of the column with the stress on the wall (Pa)."),
         header_key<GaugesSpec>(),
         {{.name = "radial_height",
           .kind = Kind::quantity,
           .unit = "m",
           .range = within(0, 10),
           .doc = "Height of the wall's gauge above the bottom punch.",
           .fallback_doc = "it measures the mean over the compact's height"},
          to(&GaugesSpec::radial_height)},
         {{.name = "from",
           .kind = Kind::number,
           .range = above(0, 1),
           .fallback = value_of(0.05),
           .doc =
               "Share of the largest axial pressure from which on K and the friction are taken."},
          to(&GaugesSpec::from)},
         {{.name = "density_step",
           .kind = Kind::number,
           .range = within(1e-4, 1),
           .fallback = value_of(0.02),
           .doc = "Step of the relative density at which they are told."},
          to(&GaugesSpec::density_step)}}};
    made.keys.push_back(error_key("top_error", &GaugesSpec::top_error,
                                  "Standard uncertainty of the top force, as a share."));
    made.keys.push_back(error_key("bottom_error", &GaugesSpec::bottom_error,
                                  "The same of the bottom force; both count as independent."));
    made.keys.push_back(
        error_key("radial_error", &GaugesSpec::radial_error, "The same of the wall's stress."));
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
    made.keys.push_back({{.name = "record",
                          .kind = Kind::file,
                          .required = true,
                          .doc = "Record (CSV), as a path from the folder of this file; its "
                                 "columns are those of `[gauges]`."},
                         to(&TransmissionSpec::record)});
    return made;
  }();
  return declaration;
}

}  // namespace pulvis::lab
