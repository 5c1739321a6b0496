// Equilibrium of a solid under dead loads and contact, by Newton's method with a line search.
//
// An iteration is a task graph, like a step of the explicit method: evaluate (elements, forces, tangent,
// residual), factorise, direction. The loop around it lives here.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/task_graph.hpp"
#include "engine/world.hpp"

namespace pulvis {

struct NewtonSettings {
  double tolerance = 1e-10;   // -, residual over the forces that must balance
  double round_off = 1e-7;    // -, the same, below which a residual that stays is round-off
  double step = 1e-6;         // -, Newton's step over the displacements, that round-off may leave
  double last_digits = 1e-9;  // -, the same, where it is all that counts: in extended precision
  double contact_tolerance =
      1e-7;             // -, force that breaks the law of contact, or that the servo misses
  int iterations = 25;  // after which the increment counts as failed
  // The solid's factors are kept from one iteration and increment to the next while they gain a digit each
  // time: a tip drawn over a surface hardly turns its lever. Without it the convergence is quadratic.
  bool reuse_factors = false;
  bool may_jump = false;  // of the probe, to an equilibrium further off; nothing smaller will do
  int cuts = 12;          // halvings of a step that the line search tries
};

struct NewtonReport {
  bool converged = false;
  std::vector<double> residuals;  // -, before every iteration and after the last one
  double released = 0;            // J, by a jump of the probe
};

// Columns and resources that every solid needs; the mesh and the material are there already.
void add_solid_columns(World& world);
// Of a solid that has tetrahedra.
void add_tetrahedron_columns(World& world);
// Of a solid some of whose elements yield.
void add_plastic_columns(World& world);
// Of a probe of so many points; the target is there already.
void add_probe_columns(World& world, std::size_t points);

class StaticSolver {
 public:
  // Must be built and run inside the arena it will use.
  explicit StaticSolver(World& world);
  ~StaticSolver();

  // Evaluates and factorises at the present displacements.
  void linearise();
  // Of the last linearisation: displacements [3 nodes] by forces [3 nodes], held and hanging nodes
  // included.
  std::vector<double> respond(std::span<const double> forces) const;
  // Newton's method from the present displacements; they are left as they were where it fails, and so is
  // the target's height where a servo moves it.
  NewtonReport equilibrate(const NewtonSettings& settings = {});
  // Evaluates the forces, no tangent.
  void look() { look_.run(); }
  // What contact and plasticity carry on to the next increment, from the present equilibrium.
  void commit();

  // From now on with factors in long double: for a lever so thin or soft that those in double do not answer.
  void extend_precision();
  bool in_extended_precision() const;
  // All pivots of the last factorisation are positive, as a solid's at rest must be.
  bool stable() const;

  // What an equilibrium is searched in: displacements, forces of the contact, height of the target.
  struct State {
    std::vector<double> displacement, force;  // m [3 nodes], N [3 points]
    double height = 0;                        // m

    template <class Bytes>
    void state(Bytes& bytes) {
      bytes(displacement, force, height);
    }
  };
  State state() const;
  void restore(const State& state);

  const GraphPlan& plan() const { return iterate_->plan(); }

 private:
  void make_graphs();
  void move(double share);
  double error() const;
  double step_size() const;
  bool settled(const std::vector<double>& residuals, const NewtonSettings& settings) const;
  void search(double allowed, int cuts);

  World& world_;
  TaskGraph reuse_, look_;
  std::unique_ptr<TaskGraph> linearise_, iterate_, commit_;
};

}  // namespace pulvis
