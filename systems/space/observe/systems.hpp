// Systems that observe a powder in three dimensions as a whole, in sampled steps. Each declares here what it reads and
// writes; systems/step.cpp defines their order, and the descriptions are at the top of the individual files.
#pragma once

#include "components/observed.hpp"
#include "components/space/observed.hpp"
#include "systems/space/contact/systems.hpp"
#include "systems/space/tools/systems.hpp"

namespace pulvis::space {

struct TouchingTools {
  TouchingRows<FaceToolContact> rows;
  ToolSurfaces surfaces;
  Optional<ToolTriangles> triangles;
};

struct contact_network {
  ShapedBodies<ThreeD> bodies;
  Read<ContactIndex> index;
  Read<SurfacePosition> position;
  struct Pairs {
    Read<ContactPair<FaceContact>> pair;
    Read<ContactTouches<FaceContact>> touches;
    Read<ContactPoint> point;
    Read<ContactPointForce> force;
    Read<FacePairs> of;
    Optional<CellImages<ThreeD>> images;
  };
  Optional<Pairs> pairs;
  Optional<TouchingTools> tools;
  Write<ContactNetwork<ThreeD>> network;
  void operator()() const;
};

struct contact_quality {
  ShapedBodies<ThreeD> bodies;
  Read<ContactIndex> index;
  Read<SurfacePosition> position;
  struct Pairs {
    contact_force::Pairs rows;
    Read<ContactPoint> point;
    Optional<CellImages<ThreeD>> images;
  };
  Optional<Pairs> pairs;
  Optional<TouchingTools> tools;
  Write<ContactQuality> quality;
  Link link;
  void operator()() const;
};

template <class At>
struct BondedRows {
  Read<BondedPoints<At>> points;
  Read<ContactPair<At>> pair;
};
struct fragments {
  ShapedBodies<ThreeD> bodies;
  Optional<Read<BondRules>> rules;  // if contact is possible
  Read<BondTotals> totals;
  Optional<BondedRows<FaceContact>> pairs;
  Optional<BondedRows<FaceToolContact>> tools;
  Write<Fragments> found;
  void operator()() const;
};

struct local_density {
  ShapedBodies<ThreeD> bodies;
  Read<Position<ThreeD>> position;
  Read<ToolPosition> tool_position;
  Write<DensityGrid> grid;
  void operator()() const;
};

}  // namespace pulvis::space
