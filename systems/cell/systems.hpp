// Systems of the periodic cell, and of a die driven like one. What a system reads and writes is declared here.
#pragma once

#include "components/bundles.hpp"
#include "components/cell.hpp"
#include "components/servo.hpp"
#include "systems/ranks/reduce.hpp"

namespace pulvis {

struct cell_control {
  Read<Bodies> bodies;
  Read<Clock> clock;
  Read<ContactRules> rules;
  struct Borders {
    TouchingRows<Contact> rows;
    Read<ContactLaw<Contact>> law;
    Read<ContactImage> image;
  } borders;
  Read<KickWork> kick_work;
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
  NodalForces<Read> forces;
  Read<Density> density;
  Read<Position> position;
  Write<Velocity> velocity;
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
