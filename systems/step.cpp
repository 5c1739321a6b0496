#include "systems/step.hpp"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>

#include "components/space/shape.hpp"
#include "engine/run_failure.hpp"
#include "engine/system_list.hpp"
#include "systems/body/systems.hpp"
#include "systems/cell/systems.hpp"
#include "systems/contact/systems.hpp"
#include "systems/observe/systems.hpp"
#include "systems/ranks/failure.hpp"
#include "systems/ranks/systems.hpp"
#include "systems/space/step.hpp"
#include "systems/tools/systems.hpp"

namespace pulvis {
namespace {

// On sampled steps, once the forces are known: what each rank knows of its particles...
template <class F>
void observe_particles(World& w, SystemList& observe) {
  const bool plastic = w.has<PlasticStrain<F::points>>();
  const bool tools = w.has<ContactPair<ToolContact>>();
  const bool touching = tools || w.has<ContactPair<Contact>>();
  const bool constraints = w.has<ConstraintReaction>();

  // clang-format off
  observe.add<lost_bodies>              ("lost_bodies",       tools);
  observe.add<outline_health>           ("outline_health",    touching || constraints);
  observe.add<kinetic_energy<TwoD>>     ("kinetic_energy");
  observe.add<elastic_energy<F>>        ("elastic_energy");
  observe.add<plastic_work<F>>          ("plastic_work",      plastic);
  observe.add<hourglass_energy>         ("hourglass_energy",  F::stabilised);
  observe.add<particle_stress<F>>       ("particle_stress",   w.has<ParticleStress<TwoD>>());
  observe.add<contact_quality>          ("contact_quality",   w.has<ContactQuality>());
  // clang-format on
}
// ...and for the powder as a whole.
void observe_whole(World& w, SystemList& observe) {
  // clang-format off
  observe.add<contact_network>          ("contact_network",   w.has<ContactNetwork<TwoD>>());
  observe.add<force_chains>             ("force_chains",      w.has<ForceChains>());
  observe.add<fragments>                ("fragments",         w.has<Fragments>());
  observe.add<local_density>            ("local_density",     w.has<DensityGrid>());
  // clang-format on
}
template <class F>
std::vector<System> observed_of(World& w) {
  SystemList observe(w, When::on_sample);
  observe_particles<F>(w, observe);
  if (!w.has<RankLink>()) observe_whole(w, observe);
  return observe.taken();
}

// ---- the order of a step: start reading here -----------------------------------------------------
// F: the element formulation of the scene (components/formulation.hpp).
template <class F>
StepList step_list_of(World& w) {
  const bool plastic = w.has<PlasticStrain<F::points>>();
  const bool pairs = w.has<ContactPair<Contact>>();
  const bool tools = w.has<ContactPair<ToolContact>>();
  const bool touching = pairs || tools;
  const bool bonds = w.has<BondTotals>();
  const bool pair_bonds = w.has<CurveAnchor>(), tool_bonds = w.has<ToolAnchor>();
  const bool constraints = w.has<ConstraintReaction>();
  const bool cell = w.has<PeriodicCell>();
  const bool ranks = w.has<RankLink>();
  SystemList force(w), move(w);

  // clang-format off
  force.add<tool_motion>                ("tool_motion",       tools || constraints);
  force.add<receive_outlines<TwoD>>    ("receive_outlines",  ranks && pairs);
  force.add<skin_check<TwoD>>           ("skin_check",        touching);
  force.add<find_border<TwoD>>         ("find_border",       ranks && pairs);
  force.add<bin_edges>                  ("bin_edges",         pairs);
  force.add<bin_tool_edges>             ("bin_tool_edges",    tools);
  force.add<list_border_rows>           ("list_border_rows",  ranks && pairs);
  force.add<pressed_bonds>              ("pressed_bonds",     w.has<WeldPressure<Contact>>());
  force.add<edge_contact>               ("edge_contact",      pairs);
  force.add<bond_forces>                ("bond_forces",       pair_bonds);
  force.add<send_contacts>              ("send_contacts",     ranks && pairs);
  force.add<pressed_tool_bonds>         ("pressed_tool_bonds", w.has<WeldPressure<ToolContact>>());
  force.add<tool_contact>               ("tool_contact",      tools);
  force.add<tool_bond_forces>           ("tool_bond_forces",  tool_bonds);
  force.add<receive_contacts>           ("receive_contacts",  ranks && pairs);
  force.add<contact_totals>             ("contact_totals",    touching);
  force.add<bond_totals>                ("bond_totals",       bonds);
  force.add<contact_health<TwoD>>       ("contact_health",    touching);
  force.add<ridge_health>               ("ridge_health",      w.has<SurfaceRange>());
  force.add<contact_force>              ("contact_force",     touching);
  force.add<cell_load>                  ("cell_load",         cell);
  force.add<cell_control>               ("cell_control",      cell);
  force.add<elastic_stress<F>>          ("elastic_stress",    !plastic);
  force.add<trial_stress<F>>            ("trial_stress",      plastic);
  force.add<j2_return_map<F>>           ("j2_return_map",     plastic);
  force.add<internal_force<F>>          ("internal_force");
  force.add<damping_force<F>>           ("damping_force",     w.has<DampingForce<TwoD>>());
  force.add<stable_time_step<F::points>>("stable_time_step");
  force.add<highest_mode<F::points>>    ("highest_mode",      w.has<HighestMode>());
  force.add<apply_constraints>          ("apply_constraints", constraints);
  force.add<tool_reaction<TwoD>>        ("tool_reaction",     tools || constraints);
  force.add<wall_control>               ("wall_control",      w.has<DrivenWalls>());
  force.add<stage_control>              ("stage_control",     w.has<StageEnds>());
  force.add<tool_servo<TwoD>>           ("tool_servo",        w.has<ToolServos>());

  move.add<cell_kick>                   ("cell_kick",         cell);
  move.add<integrate<TwoD>>             ("integrate");
  move.add<contact_curve>               ("contact_curve",     touching);
  move.add<send_outlines<TwoD>>        ("send_outlines",     ranks && pairs);
  move.add<cell_motion>                 ("cell_motion",       cell);
  move.add<element_health>              ("element_health");
  move.add<return_health>               ("return_health",     w.has<ReturnResidual>());
  move.add<advance_clock>               ("advance_clock");
  // clang-format on
  return {force.taken(), observed_of<F>(w), move.taken()};
}

// What touches at the start is known only after the contact search.
void add_first_contacts(World& w, SystemList& start) {
  const bool pairs = w.has<ContactPair<Contact>>(), tools = w.has<ContactPair<ToolContact>>();
  const bool pair_bonds = w.has<CurveAnchor>(), tool_bonds = w.has<ToolAnchor>();
  const bool ranks = w.has<RankLink>();
  start.add<skin_check<TwoD>>("skin_check", pairs || tools);
  start.add<find_border<TwoD>>("find_border", pairs && ranks);
  start.add<bin_edges>("bin_edges", pairs);
  start.add<bin_tool_edges>("bin_tool_edges", tools);
  start.add<list_border_rows>("list_border_rows", pairs && ranks);
  start.add<edge_contact>("edge_contact", pairs);
  start.add<tool_contact>("tool_contact", tools);
  start.add<initial_bonds>("initial_bonds", pair_bonds);
  start.add<initial_tool_bonds>("initial_tool_bonds", tool_bonds);
  start.add<initial_bond_totals>("initial_bond_totals", (pair_bonds || tool_bonds) && ranks);
  start.add<first_penetration>("first_penetration", pairs || tools);
}

template <class F>
std::vector<System> start_list_of(World& w) {
  SystemList start(w);
  start.add<contact_curve>("contact_curve", w.has<CurvePosition>());
  add_first_contacts(w, start);
  start.add<stable_time_step<F::points>>("stable_time_step");
  start.add<highest_mode<F::points>>("highest_mode", w.has<HighestMode>());
  start.add<first_time_step>("first_time_step");
  return start.taken();
}

// In three dimensions.
StepList step_list_in_space(World& w) {
  space::Steps steps = space::steps_of(w);
  return {std::move(steps.forces), std::move(steps.observe), std::move(steps.motion)};
}

Formulation formulation(const World& w) { return w.resource<Bodies>().formulation; }

}  // namespace

StepList step_list(World& w) {
  if (w.has<space::Shapes>()) return step_list_in_space(w);
  return with_formulation(formulation(w), [&]<class F>(F) { return step_list_of<F>(w); });
}

std::vector<System> start_list(World& w) {
  if (w.has<space::Shapes>()) return space::start_of(w);
  return with_formulation(formulation(w), [&]<class F>(F) { return start_list_of<F>(w); });
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

// Chunks (of eight particles, some 200 kB of state if each has 140 elements) that stay in the last-level
// cache from one step to the next.
constexpr int chunks_in_cache = 64;

bool from_memory(const World& world) {
  return static_cast<int>(world.resource<Bodies>().own_chunks.size()) > chunks_in_cache;
}
// With several ranks, a separate pass over the bodies runs while messages are in flight.
Passes passes_of(const World& world) {
  const bool ranks = world.has<RankLink>();
  return from_memory(world) && !ranks ? Passes::fewest : Passes::concurrent;
}

// Storage for the transient components of every thread that may run the step.
World& with_transients(World& world) {
  world.allocate_transient(droppable_components(whole_step(world), passes_of(world)),
                           tbb::this_task_arena::max_concurrency());
  return world;
}

const std::vector<int>& chunks_of(const World& world) {
  return world.resource<Bodies>().own_chunks;
}

// A failure is noted, and thrown once all systems have completed the step: the state that a failed run ends with then
// depends neither on the number of threads nor on that of ranks, to which it is sent at the end of the step.
std::vector<System> watched(std::vector<System> systems, World& world, StepFailure& failure) {
  RankLink* link = world.has<RankLink>() ? &world.resource<RankLink>() : nullptr;
  for (std::size_t i = 0; i < systems.size(); ++i)
    systems[i].run = [link, &failure, position = static_cast<int>(i),
                      run = std::move(systems[i].run)](Chunk chunk) {
      try {
        run(chunk);
      } catch (const RunFailure& found) {
        if (link == nullptr)
          failure.note(position, chunk.index, found.what());
        else
          note_failure(*link, position, found.what());
      }
    };
  return systems;
}

}  // namespace

namespace {

std::vector<System> whole_list(World& world) {
  if (world.has<space::Shapes>()) return space::observers_of_whole(world);
  SystemList observe(world, When::on_sample);
  observe_whole(world, observe);
  return observe.taken();
}

}  // namespace

WholeObservers::WholeObservers(World& whole) : WholeObservers(whole_list(whole), whole) {}
WholeObservers::WholeObservers(const std::vector<System>& systems, World& whole)
    : observe_(systems, whole.resource<Bodies>().own_chunks) {
  for (const System& system : systems)
    for (const AccessInfo& access : system.accesses) looks_at_.push_back(access.name);
}

void WholeObservers::run() { observe_.run(); }

Step::Step(World& world)
    : world_(with_transients(world)),
      failure_(std::make_unique<StepFailure>()),
      whole_(watched(whole_step(world), world, *failure_), chunks_of(world), passes_of(world),
             Transients::dropped, from_memory(world) ? &world : nullptr),
      observed_(watched(joined(step_list(world).forces, step_list(world).observe), world, *failure_),
                chunks_of(world), passes_of(world)),
      motion_(watched(step_list(world).motion, world, *failure_), chunks_of(world)) {}

void Step::start() {
  TaskGraph(watched(start_list(world_), world_, *failure_), chunks_of(world_)).run();
  end_of_step();
}
void Step::run() { run_to_next(whole_); }
void Step::observe() {
  observed_.run();
  if (world_.has<RankLink>()) agree(world_.resource<RankLink>(), {});
  end_of_step();
}
void Step::move() { run_to_next(motion_); }

// A step that fails is completed, but the run ends in it.
void Step::run_to_next(TaskGraph& systems) {
  const Clock before = world_.resource<Clock>();
  systems.run();
  try {
    end_of_step();
  } catch (const RunFailure&) {
    world_.resource<Clock>() = before;
    throw;
  }
}

void Step::end_of_step() {
  if (world_.has<RankLink>()) throw_failure_of_any(world_.resource<RankLink>());
  if (*failure_) throw RunFailure(failure_->take());
}

std::vector<std::string> Step::sampled_systems() const {
  const auto names = [](const GraphPlan& plan) {
    std::vector<std::string> all;
    for (const StagePlan& stage : plan.stages)
      all.insert(all.end(), stage.systems.begin(), stage.systems.end());
    return all;
  };
  const std::vector<std::string> plain = names(plan());
  std::vector<std::string> sampled = names(observed_.plan());
  std::erase_if(sampled, [&](const auto& name) { return std::ranges::count(plain, name) > 0; });
  return sampled;
}

std::vector<SystemCost> Step::costs() const {
  return added(whole_.costs(), added(observed_.costs(), motion_.costs()));
}

}  // namespace pulvis
