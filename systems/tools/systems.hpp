// Systems of the tools, and of the clock. What a system reads and writes is declared here and
// nowhere else; systems/step.cpp sets their order, and each is described at the top of its own file.
// D: the dimension (components/dimension.hpp).
#pragma once

#include "components/bundles.hpp"
#include "components/servo.hpp"
#include "components/shaped_bodies.hpp"
#include "systems/contact/systems.hpp"

namespace pulvis {

// ---- tool motion ----------------------------------------------------------------------------------
struct tool_motion {
  Read<Clock> clock;
  Read<ToolProgram> program;
  Optional<Read<ServoVelocity>> servo;
  Optional<Write<ServoTravel>> servo_travel;
  Write<ToolPosition> position;
  Write<ToolVelocity> velocity;
  void operator()() const;
};

template <class D>
struct stage_control {
  Read<Clock> clock;
  struct Tools {
    Read<ToolPosition> position;
    Read<ToolForce> force;
  };
  Optional<Tools> tools;
  struct Drives {  // walls that are driven like a cell have the velocity alone
    Read<ToolServos> servos;
    Read<ServoVelocity> velocity;
  };
  Optional<Drives> drives;
  Optional<Write<PeriodicCell<D>>> cell;
  Optional<Write<DrivenWalls>> walls;
  Write<StageEnds> ends;
  Write<ToolProgram> program;
  void operator()() const;
};

// Inputs and outputs of the servos, in any dimension.
struct Servos {
  Read<Clock> clock;
  Read<ToolProgram> program;
  Optional<Read<StageEnds>> ends;
  Read<ToolForce> force;
  Read<ContactRules> rules;
  Write<ToolServos> servos;
  struct Drive {
    Read<ServoTravel> travel;
    Write<ServoMass> mass;
    Write<ServoVelocity> velocity;
    Write<ServoDragged> dragged;
    Write<ServoForce> asked;
  } drive;
};

template <class D>
struct tool_servo {
  Servos servos;
  ShapedBodies<D> bodies;
  TouchingRows<typename D::ToolContact> rows;
  Read<ContactLaw<typename D::ToolContact>> law;
  Link link;
  void operator()() const;
};

// Programmed position of a tool at `time`, m. Also used outside the step.
Point3 tool_position_at(const ToolProgram& program, int tool, double time);

// ---- tool forces ----------------------------------------------------------------------------------
struct tool_contact {
  Read<Bodies> bodies;
  Read<Clock> clock;
  ContactCurves curves;
  RowColumns<ToolContact> columns;
  ToolSurfaces tools;
  Read<ToolVelocity> tool_velocity;
  Optional<Read<SurfaceRange>> range;
  SummedBlocks<ToolContact, ContactSums<ToolContact>> summed;
  void operator()(SmallTasks) const;
};

// ---- tool bonds ------------------------------------------------------------------------------------
struct ToolBondPlaces {
  Read<CurvePosition> control;
  ToolSurfaces tools;
  Optional<Read<SurfaceRange>> range;
};

struct initial_tool_bonds {  // once, at the start
  Read<Bodies> bodies;
  Read<BondRules> rules;
  NewBonds<ToolContact> rows;
  ToolBondPlaces at;
  Write<ToolAnchor> anchor;
  Write<BondTotals> totals;
  void operator()() const;
};

struct pressed_tool_bonds {
  Read<Bodies> bodies;
  Read<BondRules> rules;
  NewBonds<ToolContact> rows;
  Write<WeldPressure<ToolContact>> pressure;
  ToolBondPlaces at;
  Write<ToolAnchor> anchor;
  void operator()(SmallTasks) const;
};

struct tool_bond_forces {
  Read<Bodies> bodies;
  Read<Clock> clock;
  Read<BondRules> rules;
  RowColumns<ToolContact> columns;
  BondColumns<ToolContact> bonds;
  struct Places {
    ContactCurves curves;
    Read<ToolPosition> position;
    Read<ToolVelocity> velocity;
    Read<ToolAnchor> anchor;
  } at;
  SummedBlocks<ToolContact, BondSums<ToolContact>> summed;
  void operator()(SmallTasks) const;
};

template <class D>
struct apply_constraints {
  ShapedBodies<D> bodies;
  Read<Clock> clock;
  Read<ToolProgram> program;
  struct Constraints {
    Read<ConstraintIndex> index;
    Read<ConstraintTarget> target;
    Read<ConstraintDirection<D>> direction;
    Read<ConstraintTravel<D>> travel;
    Read<ConstraintOrigin> origin;
  } constraints;
  Read<Density> density;
  Motion<D> motion;
  NodalForces<Write, D> forces;
  Write<ConstraintReaction> reaction;
  void operator()(Chunk chunk) const;
};

template <class D>
struct ConstraintReactions {
  Read<ConstraintIndex> index;
  Read<ConstraintTarget> target;
  Read<ConstraintTravel<D>> travel;
  Read<ConstraintReaction> reaction;
};
template <class D>
struct tool_reaction {
  Read<Bodies> bodies;
  Read<Clock> clock;
  Optional<TouchingRows<typename D::ToolContact>> contacts;
  Optional<ConstraintReactions<D>> constraints;
  Read<ToolVelocity> velocity;
  Write<ToolForce> tool_force;
  Write<Totals> totals;
  Link link;
  void operator()() const;
};

struct ridge_health {
  Read<Bodies> bodies;
  Read<Clock> clock;
  Read<ContactRules> rules;
  Read<ContactIndex> index;
  Read<CurvePosition> curve;
  struct Polylines {
    Read<ToolPosition> position;
    Read<ToolShapes> shapes;
    Read<ToolProgram> program;
  } tools;
  struct Rows {
    Read<ContactPair<ToolContact>> pair;
    Read<ContactTouches<ToolContact>> touches;
    Read<SurfaceRange> range;
  } rows;
  void operator()() const;
};

// ---- the clock --------------------------------------------------------------------------------------
// Speeds of the surfaces; empty if no contact is possible.
template <class D>
struct SurfaceSpeeds {
  Optional<Read<MaximumSpeed>> outlines;
  Optional<Read<ToolProgram>> program;
  Optional<Read<ServoVelocity>> servo;
  Optional<Read<PeriodicCell<D>>> cell;
};

struct first_penetration {  // once, at the start, for surfaces that overlap there
  Optional<Read<ContactSums<Contact>>> pairs;
  Optional<Read<ContactSums<ToolContact>>> tools;
  Write<Clock> clock;
  Link link;
  void operator()() const;
};

template <class D>
struct first_time_step {  // once, at the start
  Read<Bodies> bodies;
  Read<StableTimeStep> stable;
  SurfaceSpeeds<D> speeds;
  Optional<Read<ContactRules>> rules;
  Write<Clock> clock;
  Link link;
  void operator()() const;
};

template <class D>
struct advance_clock {
  Read<Bodies> bodies;
  Read<StableTimeStep> stable;
  SurfaceSpeeds<D> speeds;
  Write<Totals> totals;  // of all ranks
  Optional<Read<StageEnds>> ends;
  Optional<Read<ContactRules>> rules;
  Write<Clock> clock;
  Link link;
  void operator()() const;
};

}  // namespace pulvis
