// Declaration of bonds: what holds together until it breaks.
#include "scenes/keys/declare.hpp"
#include "scenes/keys/tables.hpp"

namespace pulvis::schema {
namespace {

const Words of_bonds{"initial", "pressed"};  // not of adhesion, which has no memory

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
  return {
      {{.name = "strength",
        .kind = Kind::quantity,
        .unit = "Pa",
        .range = above(0, 1e13),
        .required = true,
        .only_for = of_bonds,
        .doc = "Tensile stress at which the bond begins to break; of a pressed bond the largest "
               "that it reaches."},
       to(&BondSpec::strength)},
      strength_key("shear_strength", &BondSpec::shear_strength,
                   "Shear stress at which it begins to break."),
      {{.name = "fracture_energy",
        .kind = Kind::quantity,
        .unit = "J/m^2",
        .range = above(0, 1e9),
        .required = true,
        .only_for = of_bonds,
        .doc = "Energy that opening it takes, per area (mode I)."},
       to(&BondSpec::fracture_energy)},
      {{.name = "shear_fracture_energy",
        .kind = Kind::quantity,
        .unit = "J/m^2",
        .range = above(0, 1e9),
        .only_for = of_bonds,
        .doc = "Energy that shearing it off takes, per area (mode II).",
        .fallback_doc = "`fracture_energy`"},
       to(&BondSpec::shear_fracture_energy)},
      {{.name = "mixed_mode_exponent",
        .kind = Kind::number,
        .range = within(0.5, 10),
        .fallback = value_of(2.0),
        .only_for = of_bonds,
        .doc = "Eta of Benzeggagh and Kenane: how strength and energy go from opening to "
               "shear."},
       to(&BondSpec::mixed_mode_exponent)},
      {{.name = "stiffness",
        .kind = Kind::number,
        .range = within(1, 1000),
        .fallback = value_of(20.0),
        .only_for = of_bonds,
        .doc = "Stiffness of the unbroken bond over that of the contact spring. Stiffer bonds "
               "give less and ask for shorter time steps."},
       to(&BondSpec::stiffness)}};
}

std::vector<Key<BondSpec>> bond_origin_keys() {
  return {
      {{.name = "reach",
        .kind = Kind::number,
        .range = within(0, 0.5),
        .fallback = value_of(0.01),
        .only_for = "initial",
        .doc = "Share of the boundary edge within which surfaces that face each other are "
               "bonded."},
       to(&BondSpec::reach)},
      {{.name = "inside",
        .kind = Kind::flag,
        .fallback = value_of(false),
        .only_for = "initial",
        .doc = "Only between grains of one particle, where it goes before another bond of these "
               "materials."},
       flag_to(&BondSpec::inside)},
      {{.name = "weibull_modulus",
        .kind = Kind::number,
        .range = within(0.5, 1000),
        .only_for = "initial",
        .doc = "Strengths and fracture energies of the bonds between two neighbours are a share "
               "of those given, drawn from a Weibull law with this modulus and the scene's "
               "`seed`.",
        .fallback_doc = "all alike"},
       to(&BondSpec::weibull_modulus)},
      {{.name = "threshold",
        .kind = Kind::quantity,
        .unit = "Pa",
        .range = within(0, 1e13),
        .required = true,
        .only_for = "pressed",
        .doc = "Contact pressure from which on surfaces weld. The bond holds once the pressure "
               "has fallen to half of its largest."},
       to(&BondSpec::threshold)},
      {{.name = "growth",
        .kind = Kind::number,
        .range = above(0, 100),
        .required = true,
        .only_for = "pressed",
        .doc = "Tensile strength gained over pressure beyond the threshold, up to `strength`; "
               "the other values grow along."},
       to(&BondSpec::growth)},
      {{.name = "work",
        .kind = Kind::quantity,
        .unit = "J/m^2",
        .range = above(0, 1e6),
        .required = true,
        .only_for = "adhesion",
        .doc = "Work of adhesion: what parting the surfaces takes, per area."},
       to(&BondSpec::work)},
      {{.name = "range",
        .kind = Kind::quantity,
        .unit = "m",
        .range = within(smallest_size, largest_size),
        .required = true,
        .only_for = "adhesion",
        .doc = "Gap at which the attraction has faded. The traction of surfaces that touch is "
               "2 `work`/`range`."},
       to(&BondSpec::range)}};
}

std::vector<Key<BondSpec>> bond_keys() {
  std::vector<Key<BondSpec>> all{
      {{.name = "between",
        .kind = Kind::name_pair,
        .required = true,
        .doc = "Two materials, or a material and a tool; a material may meet itself."},
       [](BondSpec& spec, const Decoded& value) {
         spec.first = value.names[0];
         spec.second = value.names[1];
       }},
      {{.name = "origin",
        .kind = Kind::choice,
        .choices = {{"initial", "what touches at the start is bonded"},
                    {"pressed", "pressure makes the bond (cold welding, sticking)"},
                    {"adhesion", "none: surfaces attract each other whenever they are near"}},
        .required = true,
        .doc = "What makes the bond."},
       [](BondSpec& spec, const Decoded& value) {
         spec.origin = static_cast<BondSpec::Origin>(value.index);
       }}};
  for (const auto& some : {bond_law_keys(), bond_origin_keys()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace

const TableDeclaration<BondSpec>& bond() {
  static const TableDeclaration<BondSpec> declaration{
      {"bond", true, "origin",
       "Surfaces of one pair that hold together until they break: a cohesive law at the contact "
       "points. What is broken is plain contact."},
      bond_keys()};
  return declaration;
}

}  // namespace pulvis::schema
