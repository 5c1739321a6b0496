// What the two contact systems (particle on particle, particle on tool) do alike with a row: place its
// four Gauss points, turn gap and slip into forces, and book the energies.
#pragma once

#include <limits>

#include "components/contact.hpp"
#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "systems/contact_kernel.hpp"

namespace pulvis {

struct PointLanes {
  Lane x, y;
};

// The Gauss points of an edge from its four control points, which lie one after the other.
inline PointLanes edge_points_at(const double* control) {
  static const auto n = kernels::basis(
      Lane{kernels::edge_u[0], kernels::edge_u[1], kernels::edge_u[2], kernels::edge_u[3]});
  PointLanes p{};
  for (std::size_t a = 0; a < 4; ++a) {
    p.x += n[a] * control[2 * a];
    p.y += n[a] * control[2 * a + 1];
  }
  return p;
}

inline Lane lane_of(const double* four) { return Lane{four[0], four[1], four[2], four[3]}; }
inline void put(double* four, Lane value) {
  for (int i = 0; i < 4; ++i) four[i] = value[i];
}

// Relative motion at the four points: how the surfaces stand and move against each other.
struct RowMotion {
  Lane gap;        // m, > 0 in penetration
  Lane nx, ny;     // outward normal of the other surface
  Lane gap_rate;   // m/s
  Lane slip_rate;  // m/s, along t = (-ny, nx)
};

// Columns that every row has, and those that only scenes with friction or damping have.
template <class At>
struct RowColumns {
  Write<ContactPair<At>> pair;
  Write<ContactReach<At>> reach;
  Read<ContactStiffness<At>> stiffness;
  Read<ContactWeight<At>> weight;
  Read<EdgeLength<At>> length;
  Write<PointForce<At>> force;
  Write<Penetration<At>> penetration;
  Write<ContactEnergy<At>> energy;
  Optional<Read<FrictionCoefficient<At>>> friction;
  Optional<Write<ElasticSlip<At>>> elastic_slip;
  Optional<Write<FrictionWork<At>>> friction_work;
  Optional<Read<DampingCoefficient<At>>> damping;
  Optional<Write<DampingWork<At>>> damping_work;
};

// Columns of a row that stay as the broad phase set them.
template <class At>
struct RowConstants {
  Write<ContactPair<At>> pair;
  Write<EdgeLength<At>> length;
  Write<ContactStiffness<At>> stiffness;
  Write<ContactWeight<At>> weight;
  Optional<Write<FrictionCoefficient<At>>> friction;
  Optional<Write<DampingCoefficient<At>>> damping;
};

// Reaches of rows of an outline against itself: not looked at yet; and seen from inside, which no touch is.
inline constexpr double unseen = -1, far_side = std::numeric_limits<double>::infinity();

// A row whose points are all apart: nothing acts, and nothing can until `clearance` has been travelled.
template <class At>
void set_apart(const RowColumns<At>& c, Row<At> row, double reach) {
  c.pair(row, 3) = 0;
  c.reach(row) = reach;
  c.penetration(row) = 0;
  c.energy(row) = 0;
  for (int k = 0; k < 2 * edge_points; ++k) c.force(row, k) = 0;
  if (c.elastic_slip)
    for (int k = 0; k < edge_points; ++k) (*c.elastic_slip)(row, k) = 0;
  if (c.friction_work) (*c.friction_work)(row) = 0;
  if (c.damping_work) (*c.damping_work)(row) = 0;
}

// Forces of a touching row. `share` of kappa: one half where the other particle samples back. Returns
// the friction traction times weight [N] (the couple of the other body needs it).
template <class At>
Lane set_touching(const RowColumns<At>& c, Row<At> row, const RowMotion& m, double share,
                  double dt) {
  const Lane weight = lane_of(&c.weight(row));
  const Lane kappa = broadcast(share * c.stiffness(row));
  const Lane damping = c.damping ? broadcast(share * (*c.damping)(row)) : Lane{};
  const auto normal = kernels::normal_traction(m.gap, m.gap_rate, kappa, damping, c.length(row));
  Lane along{}, work{};
  if (c.friction) {
    double* spring = &(*c.elastic_slip)(row);
    const auto friction = kernels::coulomb_return(
        lane_of(spring), m.slip_rate * dt, normal.pressure, broadcast((*c.friction)(row)), kappa);
    put(spring, friction.elastic_slip);
    along = friction.traction * weight;
    work = friction.work * weight;
    (*c.friction_work)(row) = sum(work);
  }
  const Lane push = normal.pressure * weight;
  put(&c.force(row, 0), push * m.nx - along * m.ny);
  put(&c.force(row, edge_points), push * m.ny + along * m.nx);
  c.pair(row, 3) = 1;
  c.reach(row) = 0;
  c.penetration(row) = greatest(m.gap);
  c.energy(row) = sum(normal.spring_energy * weight);
  if (c.friction) {
    const Lane u = lane_of(&(*c.elastic_slip)(row));
    c.energy(row) += sum(0.5 * kappa * u * u * weight);
  }
  if (c.damping_work) (*c.damping_work)(row) = sum(normal.damping_power * weight) * dt;
  return along;
}

}  // namespace pulvis
