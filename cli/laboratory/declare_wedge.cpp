// Declarations of reduce.toml: the wedge calibration of an AFM's lateral force.
#include "cli/laboratory/declare_lab.hpp"
#include "scenes/keys/declare.hpp"

namespace pulvis::lab {

using namespace schema;

const TableDeclaration<WedgeSpec>& declared_wedge() {
  static const TableDeclaration<WedgeSpec> declaration{
      {"wedge", false, "",
       "AFM friction loops on known slopes, instead of sliding-plate tests: friction "
       "coefficient and sensitivity of the lateral detector."},
      {{{.name = "loops",
         .kind = Kind::file,
         .doc = "The loops (CSV), as a path relative to the folder of this file. A file of "
                "loops on the command line replaces it.",
         .fallback_doc = "none: sliding-plate tests are reduced"},
        to(&WedgeSpec::loops)},
       {{.name = "adhesion",
         .kind = Kind::quantity,
         .unit = "N",
         .range = within(-1, 1),
         .fallback = value_of("0 N"),
         .doc = "Pull-off force normal to the surface, for slopes measured at a single load."},
        to(&WedgeSpec::adhesion)},
       {{.name = "slope_error",
         .kind = Kind::quantity,
         .unit = "rad",
         .range = within(0, 1),
         .fallback = value_of("0 deg"),
         .doc = "Standard uncertainty of each slope."},
        to(&WedgeSpec::slope_error)},
       {{.name = "load_error",
         .kind = Kind::number,
         .range = within(0, 1),
         .fallback = value_of(0.0),
         .doc = "Relative standard uncertainty of the load from the normal calibration; it "
                "affects only the sensitivity."},
        to(&WedgeSpec::load_error)},
       {{.name = "expected_friction",
         .kind = Kind::number,
         .range = within(0.001, 100),
         .doc = "Approximate friction coefficient. The loops of a slope fit two coefficients, mu "
                "and about 1/mu: where all loops together do not decide, the one nearer to this "
                "(by ratio) is the result.",
         .fallback_doc = "none: both are given, and a warning says so"},
        to(&WedgeSpec::expected_friction)},
       {{.name = "skip",
         .kind = Kind::number,
         .range = within(0, 0.45),
         .fallback = value_of(0.15),
         .doc = "Fraction of a raw trace that is discarded at each end, where the tip sticks."},
        to(&WedgeSpec::skip)}}};
  return declaration;
}

}  // namespace pulvis::lab
