// Equilibrium of a solid under dead loads and contact, by Newton's method with a line search.
//
// An iteration is a task graph, like a step of the explicit method: evaluate (elements, forces, tangent,
// residual), factorise, direction. The iteration loop is here.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/task_graph.hpp"
#include "engine/world.hpp"

namespace pulvis {

struct NewtonSettings {
  double tolerance = 1e-10;   // -, residual over the forces that must balance
  double round_off = 1e-7;    // -, the same, below which a residual that stalls counts as round-off
  double step = 1e-6;         // -, Newton step over displacements, tolerated as round-off
  double last_digits = 1e-9;  // -, the same, if it is the only criterion: in extended precision
  double contact_tolerance =
      1e-7;             // -, violation of the contact law by forces, or force error of the servo
  int iterations = 25;  // maximum, before the increment counts as failed
  // The solid's factors are reused across iterations and increments while they gain a digit each time: a
  // tip dragged over a surface hardly rotates its lever. Without reuse, convergence is quadratic.
  bool reuse_factors = false;
  bool may_jump = false;  // for the probe, to a distant equilibrium; nothing less will do
  int cuts = 12;          // maximum step halvings in the line search
};

struct NewtonReport {
  bool converged = false;
  std::vector<double> residuals;  // -, before every iteration and after the last one
  double released = 0;            // J, by a jump of the probe
};

// Columns and resources that every solid needs; the mesh and the material must exist already.
void add_solid_columns(World& world);
// For a solid with tetrahedra.
void add_tetrahedron_columns(World& world);
// For a solid in which some elements yield.
void add_plastic_columns(World& world);
// For a probe with that many points; the target must exist already.
void add_probe_columns(World& world, std::size_t points);

class StaticSolver {
 public:
  // Must be built and run inside the arena it will use.
  explicit StaticSolver(World& world);
  ~StaticSolver();

  // Evaluates and factorises at the current displacements.
  void linearise();
  // Response of the last linearisation: displacements [3 nodes] to forces [3 nodes], fixed and hanging nodes
  // included.
  std::vector<double> respond(std::span<const double> forces) const;
  // Newton's method from the current displacements; if it fails they are restored, and so is the height of
  // the target if a servo moves it.
  NewtonReport equilibrate(const NewtonSettings& settings = {});
  // Evaluates the forces, not the tangent.
  void look() { look_.run(); }
  // Commits the contact and plasticity state of the current equilibrium for the next increment.
  void commit();

  // Switches to factors in long double: for a lever so thin or soft that those in double do not converge.
  void extend_precision();
  bool in_extended_precision() const;
  // All pivots of the last factorisation are positive, as required of a solid at rest.
  bool stable() const;

  // Unknowns of the equilibrium search: displacements, contact forces, height of the target.
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
