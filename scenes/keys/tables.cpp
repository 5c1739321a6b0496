#include "scenes/keys/tables.hpp"

namespace pulvis::schema {

namespace {

// Its names are defined by the user (scenes/let).
TableView variables() {
  return {{"let", false, "",
           "Variables: user-defined names for numbers and quantities, `D = \"24 mm\"`, `n "
           "= 10`, or expressions in other variables, `gap = \"D/200\"` (see above).",
           every_family, true},
          {}};
}

}  // namespace

const Language& scene_language() {
  static const Language tables{
      view_of(top_level()), variables(),       view_of(material()), view_of(material_damping()),
      view_of(hardening()), view_of(rate()),   view_of(particle()), view_of(mesh()),
      view_of(grains()),    view_of(body()),   view_of(packing()),  view_of(mixture_class()),
      view_of(die()),       view_of(cell()),   view_of(tool()),     view_of(stage()),
      view_of(move()),      view_of(servo()),  view_of(until()),    view_of(cell_drive()),
      view_of(friction()),  view_of(bond()),   view_of(contact()),  view_of(element()),
      view_of(time()),      view_of(output()), view_of(limits()),   view_of(lever()),
      view_of(tip()),       view_of(laser()),  view_of(detector()), view_of(surface()),
      view_of(action()),    view_of(expect())};
  return tables;
}

}  // namespace pulvis::schema
