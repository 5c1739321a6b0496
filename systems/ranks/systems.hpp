// Systems of a run on several ranks: borders, and the data sent across them. What a system reads and writes is
// declared here and nowhere else; systems/step.cpp sets their order.
#pragma once

#include "components/bond.hpp"
#include "components/bundles.hpp"
#include "components/space/bond.hpp"
#include "components/space/contact.hpp"
#include "systems/ranks/border.hpp"
#include "systems/ranks/reduce.hpp"

namespace pulvis {

// What other ranks know of the outlines.
template <class D>
struct OutlineColumns {
  Write<typename D::OutlinePosition> position;
  Optional<Write<typename D::OutlineVelocity>> velocity;
  Optional<Write<SurfaceHardness<D>>> hardness;
  Optional<Write<space::SurfaceMotion>> motion;  // in three dimensions

  std::vector<Outlines> all() const {
    std::vector<Outlines> columns{position};
    if (velocity) columns.emplace_back(*velocity);
    if (hardness) columns.emplace_back(*hardness);
    if (motion) columns.emplace_back(*motion);
    return columns;
  }
};

// ---- when the rows are rebuilt --------------------------------------------------------------------
template <class D>
struct find_border {
  Read<ContactIndex> index;
  Optional<Read<PeriodicCell<D>>> cell;
  Write<Bodies> bodies;
  OutlineColumns<D> outlines;
  Write<typename D::OutlineBefore> before;
  Write<RankLink> link;
  void operator()() const;
};

struct list_border_rows {
  Read<Bodies> bodies;
  Read<ContactIndex> index;
  Read<ContactPair<Contact>> pair;
  Write<ReactivationDistance<Contact>> activation;
  Optional<Write<BondedPoints<Contact>>> bonded;
  Optional<Write<WeldPressure<Contact>>> weld_pressure;
  Write<RankLink> link;
  void operator()() const;
  void list() const;  // whether rows are due or not

 private:
  void rest(Row<Contact> row) const;
};

struct list_border_pairs {
  Read<Bodies> bodies;
  Read<ContactIndex> index;
  Read<ContactPair<FaceContact>> pair;
  Read<space::FacePairs> pairs;
  Write<space::ReactivationDistance<FaceContact>> activation;
  Optional<Write<space::BondedPoints<FaceContact>>> bonded;
  Optional<Write<space::WeldPressure<FaceContact>>> weld_pressure;
  Write<RankLink> link;
  void operator()() const;
  void list() const;  // whether rows are due or not

 private:
  void rest(Row<FaceContact> row) const;
};

// ---- in every step ----------------------------------------------------------------------------------
template <class D>
struct send_outlines {
  Read<Bodies> bodies;
  OutlineColumns<D> outlines;
  Write<RankLink> link;
  void operator()() const;
};

template <class D>
struct receive_outlines {
  Read<Bodies> bodies;
  OutlineColumns<D> outlines;
  Write<RankLink> link;
  void operator()(SmallTasks) const;
};

// The effect of a row on its other particle.
struct RowsAcross {
  Write<ContactTouches<Contact>> touches;
  Write<PointForce<Contact>> force;
  Write<ClosestPoint> closest;
  Optional<Write<SlopeLoad>> slope_load;
};
struct send_contacts {
  RowsAcross rows;
  Write<RankLink> link;
  void operator()() const;
};
struct receive_contacts {
  RowsAcross rows;
  Write<RankLink> link;
  void operator()(SmallTasks) const;
};

struct send_loads {
  Write<space::PairLoads> loads;
  Write<RankLink> link;
  void operator()() const;
};
struct receive_loads {
  Write<space::PairLoads> loads;
  Write<RankLink> link;
  void operator()(SmallTasks) const;
};

}  // namespace pulvis
