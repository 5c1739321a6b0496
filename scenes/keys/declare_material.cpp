// Declarations of materials, but for how they harden.
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
       "A material: elastic, or elastic-plastic (J2) with a yield stress.", every_family},
      {{{.name = "name",
         .kind = Kind::name,
         .required = true,
         .doc = "What is made of it refers to it: particles, friction pairs, levers, tips."},
        to(&MaterialSpec::name)},
       {{.name = "library",
         .kind = Kind::choice,
         .choices = library_names(),
         .doc = "Its values are those of a material of the library (docs/materials.md), but for "
                "those given here.",
         .fallback_doc = "all values are given here"},
        nothing<MaterialSpec>},
       {{.name = "elastic",
         .kind = Kind::flag,
         .needs = "library",
         .doc = "The elastic constants of the library alone are taken.",
         .fallback_doc = "`false`"},
        nothing<MaterialSpec>},
       {{.name = "density",
         .kind = Kind::quantity,
         .unit = "kg/m^3",
         .range = within(1e-3, 1e9),
         .required = true,
         .only_for = compaction_only,
         .doc = "Mass per volume."},
        to(&MaterialSpec::density)},
       {{.name = "youngs_modulus",
         .kind = Kind::quantity,
         .unit = "Pa",
         .range = within(1, 1e13),
         .required = true,
         .doc = "Stiffness in simple tension."},
        to(&MaterialSpec::youngs_modulus)},
       {{.name = "poissons_ratio",
         .kind = Kind::number,
         .range = between(-1, 0.5),
         .required = true,
         .doc = "Sideways contraction over extension."},
        to(&MaterialSpec::poissons_ratio)},
       {{.name = "yield_stress",
         .kind = Kind::quantity,
         .unit = "Pa",
         .range = within(1e-3, 1e13),
         .doc = "Where plastic flow begins; below Young's modulus.",
         .fallback_doc = "the material stays elastic"},
        to(&MaterialSpec::yield_stress)},
       {{.name = "hardening_modulus",
         .kind = Kind::quantity,
         .unit = "Pa",
         .range = within(0, 1e13),
         .fallback = value_of("0 Pa"),
         .needs = "yield_stress",
         .doc = "Growth of the yield stress with plastic strain; 0 is perfectly plastic."},
        to(&MaterialSpec::hardening_modulus)}}};
  return declaration;
}

const TableDeclaration<MaterialSpec>& material_damping() {
  static const TableDeclaration<MaterialSpec> declaration{
      {"material.damping", false, "family",
       "Bulk damping (Rayleigh): an oscillation of angular frequency w decays with the damping "
       "ratio "
       "mass_proportional/(2 w) + stiffness_proportional w/2.",
       compaction_only, true},
      {{{.name = "mass_proportional",
         .kind = Kind::quantity,
         .unit = "1/s",
         .range = within(0, 1e15),
         .fallback = value_of("0 1/s"),
         .only_for = compaction_only,
         .doc =
             "alpha: force against the velocity, per mass. Damps slow oscillations most, and the "
             "motion of a body as a whole with them."},
        to(&MaterialSpec::mass_damping)},
       {{.name = "stiffness_proportional",
         .kind = Kind::quantity,
         .unit = "s",
         .range = within(0, 1e6),
         .fallback = value_of("0 s"),
         .only_for = compaction_only,
         .doc = "beta: viscous stress over the rate of the elastic stress. Damps fast oscillations "
                "most, no motion of a body as a whole; makes the time step shorter where it is not "
                "well below it, and adds to the flow stress of what flows."},
        to(&MaterialSpec::stiffness_damping)}}};
  return declaration;
}

}  // namespace pulvis::schema
