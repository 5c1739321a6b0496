// Contact with tools in three dimensions. Their motion, reaction and servos are shared with two dimensions
// (systems/tools/systems.hpp).
#pragma once

#include "components/space/tools.hpp"
#include "systems/space/contact/systems.hpp"

namespace pulvis::space {

// If tools are meshes.
struct ToolTriangles {
  Read<TriangleRange> range;
  Read<TriangleLists> lists;
};

struct tool_contact {
  ShapedBodies<ThreeD> bodies;
  Read<Clock> clock;
  ContactFaces faces;
  struct Columns {
    Read<RowBlocks<FaceToolContact>> blocks;
    Read<ContactPair<FaceToolContact>> pair;
    Write<ContactTouches<FaceToolContact>> touches;
    Write<ReactivationDistance<FaceToolContact>> activation;
    Read<ContactLaw<FaceToolContact>> law;
    Write<PointForce<FaceToolContact>> force;
    Optional<Write<PointIndentation<FaceToolContact>>> indentation;  // only where surfaces indent
    struct Sliding {
      Optional<Write<ElasticSlip<FaceToolContact>>> slip;  // only with friction
      Optional<Write<SlipWeakening<FaceToolContact>>>
          lost;  // of friction that is not just Coulomb's
    } sliding;
  };
  Columns columns;
  Read<ContactRules> rules;
  struct Tools {
    ToolSurfaces surfaces;
    Read<ToolVelocity> velocity;
    Optional<ToolTriangles> triangles;
  };
  Tools tools;
  struct Bonds {
    BondColumns<FaceToolContact> columns;
    Write<ToolAnchor> anchor;
    Write<BondSums<ToolContact>> sums;
  };
  Optional<Bonds> bonds;
  Write<ContactSums<ToolContact>> sums;
  void operator()(SmallTasks) const;
};

struct initial_tool_bonds {
  ShapedBodies<ThreeD> bodies;
  Read<SurfacePosition> position;
  ToolSurfaces tools;
  Optional<ToolTriangles> triangles;
  NewBonds<FaceToolContact> rows;
  Write<ToolAnchor> anchor;
  Write<ReactivationDistance<FaceToolContact>> activation;
  Write<BondTotals> totals;
  void operator()() const;
};

}  // namespace pulvis::space
