// The deformable bodies of a world: tables and columns, and their initial values.
#pragma once

#include <optional>
#include <vector>

#include "components/run_state.hpp"
#include "components/shape.hpp"
#include "components/space/shape.hpp"
#include "engine/world.hpp"
#include "scenes/layout.hpp"
#include "scenes/needs.hpp"
#include "scenes/solid_layout.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Adds the node, element and particle columns that the materials and formulation need. Requires Bodies::slots.
void add_body_columns(World& world, const Layout& layout, const Needs& needs);
void add_body_columns(World& world, const space::Layout& layout, const Needs& needs);

// Positions and velocities. In empty slots the mesh rests at the origin.
void fill_bodies(World& world, const Layout& layout);
void fill_bodies(World& world, const space::Layout& layout);

void fill_materials(World& world, const Scene& scene, const Bodies& bodies);

// At every node.
void add_inerters(World& world, const ContactRules& rules);

// For materials without a flow law: linear hardening, whose constants are in columns.
void add_flow_laws(World& world, const Scene& scene, const Needs& needs);

// Clock and totals.
void add_run_state(World& world, const Scene& scene);

}  // namespace pulvis
