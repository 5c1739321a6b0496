// Declaration of bonds, which hold until they break.
#include "scenes/keys/declare.hpp"
#include "scenes/keys/tables.hpp"

namespace pulvis::schema {
namespace {

const Words of_bonds{"initial", "pressed"};  // not for adhesion, which has no history

Key<BondSpec> strength_key(const char* name, std::optional<double> BondSpec::*member,
                           const char* doc) {
  return {{.name = name,
           .kind = Kind::quantity,
           .unit = "Pa",
           .range = above(0, 1e13),
           .only_for = of_bonds,
           .doc = doc,
           .fallback_doc = "`strength`"},
          to(member)};
}

std::vector<Key<BondSpec>> bond_law_keys() {
  return {{{.name = "strength",
            .kind = Kind::quantity,
            .unit = "Pa",
            .range = above(0, 1e13),
            .required = true,
            .only_for = of_bonds,
            .doc = "Tensile stress at which damage of the bond begins; for pressed bonds, the "
                   "largest value this strength can reach."},
           to(&BondSpec::strength)},
          strength_key("shear_strength", &BondSpec::shear_strength,
                       "Shear stress at which damage begins."),
          {{.name = "fracture_energy",
            .kind = Kind::quantity,
            .unit = "J/m^2",
            .range = above(0, 1e9),
            .required = true,
            .only_for = of_bonds,
            .doc = "Mode I fracture energy per area (opening)."},
           to(&BondSpec::fracture_energy)},
          {{.name = "shear_fracture_energy",
            .kind = Kind::quantity,
            .unit = "J/m^2",
            .range = above(0, 1e9),
            .only_for = of_bonds,
            .doc = "Mode II fracture energy per area (shear).",
            .fallback_doc = "`fracture_energy`"},
           to(&BondSpec::shear_fracture_energy)},
          {{.name = "mixed_mode_exponent",
            .kind = Kind::number,
            .range = within(0.5, 10),
            .fallback = value_of(2.0),
            .only_for = of_bonds,
            .doc = "Exponent eta of the Benzeggagh-Kenane law: how strength and fracture energy "
                   "vary between mode I and mode II."},
           to(&BondSpec::mixed_mode_exponent)},
          {{.name = "stiffness",
            .kind = Kind::number,
            .range = within(1, 1000),
            .only_for = of_bonds,
            .doc = "Stiffness of the intact bond divided by that of the contact spring. Stiffer "
                   "bonds deform less but need smaller time steps.",
            .fallback_doc = "1 with the default `contact.stiffness`, otherwise 20"},
           to(&BondSpec::stiffness)}};
}

std::vector<Key<BondSpec>> bond_origin_keys() {
  return {{{.name = "reach",
            .kind = Kind::number,
            .range = within(0, 0.5),
            .fallback = value_of(0.01),
            .only_for = "initial",
            .doc = "Maximum distance between facing surfaces that are bonded, as a fraction of "
                   "the boundary edge length. In three dimensions surfaces that overlap are bonded "
                   "as well."},
           to(&BondSpec::reach)},
          {{.name = "inside",
            .kind = Kind::flag,
            .fallback = value_of(false),
            .only_for = "initial",
            .doc = "Restrict the bond to grains of the same particle, where it takes precedence "
                   "over other bonds of these materials.",
            .dimension = Dimension::two},
           flag_to(&BondSpec::inside)},
          {{.name = "weibull_modulus",
            .kind = Kind::number,
            .range = within(0.5, 1000),
            .only_for = "initial",
            .doc = "Weibull modulus: strengths and fracture energies of the bonds between two "
                   "neighbours are the given values times a random factor from a Weibull "
                   "distribution with this modulus and the scene's `seed`.",
            .fallback_doc = "no scatter"},
           to(&BondSpec::weibull_modulus)},
          {{.name = "threshold",
            .kind = Kind::quantity,
            .unit = "Pa",
            .range = within(0, 1e13),
            .required = true,
            .only_for = "pressed",
            .doc = "Contact pressure above which surfaces weld. The bond forms once the pressure "
                   "has fallen to half its maximum."},
           to(&BondSpec::threshold)},
          {{.name = "growth",
            .kind = Kind::number,
            .range = above(0, 100),
            .required = true,
            .only_for = "pressed",
            .doc = "Tensile strength gained per unit of pressure above the threshold, up to "
                   "`strength`; the other bond properties grow in proportion."},
           to(&BondSpec::growth)},
          {{.name = "work",
            .kind = Kind::quantity,
            .unit = "J/m^2",
            .range = above(0, 1e6),
            .required = true,
            .only_for = "adhesion",
            .doc = "Work of adhesion: energy per area needed to separate the surfaces."},
           to(&BondSpec::work)},
          {{.name = "range",
            .kind = Kind::quantity,
            .unit = "m",
            .range = within(smallest_size, largest_size),
            .required = true,
            .only_for = "adhesion",
            .doc = "Gap at which the attraction vanishes. The traction of surfaces in contact is "
                   "2 `work`/`range`."},
           to(&BondSpec::range)}};
}

std::vector<Key<BondSpec>> bond_keys() {
  std::vector<Key<BondSpec>> all{
      {{.name = "between",
        .kind = Kind::name_pair,
        .required = true,
        .doc = "Two materials, or a material and a tool; the two materials may be the same."},
       [](BondSpec& spec, const Decoded& value) {
         spec.first = value.names[0];
         spec.second = value.names[1];
       }},
      {{.name = "origin",
        .kind = Kind::choice,
        .choices = words_of<BondSpec::Origin>(
            {{"initial", "surfaces in contact at the start are bonded"},
             {"pressed", "bonds form under pressure (cold welding, sticking)"},
             {"adhesion", "no bonds: surfaces attract each other whenever they are close"}}),
        .required = true,
        .doc = "How the bond forms."},
       word_to(&BondSpec::origin)}};
  for (const auto& some : {bond_law_keys(), bond_origin_keys()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace

const TableDeclaration<BondSpec>& bond() {
  static const TableDeclaration<BondSpec> declaration{
      {"bond", true, "origin",
       "Bonds between two surfaces until they break: a cohesive law at the contact "
       "points. Broken bonds leave ordinary contact."},
      bond_keys()};
  return declaration;
}

}  // namespace pulvis::schema
