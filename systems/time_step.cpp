// stable_time_step: the greatest time step that every element (and the contact springs on the outline)
// of a particle can stand. advance_clock: chooses the next step and moves time on.
//
// Source   The highest frequency of an assembly is at most that of its worst element (Irons; Flanagan &
//          Belytschko 1984). Element with lumped mass m_e/4 a node and uniform gradient A^-1:
//            omega^2 <= (K (1 + theta^2)/2 + 4/3 mu) / rho / s^2,   s = half-width (singular value of A)
//          An element on the outline also bears the contact springs: two nodes of mass m_e/4 each on
//          kappa L t (a tool's, or the half of it that two equal bodies share, moving against each other):
//          + 2 kappa L / (rho A) = 2 k K (L/A)^2 / rho, (L/A)^2 from the shape.
// Runs     stable_time_step every few steps (geometry changes little in a step); advance_clock last
#include "components/run_state.hpp"
#include "engine/access.hpp"
#include "systems/element_access.hpp"
#include "systems/systems.hpp"

namespace pulvis {

void stable_time_step(Chunk chunk, Read<Bodies> bodies, Read<Clock> clock, Read<Position> x,
                      Read<ShearModulus> mu, Read<BulkModulus> bulk, Read<Density> density,
                      Optional<Read<ContactRules>> rules, Write<StableTimeStep> stable) {
  if (clock->step % time_step_interval != 0) return;
  const Row<Particle> particle;
  const Shape& shape = bodies->shape_of_chunk(chunk);
  const auto nodes = x.chunk(chunk);
  const Lane k = bulk.chunk(chunk)(particle), rho = density.chunk(chunk)(particle);
  const Lane shear = (4.0 / 3.0) * mu.chunk(chunk)(particle);
  // Damping shortens the step of a spring by sqrt(1 + xi^2) - xi, about 1 - xi.
  const double contact = rules ? 2 * (*rules)->stiffness * (1 + 2 * (*rules)->damping) : 0;
  Lane highest{};
  for (int i = 0; i < shape.elements(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const auto map = quad_map(nodes, shape.quads[at]);
    const Lane theta = mean_dilatation(map, shape.centre[at]);
    const Lane width2 = kernels::squared_half_width(kernels::map_gradient(map, 0, 0));
    Lane omega2 = (0.5 * k * (1.0 + theta * theta) + shear) / (rho * width2);
    if (contact > 0 && shape.contact_stiffness[at] > 0)
      omega2 += contact * shape.contact_stiffness[at] * k / rho;
    highest = max(highest, omega2);
  }
  stable.chunk(chunk)(particle) = 2.0 / sqrt(highest);
}

void advance_clock(Read<StableTimeStep> stable, Optional<Read<MaximumSpeed>> speed,
                   Optional<Read<ToolVelocity>> tool_velocity, Write<Clock> clock) {
  if (speed) {
    double fastest = 0;
    for (const double v : speed->values()) fastest = std::max(fastest, v);
    double tool = 0;
    if (tool_velocity)
      for (int t = 0; t < tool_velocity->rows(); ++t)
        tool = std::max(
            tool, std::hypot((*tool_velocity)(Row<Tool>(t), 0), (*tool_velocity)(Row<Tool>(t), 1)));
    clock->travel += (fastest + std::max(fastest, tool)) * clock->dt;
  }
  clock->time += clock->dt;
  clock->dt_before = clock->dt;
  clock->step += 1;
  choose_time_step(stable.values(), *clock);
}

void choose_time_step(std::span<const double> stable, Clock& clock) {
  double least_step = 1e300;
  for (const double dt : stable) least_step = std::min(least_step, dt);
  // Never grow fast: the accelerations that follow from a sudden change belong to the old step.
  const double wanted = clock.safety * least_step;
  clock.dt = clock.dt_before > 0 ? std::min(wanted, 1.02 * clock.dt_before) : wanted;
  // Land on the end of the run exactly, without a sliver of a last step.
  const double left = clock.end - clock.time;
  if (left > 0 && left < 2 * clock.dt) clock.dt = left > clock.dt ? 0.5 * left : left;
}

}  // namespace pulvis
