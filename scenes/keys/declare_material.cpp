// Declarations of materials, except for their hardening.
#include "scenes/keys/declare.hpp"
#include "scenes/materials/library.hpp"

namespace pulvis::schema {
namespace {

std::vector<Choice> library_names() {
  std::vector<Choice> names;
  for (const LibraryMaterial& material : material_library())
    names.push_back({material.name, material.title});
  return names;
}

}  // namespace

const TableDeclaration<MaterialSpec>& material() {
  static const TableDeclaration<MaterialSpec> declaration{
      {"material", true, "family",
       "A material: elastic, or elastic-plastic (J2) if it has a yield stress.", every_family},
      {{{.name = "name",
         .kind = Kind::name,
         .required = true,
         .doc = "Name by which particles, friction pairs, levers and tips refer to the "
                "material."},
        to(&MaterialSpec::name)},
       {{.name = "library",
         .kind = Kind::choice,
         .choices = library_names(),
         .doc = "Name of a library material (docs/materials.md) that supplies all values not "
                "given here.",
         .fallback_doc = "none: all values are given here"},
        nothing<MaterialSpec>},
       {{.name = "elastic",
         .kind = Kind::flag,
         .needs = "library",
         .doc = "Take only the elastic constants from the library.",
         .fallback_doc = "`false`"},
        nothing<MaterialSpec>},
       {{.name = "density",
         .kind = Kind::quantity,
         .unit = "kg/m^3",
         .range = within(1e-3, 1e9),
         .required = true,
         .only_for = compaction_only,
         .doc = "Mass density."},
        to(&MaterialSpec::density)},
       {{.name = "youngs_modulus",
         .kind = Kind::quantity,
         .unit = "Pa",
         .range = within(1, 1e13),
         .required = true,
         .doc = "Young's modulus."},
        to(&MaterialSpec::youngs_modulus)},
       {{.name = "poissons_ratio",
         .kind = Kind::number,
         .range = between(-1, 0.5),
         .required = true,
         .doc = "Poisson's ratio."},
        to(&MaterialSpec::poissons_ratio)},
       {{.name = "yield_stress",
         .kind = Kind::quantity,
         .unit = "Pa",
         .range = within(1e-3, 1e13),
         .doc = "Initial yield stress; must be below Young's modulus.",
         .fallback_doc = "none: the material is elastic"},
        to(&MaterialSpec::yield_stress)},
       {{.name = "hardening_modulus",
         .kind = Kind::quantity,
         .unit = "Pa",
         .range = within(0, 1e13),
         .fallback = value_of("0 Pa"),
         .needs = "yield_stress",
         .doc = "Slope of yield stress versus plastic strain; 0: perfectly plastic."},
        to(&MaterialSpec::hardening_modulus)}}};
  return declaration;
}

const TableDeclaration<MaterialSpec>& material_damping() {
  static const TableDeclaration<MaterialSpec> declaration{
      {"material.damping", false, "family",
       "Rayleigh damping: an oscillation of angular frequency w has the damping ratio "
       "mass_proportional/(2 w) + stiffness_proportional w/2.",
       compaction_only, true},
      {{{.name = "mass_proportional",
         .kind = Kind::quantity,
         .unit = "1/s",
         .range = within(0, 1e15),
         .fallback = value_of("0 1/s"),
         .only_for = compaction_only,
         .doc = "alpha: drag force per mass and velocity. It mainly damps slow oscillations, "
                "and also rigid-body motion."},
        to(&MaterialSpec::mass_damping)},
       {{.name = "stiffness_proportional",
         .kind = Kind::quantity,
         .unit = "s",
         .range = within(0, 1e6),
         .fallback = value_of("0 s"),
         .only_for = compaction_only,
         .doc = "beta: viscous stress divided by the rate of elastic stress. It mainly damps "
                "fast oscillations and leaves rigid-body motion undamped. It reduces the time "
                "step unless beta is well below the time step, and adds to the flow stress of "
                "yielding material."},
        to(&MaterialSpec::stiffness_damping)}}};
  return declaration;
}

}  // namespace pulvis::schema
