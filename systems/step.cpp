#include "systems/step.hpp"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>

#include "systems/body/highest_mode.hpp"
#include "systems/body/systems.hpp"
#include "systems/contact/lost_bodies.hpp"
#include "systems/contact/outline_health.hpp"
#include "systems/contact/systems.hpp"
#include "systems/observe/systems.hpp"
#include "systems/tools/systems.hpp"

namespace pulvis {

// Chunks (of eight particles, some 200 kB of state where each has 140 elements) that stay in a processor's
// last cache from one step to the next.
constexpr int chunks_in_cache = 64;

// ---- the order of a step: a newcomer's first page ------------------------------------------------
// F: how the elements of the scene take their stresses (components/formulation.hpp).
template <class F>
StepList step_list_of(World& w) {
  const bool plastic = w.has<PlasticStrain<F::points>>();
  const bool pairs = w.has<ContactPair<Contact>>();
  const bool tools = w.has<ContactPair<ToolContact>>();
  const bool touching = pairs || tools;
  const bool grips = w.has<GripReaction>();
  StepList step;
  const auto force = [&](bool asked, const char* name, auto* function) {
    if (asked) step.forces.push_back(make_system(w, name, function));
  };
  const auto observe = [&](bool asked, const char* name, auto* function) {
    if (asked) step.observe.push_back(make_system(w, name, function, When::on_sample));
  };
  const auto move = [&](bool asked, const char* name, auto* function) {
    if (asked) step.motion.push_back(make_system(w, name, function));
  };

  // clang-format off
  // Forces of the bodies need no contact. Beside the narrow phase they keep all threads busy to the end of
  // it; but then bodies are passed over twice in a step, which costs where they come from memory each time.
  const bool one_pass = w.chunks() > chunks_in_cache;
  const auto bodies = [&] {
    force(!plastic, "elastic_stress",   elastic_stress<F>);
    force(plastic,  "trial_stress",     trial_stress<F>);
    force(plastic,  "j2_return_map",    j2_return_map<F>);
    force(true,     "internal_force",   internal_force<F>);
    force(w.has<DampingForce>(), "damping_force", damping_force<F>);
    force(true,     "stable_time_step", stable_time_step<F::points>);
    force(w.has<HighestMode>(), "highest_mode", highest_mode<F::points>);
  };

  const auto drives = [&] {
    force(w.has<StageEnds>(),  "stage_control", stage_control);
    force(w.has<ToolServos>(), "tool_servo",    tool_servo);
  };

  force(tools || grips, "tool_motion", tool_motion);
  force(touching, "skin_check",       skin_check);
  force(pairs,    "bin_edges",        bin_edges);
  force(tools,    "bin_tool_edges",   bin_tool_edges);
  force(pairs,    "edge_contact",     edge_contact);
  force(tools,    "tool_contact",     tool_contact);
  if (!one_pass) bodies();
  force(touching, "contact_totals",   contact_totals);
  force(touching, "contact_health",   contact_health);
  force(w.has<SurfaceRange>(), "ridge_health", ridge_health);
  force(tools && !grips, "tool_reaction", tool_reaction);
  if (!grips) drives();
  // One pass over the chunks from here to the end of the step.
  force(touching, "contact_force",    contact_force);
  if (one_pass) bodies();
  force(grips,    "hold_grips",       hold_grips);
  force(grips,    "tool_reaction",    tool_reaction);  // theirs is known last
  if (grips) drives();

  observe(tools,   "lost_bodies",     lost_bodies);
  observe(touching || grips, "outline_health", outline_health);
  observe(true,    "kinetic_energy",  kinetic_energy);
  observe(true,    "elastic_energy",  elastic_energy<F>);
  observe(plastic, "plastic_work",    plastic_work<F>);
  observe(F::stabilised, "hourglass_energy", hourglass_energy);
  observe(w.has<ParticleStress>(), "particle_stress", particle_stress<F>);
  observe(w.has<ContactNetwork>(), "contact_network", contact_network);
  observe(w.has<ContactQuality>(), "contact_quality", contact_quality);
  observe(w.has<ForceChains>(), "force_chains", force_chains);
  observe(w.has<DensityGrid>(), "local_density", local_density);

  move(true,      "integrate",        integrate);
  move(touching,  "contact_curve",    contact_curve);
  move(true,      "element_health",   element_health);
  move(true,      "advance_clock",    advance_clock);
  // clang-format on
  return step;
}

StepList step_list(World& w) {
  if (w.has<DeviatoricStress<OnePoint::points>>()) return step_list_of<OnePoint>(w);
  if (w.has<MeanStress<Standard::volumes>>()) return step_list_of<Standard>(w);
  return step_list_of<FourPoint>(w);
}

std::vector<System> start_list(World& w) {
  std::vector<System> start;
  if (w.has<CurvePosition>()) start.push_back(make_system(w, "contact_curve", contact_curve));
  start.push_back(w.has<DeviatoricStress<1>>()
                      ? make_system(w, "stable_time_step", stable_time_step<1>)
                      : make_system(w, "stable_time_step", stable_time_step<4>));
  if (w.has<HighestMode>())
    start.push_back(w.has<DeviatoricStress<1>>() ? make_system(w, "highest_mode", highest_mode<1>)
                                                 : make_system(w, "highest_mode", highest_mode<4>));
  start.push_back(make_system(w, "first_time_step", first_time_step));
  return start;
}

namespace {

std::vector<System> joined(std::vector<System> first, std::vector<System> second) {
  first.insert(first.end(), std::make_move_iterator(second.begin()),
               std::make_move_iterator(second.end()));
  return first;
}

std::vector<System> whole_step(World& world) {
  return joined(step_list(world).forces, step_list(world).motion);
}

// Room for the transient components of every thread that may run the step.
World& with_transients(World& world) {
  world.allocate_transient(droppable_components(whole_step(world)),
                           tbb::this_task_arena::max_concurrency());
  return world;
}

}  // namespace

Step::Step(World& world)
    : world_(with_transients(world)),
      whole_(whole_step(world), world.chunks(), Transients::dropped,
             world.chunks() > chunks_in_cache ? &world : nullptr),
      observed_(joined(step_list(world).forces, step_list(world).observe), world.chunks()),
      motion_(step_list(world).motion, world.chunks()) {}

void Step::start() { TaskGraph(start_list(world_), world_.chunks()).run(); }

void Step::run() { whole_.run(); }
void Step::observe() { observed_.run(); }
void Step::move() { motion_.run(); }

std::vector<SystemCost> Step::costs() const {
  std::vector<SystemCost> all = whole_.costs();
  for (const TaskGraph* graph : {&observed_, &motion_})
    for (const SystemCost& cost : graph->costs()) {
      const auto same = std::ranges::find(all, cost.system, &SystemCost::system);
      same == all.end() ? all.push_back(cost) : void(same->seconds += cost.seconds);
    }
  return all;
}

}  // namespace pulvis
