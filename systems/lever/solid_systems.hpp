// The systems of the quasi-static solver; each is described at the top of its own file.
#pragma once

#include "components/probe.hpp"
#include "components/solid.hpp"
#include "engine/access.hpp"
#include "systems/lever/solid_equations.hpp"

namespace pulvis {

struct FlowLaws;  // systems/laws/flow_law.hpp

void solid_element(Chunk chunk, Read<SolidMesh> mesh, Read<ReferencePosition> reference,
                   Read<Displacement> displacement, Read<LameConstants> elastic,
                   Optional<Read<SolidYield>> yield, Optional<Read<FlowLaws>> laws,
                   Optional<Read<SolidMemory>> memory, Write<ElementForce> force,
                   Write<ElementTangent> tangent, Write<ElementEnergy> energy);
void element_force(Chunk chunk, Read<SolidMesh> mesh, Read<ReferencePosition> reference,
                   Read<Displacement> displacement, Read<LameConstants> elastic,
                   Optional<Read<SolidYield>> yield, Optional<Read<FlowLaws>> laws,
                   Optional<Read<SolidMemory>> memory, Write<ElementForce> force,
                   Write<ElementEnergy> energy);
void solid_tetrahedron(Chunk chunk, Read<SolidMesh> mesh, Read<ReferencePosition> reference,
                       Read<Displacement> displacement, Read<TetrahedronLame> elastic,
                       Write<TetrahedronForce> force, Write<TetrahedronTangent> tangent,
                       Write<TetrahedronEnergy> energy);
void tetrahedron_force(Chunk chunk, Read<SolidMesh> mesh, Read<ReferencePosition> reference,
                       Read<Displacement> displacement, Read<TetrahedronLame> elastic,
                       Write<TetrahedronForce> force, Write<TetrahedronEnergy> energy);
void commit_plasticity(Chunk chunk, Read<SolidMesh> mesh, Read<ReferencePosition> reference,
                       Read<Displacement> displacement, Read<LameConstants> elastic,
                       Read<SolidYield> yield, Optional<Read<FlowLaws>> laws,
                       Write<SolidMemory> memory);
void solid_force(Read<SolidAssembly> assembly, Read<ElementForce> element,
                 Optional<Read<TetrahedronForce>> tetrahedron, Write<SolidForce> force);
void block_tangent(Read<SolidAssembly> assembly, Read<ElementTangent> element,
                   Optional<Read<TetrahedronTangent>> tetrahedron, Write<BlockTangent> block);
void probe_contact(Read<ReferencePosition> reference, Read<Displacement> displacement,
                   Read<Target> target, Read<ProbeNode> node, Read<ProbeStiffness> stiffness,
                   Read<ProbeShare> share, Read<ProbeMemory> memory, Read<ProbeForce> force,
                   Write<ProbeState> state);
void commit_contact(Read<ReferencePosition> reference, Read<Displacement> displacement,
                    Read<Target> target, Read<ProbeNode> node, Read<ProbeForce> force,
                    Read<ProbeState> state, Write<ProbeMemory> memory);
void residual(Read<SolidMesh> mesh, Read<ElementForce> element,
              Optional<Read<TetrahedronForce>> tetrahedron, Read<SolidForce> force,
              Read<AppliedForce> applied, Optional<Read<Target>> target,
              Optional<Read<ProbeNode>> node, Optional<Read<ProbeForce>> probe,
              Optional<Read<ProbeState>> state, Write<SolidEquations> equations);
void factorise(Read<SolidAssembly> assembly, Read<BlockTangent> block,
               Write<SolidEquations> equations);
void factorise_extended(Read<SolidAssembly> assembly, Read<SolidMesh> mesh,
                        Read<ReferencePosition> reference, Read<Displacement> displacement,
                        Read<LameConstants> elastic, Optional<Read<TetrahedronLame>> tetrahedron,
                        Optional<Read<SolidYield>> yield, Optional<Read<FlowLaws>> laws,
                        Optional<Read<SolidMemory>> memory, Write<SolidEquations> equations);
void newton_direction(Write<SolidEquations> equations);
void contact_direction(Read<SolidMesh> mesh, Read<Target> target, Read<ReferencePosition> reference,
                       Read<Displacement> displacement, Read<ProbeNode> node,
                       Read<ProbeStiffness> stiffness, Read<ProbeShare> share,
                       Read<ProbeMemory> memory, Read<ProbeForce> force, Read<ProbeState> state,
                       Write<SolidEquations> equations);

}  // namespace pulvis
