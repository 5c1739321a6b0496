// Systems of the periodic cell, and of a die driven like one. What a system reads and writes is declared here.
// D: the dimension (components/dimension.hpp).
#pragma once

#include "components/bundles.hpp"
#include "components/cell.hpp"
#include "components/servo.hpp"
#include "systems/ranks/reduce.hpp"
#include "systems/space/contact/systems.hpp"

namespace pulvis {

// The contacts between particles with their forces: a row has them in the plane; in space the narrow phase leaves those of a
// pair's touching points in a list.
template <class D>
struct ForcedPairs;
template <>
struct ForcedPairs<TwoD> {
  TouchingRows<Contact> rows;
};
template <>
struct ForcedPairs<ThreeD> {
  space::contact_force::Pairs rows;
};

template <class D>
struct cell_load {
  ShapedBodies<D> bodies;
  Read<Clock> clock;
  struct Contacts {
    Read<ContactIndex> index;
    Read<ContactRules> rules;
    ForcedPairs<D> pairs;
    Read<ContactLaw<typename D::Contact>> law;
  } contacts;
  Read<Position<D>> position;
  Read<ContactForce<D>> force;
  struct Load {
    Write<MassCentre<D>> centre;
    Write<NetForce<D>> force;
    Write<StrainResistance> resistance;
  } load;
  void operator()(Chunk chunk) const;
};

template <class D>
struct cell_control {
  Read<Bodies> bodies;
  Read<Clock> clock;
  struct Borders {
    ForcedPairs<D> pairs;
    Read<ContactImage<typename D::Contact>> image;
  } borders;
  struct Particles {
    Read<MassCentre<D>> centre;
    Read<NetForce<D>> force;
    Read<StrainResistance> resistance;
    Read<KickWork> kick_work;
  } particles;
  Read<ToolProgram> program;
  struct Control {
    Write<PeriodicCell<D>> cell;
    Write<Totals> totals;
  } control;
  Link link;
  void operator()() const;
};

template <class D>
struct cell_kick {
  ShapedBodies<D> bodies;
  Read<Clock> clock;
  Read<PeriodicCell<D>> cell;
  NodalForces<Read, D> forces;
  Read<Density> density;
  struct Place {
    Read<Position<D>> position;
    Read<MassCentre<D>> centre;
  } place;
  Write<Velocity<D>> velocity;
  Write<KickWork> work;
  void operator()(Chunk chunk) const;
};

template <class D>
struct cell_motion {
  Read<Clock> clock;
  Write<PeriodicCell<D>> cell;
  void operator()() const;
};

template <class D>
struct wall_control {
  ShapedBodies<D> bodies;
  Read<Clock> clock;
  Read<ContactRules> rules;
  Read<ToolProgram> program;
  struct Contacts {
    TouchingRows<typename D::ToolContact> rows;
    Read<ContactLaw<typename D::ToolContact>> law;
  } contacts;
  Read<ToolPosition> position;
  Read<ToolForce> force;
  struct Drive {
    Write<DrivenWalls> walls;
    Write<ServoVelocity> velocity;
    Link link;
  } drive;
  void operator()() const;
};

}  // namespace pulvis
