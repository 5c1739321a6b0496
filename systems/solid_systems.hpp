// The systems of the quasi-static solver; each is described at the top of its own file.
#pragma once

#include "components/solid.hpp"
#include "engine/access.hpp"
#include "systems/solid_equations.hpp"

namespace pulvis {

void solid_element(Chunk chunk, Read<SolidMesh> mesh, Read<ReferencePosition> reference,
                   Read<Displacement> displacement, Read<LameConstants> elastic,
                   Write<ElementForce> force, Write<ElementTangent> tangent,
                   Write<ElementEnergy> energy);
void solid_force(Read<SolidAssembly> assembly, Read<ElementForce> element, Write<SolidForce> force);
void block_tangent(Read<SolidAssembly> assembly, Read<ElementTangent> element,
                   Write<BlockTangent> block);
void residual(Read<SolidMesh> mesh, Read<SolidForce> force, Read<AppliedForce> applied,
              Write<SolidEquations> equations);
void factorise(Read<SolidAssembly> assembly, Read<BlockTangent> block,
               Write<SolidEquations> equations);
void newton_direction(Write<SolidEquations> equations);

}  // namespace pulvis
