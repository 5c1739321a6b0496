// What a scene requires of the model.
#pragma once

#include "scenes/spec/scene.hpp"

namespace pulvis {

// What a scene requires: decides which columns (and with them which systems) exist.
struct Needs {
  bool plastic = false;    // a material yields
  bool flow_laws = false;  // and one hardens along a curve or is rate-dependent
  bool pairs = false;      // more than one particle, or one that tools can fold onto itself
  bool tools = false;      // something that particles touch
  bool polylines = false;
  bool constraints = false;
  bool friction = false;       // a coefficient above zero can take effect
  bool weakening = false;      // and a law beyond Coulomb's
  bool indentation = false;    // surfaces indent
  bool inerters = false;       // at the boundaries
  bool cell = false;           // periodic
  bool initial_bonds = false;  // between particles
  bool tool_initial_bonds = false;
  bool welds = false;  // formed by pressure, between particles
  bool tool_welds = false;
  bool adhesion = false;      // surfaces attract each other
  bool damping = false;       // of contacts
  bool bulk_damping = false;  // of a material
  Formulation formulation = Formulation::one_point;
  bool bonds() const { return initial_bonds || welds; }
  bool tool_bonds() const { return tool_initial_bonds || tool_welds; }
  bool any_bonds() const { return bonds() || tool_bonds(); }
  bool contact() const { return pairs || tools; }
};

Needs needs_of(const Scene& scene, std::size_t particles);

}  // namespace pulvis
