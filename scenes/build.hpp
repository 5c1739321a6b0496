// From a scene to the world that its systems run in: tables, and the columns that the scene asks for.
#pragma once

#include <memory>

#include "components/run_state.hpp"
#include "engine/world.hpp"
#include "scenes/scene.hpp"

namespace pulvis {

// What a scene needs: decides which columns (and with them which systems) exist.
struct Needs {
  bool plastic = false;  // a material yields
  bool pairs = false;    // more than one particle
  bool tools = false;    // something that particles touch
  bool polylines = false;
  bool grips = false;
  bool friction = false;      // a coefficient above zero can act
  bool weakening = false;     // and a law beyond Coulomb's
  bool damping = false;       // of contacts
  bool bulk_damping = false;  // of a material
  ElementSpec::Formulation formulation = ElementSpec::Formulation::one_point;
  bool contact() const { return pairs || tools; }
};

Needs needs_of(const Scene& scene, std::size_t particles);

// Places the particles, checks that they have room (throws SceneError), and fills a world.
std::unique_ptr<World> build_world(const Scene& scene);

// Coulomb coefficient between two materials, or a material and a tool.
ContactRules::Friction friction_of(const Scene& scene, const std::string& a, const std::string& b);

}  // namespace pulvis
