// Declarations of reduce.toml: the wedge calibration of an AFM's lateral force.
#include "scenes/keys/declare.hpp"
#include "scenes/records/declare_lab.hpp"

namespace pulvis::lab {

using namespace schema;

const TableDeclaration<WedgeSpec>& declared_wedge() {
  static const TableDeclaration<WedgeSpec> declaration{
      {"wedge", false, "",
       "Friction loops of an AFM on slopes that are known, instead of sliding-plate tests: "
       "friction "
       "coefficient and sensitivity of the lateral detector."},
      {{{.name = "loops",
         .kind = Kind::file,
         .doc = "The loops (CSV), as a path from the folder of this file. A file of loops on the "
                "command line stands for it.",
         .fallback_doc = "sliding-plate tests are reduced"},
        to(&WedgeSpec::loops)},
       {{.name = "adhesion",
         .kind = Kind::quantity,
         .unit = "N",
         .range = within(-1, 1),
         .fallback = value_of("0 N"),
         .doc = "Pull-off force along the normal, for slopes that were seen at one load only."},
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
         .doc =
             "Standard uncertainty of the normal calibration, as a share of the load: it goes to "
             "the sensitivity alone."},
        to(&WedgeSpec::load_error)},
       {{.name = "skip",
         .kind = Kind::number,
         .range = within(0, 0.45),
         .fallback = value_of(0.15),
         .doc = "Share of a raw trace that is left out at each end, where the tip sticks."},
        to(&WedgeSpec::skip)}}};
  return declaration;
}

}  // namespace pulvis::lab
