// Contact systems. What a system reads and writes is declared here and nowhere else; systems/step.cpp sets the order
// of the systems, and each is described at the top of its own file. D: the dimension (components/dimension.hpp).
#pragma once

#include <type_traits>

#include "components/bond.hpp"
#include "components/bundles.hpp"
#include "components/cell.hpp"
#include "components/hollow.hpp"
#include "components/shaped_bodies.hpp"
#include "components/space/tools.hpp"
#include "engine/look_ahead.hpp"
#include "systems/ranks/reduce.hpp"

namespace pulvis {

template <class D>
using ToolSurfacesIn = std::conditional_t<D::axes == 2, ToolSurfaces, space::ToolSurfaces>;

// ---- contact rows -------------------------------------------------------------------------------
template <class D>
struct skin_check {
  ShapedBodies<D> bodies;
  Read<Clock> clock;
  Read<typename D::OutlinePosition> position;
  Optional<ToolSurfacesIn<D>> tools;
  Optional<Read<PeriodicCell<D>>> cell;
  Write<typename D::OutlineBefore> before;
  Write<ContactIndex> index;
  Optional<BorderOutlines<typename D::OutlinePosition>> border;
  void operator()() const;
};

// The inputs of a row's contact laws.
struct ContactStiffness {
  Read<ContactRules> rules;
  Optional<Read<BondRules>> bonds;
  Read<BulkModulus> bulk;
  Read<Density> density;
};
// What is set when a row is created.
template <class At>
struct NewRows {
  Write<RowBlocks<At>> blocks;
  Write<ContactPair<At>> pair;
  Write<ContactLaw<At>> law;
  Write<ReactivationDistance<At>> activation;
  Optional<Write<SurfaceLawNumber<At>>> surface_law;
  Optional<Write<BondLawNumber<At>>> bond_law;
};

struct bin_edges {
  Read<Bodies> bodies;
  ContactStiffness material;
  struct Outlines {
    Read<CurvePosition> control;
    Optional<Read<PeriodicCell<TwoD>>> cell;
  } outlines;
  Write<ContactIndex> index;
  Structural<Contact> structure;
  NewRows<Contact> rows;
  Read<ContactTouches<Contact>> touches;
  struct Curves {
    Write<ContactPlace> place;
    Write<ClosestPoint> closest;
    Optional<Write<ContactImage<Contact>>> image;
  } curves;
  void operator()() const;
};

struct bin_tool_edges {
  Read<Bodies> bodies;
  ContactStiffness material;
  Read<CurvePosition> control;
  ToolSurfaces tools;
  Write<ContactIndex> index;
  Structural<ToolContact> structure;
  NewRows<ToolContact> rows;
  Optional<Write<SurfaceRange>> range;
  void operator()() const;
};

// ---- contact forces -------------------------------------------------------------------------------
// What the narrow phases read and write per row.
template <class At>
struct RowColumns {
  Read<ContactPair<At>> pair;
  struct State {
    Write<ContactTouches<At>> touches;
    Write<ReactivationDistance<At>> activation;
    Optional<Write<PointIndentation<At>>> indentation;  // where surfaces indent only
  } state;
  Read<ContactLaw<At>> law;
  Write<PointForce<At>> force;
  struct Sliding {  // scenes with friction only
    Write<ElasticSlip<At>> elastic_slip;
    Read<ContactRules> rules;
    Optional<Write<SlipWeakening<At>>> lost;  // of friction that is not just Coulomb's
  };
  Optional<Sliding> sliding;
  struct Bonding {                  // scenes with bonds only
    Read<BondedPoints<At>> bonded;  // handled by bond_forces
    Optional<Write<WeldPressure<At>>> weld;
  };
  Optional<Bonding> bonding;
  struct Surfaces {  // scenes with more than Coulomb friction only
    Read<SurfaceLawNumber<At>> number;
    Read<ContactRules> rules;
    const SurfaceLaws& of(Row<At> row) const {
      return entry(std::is_same_v<At, Contact> ? rules->pairs : rules->tool_pairs, number(row));
    }
  };
  Optional<Surfaces> surfaces;
};

// Which rows form a block, and the sums of each.
template <class At, class Sums>
struct SummedBlocks {
  Read<RowBlocks<At>> blocks;
  Write<Sums> sums;
};

struct edge_contact {
  Read<Bodies> bodies;
  Read<Clock> clock;
  ContactCurves curves;
  RowColumns<Contact> columns;
  struct Closest {
    Read<ContactPlace> place;
    Write<ClosestPoint> closest;
    Optional<Write<SlopeLoad>> slope_load;
  } points;
  Optional<CellImages<TwoD>> images;
  SummedBlocks<Contact, ContactSums<Contact>> summed;
  void operator()(SmallTasks) const;
};

struct contact_totals {
  Read<Clock> clock;
  Optional<Read<ContactSums<Contact>>> pairs;
  Optional<Read<ContactSums<ToolContact>>> tools;
  Write<Totals> totals;
  Link link;
  void operator()() const;
};

struct contact_force {
  Read<Bodies> bodies;
  Read<ContactIndex> index;
  struct Pairs {
    TouchingPairs touching;
    Read<ContactPlace> place;
    Optional<Read<SlopeLoad>> slope_load;
  };
  Optional<Pairs> pairs;
  Optional<TouchingRows<ToolContact>> tools;
  Write<CurveForce> curve_force;
  Write<ContactForce<TwoD>> node_force;
  void operator()(Chunk chunk) const;
};

struct contact_curve {
  Read<Bodies> bodies;
  Motion<TwoD> motion;
  Write<CurvePosition> position;
  Optional<Write<CurveVelocity>> velocity;
  Write<MaximumSpeed> speed;
  void operator()(Chunk chunk) const;
};

// ---- bonds --------------------------------------------------------------------------------------
template <class At>
struct BondColumns {
  Write<BondLawNumber<At>> law;
  Write<BondedPoints<At>> points;
  Read<BondOffset<At>> offset;
  Read<BondStrength<At>> strength;
  Write<BondDamage<At>> damage;
};
// What is set when bonds are created.
template <class At>
struct NewBonds {
  Read<ContactPair<At>> pair;
  Read<ContactTouches<At>> touches;
  Write<BondLawNumber<At>> law;
  Write<BondedPoints<At>> points;
  Write<BondOffset<At>> offset;
  Write<BondStrength<At>> strength;
};
struct PairAnchors {
  Read<ContactPlace> place;
  Read<ClosestPoint> closest;
  Write<CurveAnchor> anchor;
  Optional<CellImages<TwoD>> images;
};

struct initial_bonds {  // once, at the start
  Read<Bodies> bodies;
  Read<BondRules> rules;
  Read<CurvePosition> control;
  NewBonds<Contact> rows;
  PairAnchors at;
  Write<BondTotals> totals;
  void operator()() const;
};

struct initial_bond_totals {  // as above
  Write<BondTotals> totals;
  Write<RankLink> link;
  void operator()() const;
};

struct pressed_bonds {
  Read<BondRules> rules;
  NewBonds<Contact> rows;
  Write<WeldPressure<Contact>> pressure;
  PairAnchors at;
  void operator()(SmallTasks) const;
};

struct bond_forces {
  Read<Bodies> bodies;
  Read<Clock> clock;
  Read<BondRules> rules;
  ContactCurves curves;
  RowColumns<Contact> columns;
  BondColumns<Contact> bonds;
  struct Anchors {
    Read<ContactPlace> place;
    Read<CurveAnchor> anchor;
    Write<ClosestPoint> closest;
    Write<SlopeLoad> slope_load;
    Optional<CellImages<TwoD>> images;
  } at;
  SummedBlocks<Contact, BondSums<Contact>> summed;
  void operator()(SmallTasks) const;
};

struct bond_totals {
  Optional<Read<BondSums<Contact>>> pairs;
  Optional<Read<BondSums<ToolContact>>> tools;
  Write<BondTotals> bonds;
  Write<Totals> totals;
  Link link;
  void operator()() const;
};

// ---- health checks ----------------------------------------------------------------------------------
template <class At>
struct RowsInSum {
  Read<ContactPair<At>> pair;
  Read<ContactSums<typename At::Kind>> sums;
};

template <class D>
struct contact_health {
  ShapedBodies<D> bodies;
  Read<Clock> clock;
  Read<ContactRules> rules;
  Optional<RowsInSum<typename D::Contact>> pairs;
  Optional<RowsInSum<typename D::ToolContact>> tools;
  Optional<Read<ToolProgram>> program;
  Write<Totals> totals;
  Link link;
  void operator()() const;
};

struct lost_bodies {
  Read<Bodies> bodies;
  Read<Clock> clock;
  Read<ToolProgram> program;
  ToolSurfaces tools;
  Read<CurvePosition> curve;
  void operator()() const;
};

struct outline_health {
  Read<Bodies> bodies;
  Read<Clock> clock;
  Read<Position<TwoD>> position;
  Optional<Read<ContactRules>> rules;
  Optional<Read<Hollows>> hollows;
  void operator()() const;
};

}  // namespace pulvis
