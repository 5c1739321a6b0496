// Systems of the periodic cell, and of a die driven like one. What a system reads and writes is declared here.
#pragma once

#include "components/bundles.hpp"
#include "components/cell.hpp"
#include "components/servo.hpp"
#include "systems/ranks/reduce.hpp"

namespace pulvis {

struct cell_load {
  Read<Bodies> bodies;
  Read<Clock> clock;
  struct Contacts {
    Read<ContactIndex> index;
    Read<ContactRules> rules;
    TouchingRows<Contact> rows;
    Read<ContactLaw<Contact>> law;
  } contacts;
  Read<Position<TwoD>> position;
  Read<ContactForce<TwoD>> force;
  struct Load {
    Write<MassCentre> centre;
    Write<NetForce> force;
    Write<StrainResistance> resistance;
  } load;
  void operator()(Chunk chunk) const;
};

struct cell_control {
  Read<Bodies> bodies;
  Read<Clock> clock;
  struct Borders {
    TouchingRows<Contact> rows;
    Read<ContactImage> image;
  } borders;
  struct Particles {
    Read<MassCentre> centre;
    Read<NetForce> force;
    Read<StrainResistance> resistance;
    Read<KickWork> kick_work;
  } particles;
  Read<ToolProgram> program;
  struct Control {
    Write<PeriodicCell> cell;
    Write<Totals> totals;
  } control;
  Link link;
  void operator()() const;
};

struct cell_kick {
  Read<Bodies> bodies;
  Read<Clock> clock;
  Read<PeriodicCell> cell;
  NodalForces<Read, TwoD> forces;
  Read<Density> density;
  struct Place {
    Read<Position<TwoD>> position;
    Read<MassCentre> centre;
  } place;
  Write<Velocity<TwoD>> velocity;
  Write<KickWork> work;
  void operator()(Chunk chunk) const;
};

struct wall_control {
  Read<Clock> clock;
  Read<ContactRules> rules;
  Read<ToolProgram> program;
  TouchingRows<ToolContact> contacts;
  Read<ContactLaw<ToolContact>> law;
  Read<ToolPosition> position;
  Read<ToolForce> force;
  struct Drive {
    Write<DrivenWalls> walls;
    Write<ServoVelocity> velocity;
    Link link;
  } drive;
  void operator()() const;
};

struct cell_motion {
  Read<Clock> clock;
  Write<PeriodicCell> cell;
  void operator()() const;
};

}  // namespace pulvis
