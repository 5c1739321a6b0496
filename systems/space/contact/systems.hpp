// Systems for contact of surfaces in three dimensions. Each declares here what it reads and writes;
// systems/step.cpp defines their order, and the descriptions are at the top of the individual files.
#pragma once

#include "components/body.hpp"
#include "components/bundles.hpp"
#include "components/space/bond.hpp"
#include "components/space/contact.hpp"
#include "components/space/tools.hpp"
#include "systems/ranks/reduce.hpp"

namespace pulvis::space {

// ---- surfaces -----------------------------------------------------------------------------------
struct contact_surface {
  ShapedBodies<ThreeD> bodies;
  Motion<ThreeD> motion;
  struct Nets {
    Write<NetPosition> position;
    Write<NetVelocity> velocity;
  };
  Nets nets;
  Write<SurfacePosition> position;
  Optional<Write<SurfaceVelocity>> velocity;
  Write<MaximumSpeed> speed;
  Write<SurfaceMotion> surface_motion;
  Write<Roughness> roughness;
  void operator()(Chunk chunk) const;
};

// Where the surface nodes are, and their points of the smooth surface (node_springs.hpp).
struct NodesOfSurface {
  Read<Position<ThreeD>> nodes;
  Read<SurfacePosition> surface;
  Read<BulkModulus> bulk;
  Read<Roughness> roughness;

  bool any_rough(Chunk chunk) const {
    return (roughness.chunk(chunk)(Row<Particle>()) > 0.0).bits() != 0;
  }
};

// Adds to the elastic energy of the particles, in sampled steps.
struct node_spring_energy {
  ShapedBodies<ThreeD> bodies;
  NodesOfSurface nodes;
  Write<ElasticEnergy> energy;
  void operator()(Chunk chunk) const;
};

// In sampled steps.
struct node_distance {
  ShapedBodies<ThreeD> bodies;
  NodesOfSurface nodes;
  Write<NodeDistance> distance;
  void operator()(Chunk chunk) const;
};

// ---- contact rows -------------------------------------------------------------------------------
// Input of the contact laws of a row.
struct ContactStiffness {
  Read<ContactRules> rules;
  Read<BulkModulus> bulk;
  Read<Density> density;
  Optional<Read<BondRules>> bonds;
};
// What is set when a row is created.
template <class At>
struct NewRows {
  Write<ContactPair<At>> pair;
  Write<ContactLaw<At>> law;
  Write<ReactivationDistance<At>> activation;
};

struct bin_faces {
  ShapedBodies<ThreeD> bodies;
  ContactStiffness material;
  Read<SurfacePosition> position;
  Write<ContactIndex> index;
  Structural<FaceContact> structure;
  NewRows<FaceContact> rows;
  Write<ContactPoint> point;
  struct Pairs {
    Write<FacePairs> list;
    Optional<Read<PeriodicCell<ThreeD>>> cell;
    Optional<Write<ContactImage<FaceContact>>> image;
  } pairs;
  void operator()() const;
};

struct bin_tool_faces {
  ShapedBodies<ThreeD> bodies;
  ContactStiffness material;
  Read<SurfacePosition> position;
  ToolSurfaces tools;
  Write<ContactIndex> index;
  Structural<FaceToolContact> structure;
  struct Rows {
    NewRows<FaceToolContact> columns;
    Write<RowBlocks<FaceToolContact>> blocks;
  } rows;
  struct Triangles {
    Write<TriangleRange> range;
    Write<TriangleLists> lists;
  };
  Optional<Triangles> triangles;
  void operator()() const;
};

// ---- bonds ----------------------------------------------------------------------------------------
template <class At>
struct BondColumns {
  Write<BondedPoints<At>> points;
  Read<BondRules> rules;
  Write<BondDamage<At>> damage;
  Write<BondStrength<At>> strength;
  Optional<Write<BondOffset<At>>> offset;
  Optional<Write<WeldPressure<At>>> weld;
};

// Bonds that exist from the start.
template <class At>
struct NewBonds {
  Read<BondRules> rules;
  Read<ContactPair<At>> pair;
  Write<BondedPoints<At>> points;
  Write<BondStrength<At>> strength;
  Write<BondOffset<At>> offset;

  void make(Row<At> row, int g, double share, double opening) const {
    points(row, BondedPoints<At>::all) |= 1 << g;
    strength(row, g) = share;
    offset(row, g) = opening;
  }
};
struct initial_bonds {
  ShapedBodies<ThreeD> bodies;
  Read<SurfacePosition> position;
  Read<ContactPoint> point;
  Optional<CellImages<ThreeD>> images;
  NewBonds<FaceContact> rows;
  Write<ReactivationDistance<FaceContact>> activation;
  Write<BondTotals> totals;
  void operator()() const;
};

// ---- contact forces -------------------------------------------------------------------------------
struct ContactFaces {
  Read<SurfacePosition> position;
  Optional<Read<SurfaceVelocity>> velocity;          // only with friction or damping
  Optional<Read<SurfaceHardness<ThreeD>>> hardness;  // only where surfaces indent
};

struct face_contact {
  ShapedBodies<ThreeD> bodies;
  Read<Clock> clock;
  ContactFaces faces;
  struct Columns {
    Read<ContactPair<FaceContact>> pair;
    Write<ContactTouches<FaceContact>> touches;
    struct Travel {
      Read<SurfaceMotion> of_surfaces;
      Write<RowTravel> of_row;
    } travel;
    Write<ReactivationDistance<FaceContact>> activation;
    Read<ContactLaw<FaceContact>> law;
    struct Points {
      Write<ContactPoint> numbers;
      Optional<Write<PointIndentation<FaceContact>>> indentation;  // only where surfaces indent
      Optional<Write<ContactPointForce>> force;
      Optional<Write<SlipWeakening<FaceContact>>> lost;  // of friction that is not just Coulomb's
    } points;
    struct Bonds {
      BondColumns<FaceContact> columns;
      Write<BondSums<Contact>> sums;
    };
    Optional<Bonds> bonds;
    Optional<CellImages<ThreeD>> images;
  };
  Columns columns;
  Read<ContactRules> rules;
  Read<FacePairs> pairs;
  Write<PairLoads> loads;
  Write<ContactSums<Contact>> sums;
  void operator()(SmallTasks) const;
};

struct contact_force {
  ShapedBodies<ThreeD> bodies;
  Read<ContactIndex> index;
  struct Pairs {
    Read<ContactPair<FaceContact>> pair;
    Read<ContactTouches<FaceContact>> touches;
    Read<ReactivationDistance<FaceContact>> activation;
    Read<FacePairs> of;
    Read<PairLoads> loads;
  };
  Optional<Pairs> pairs;
  Optional<TouchingRows<FaceToolContact>> tools;
  NodesOfSurface nodes;
  struct Loads {
    Write<FaceForce> face;
    Write<PointLoad> point;
    Write<NetLoad> net;
  };
  Loads loads;
  Write<ContactForce<ThreeD>> node_force;
  void operator()(Chunk chunk) const;
};

}  // namespace pulvis::space
