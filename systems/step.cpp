#include "systems/step.hpp"

#include "systems/highest_mode.hpp"
#include "systems/systems.hpp"

namespace pulvis {

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
  force(tools || grips, "tool_motion", tool_motion);
  force(touching, "skin_check",       skin_check);
  force(pairs,    "bin_edges",        bin_edges);
  force(tools,    "bin_tool_edges",   bin_tool_edges);
  force(pairs,    "edge_contact",     edge_contact);
  force(tools,    "tool_contact",     tool_contact);
  // Needs nothing of the above: runs beside the narrow phase.
  force(!plastic, "elastic_stress",   elastic_stress<F>);
  force(plastic,  "trial_stress",     trial_stress<F>);
  force(plastic,  "j2_return_map",    j2_return_map<F>);
  force(true,     "internal_force",   internal_force<F>);
  force(touching, "contact_totals",   contact_totals);
  force(touching, "contact_health",   contact_health);
  force(tools && !grips, "tool_reaction", tool_reaction);
  // One pass over the chunks from here to the end of the step.
  force(touching, "contact_force",    contact_force);
  force(grips,    "hold_grips",       hold_grips);
  force(grips,    "tool_reaction",    tool_reaction);  // theirs is known last

  observe(true,    "kinetic_energy",  kinetic_energy);
  observe(true,    "elastic_energy",  elastic_energy<F>);
  observe(plastic, "plastic_work",    plastic_work<F>);
  observe(F::stabilised, "hourglass_energy", hourglass_energy);

  move(true,      "integrate",        integrate);
  move(touching,  "contact_curve",    contact_curve);
  move(true,      "stable_time_step", stable_time_step<F::points>);
  move(w.has<HighestMode>(), "highest_mode", highest_mode<F::points>);
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
  return start;
}

namespace {

std::vector<System> joined(std::vector<System> first, std::vector<System> second) {
  first.insert(first.end(), std::make_move_iterator(second.begin()),
               std::make_move_iterator(second.end()));
  return first;
}

}  // namespace

Step::Step(World& world)
    : world_(world),
      whole_(joined(step_list(world).forces, step_list(world).motion), world.chunks()),
      observed_(joined(step_list(world).forces, step_list(world).observe), world.chunks()),
      motion_(step_list(world).motion, world.chunks()) {}

void Step::start() {
  TaskGraph(start_list(world_), world_.chunks()).run();
  choose_time_step(Read<StableTimeStep>(world_).values(), world_.resource<Clock>());
}

void Step::run() { whole_.run(); }
void Step::observe() { observed_.run(); }
void Step::move() { motion_.run(); }

}  // namespace pulvis
