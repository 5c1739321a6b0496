// Systems that observe the powder as a whole on sampled steps. What a system reads and writes is declared here and
// nowhere else; systems/step.cpp sets their order, and each is described at the top of its own file.
#pragma once

#include "components/bond.hpp"
#include "components/bundles.hpp"
#include "components/observed.hpp"
#include "systems/ranks/reduce.hpp"

namespace pulvis {

struct contact_network {
  Read<Bodies> bodies;
  Read<ContactIndex> index;
  Read<CurvePosition> control;
  Optional<TouchingPairs> pairs;
  Optional<TouchingTools> tools;
  Write<ContactNetwork<TwoD>> network;
  void operator()() const;
};

struct contact_quality {
  Read<Bodies> bodies;
  Read<ContactIndex> index;
  Read<CurvePosition> control;
  Optional<TouchingPairs> pairs;
  Optional<TouchingTools> tools;
  Write<ContactQuality> quality;
  Link link;
  void operator()() const;
};

template <class D>
struct force_chains {
  Read<Bodies> bodies;
  Read<ParticleStress<D>> stress;
  Read<ParticleCentre<D>> centre;
  Read<ContactNetwork<D>> network;
  Write<ForceChains> chains;
  void operator()() const;
};

template <class At>
struct BondedRows {
  Read<BondedPoints<At>> points;
  Read<BondLawNumber<At>> law;
  Read<ContactPair<At>> pair;
  Read<ContactLaw<At>> contact;
};
struct fragments {
  Read<Bodies> bodies;
  Optional<Read<BondRules>> rules;  // if contact is possible
  Read<BondTotals> totals;
  Optional<BondedRows<Contact>> pairs;
  Optional<BondedRows<ToolContact>> tools;
  Write<Fragments> found;
  void operator()() const;
};

struct local_density {
  Read<Bodies> bodies;
  Read<Position<TwoD>> position;
  Read<ToolPosition> tool_position;
  Write<DensityGrid> grid;
  void operator()() const;
};

}  // namespace pulvis
