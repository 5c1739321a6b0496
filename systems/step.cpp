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
#include "systems/space/body/systems.hpp"
#include "systems/space/contact/systems.hpp"
#include "systems/space/observe/systems.hpp"
#include "systems/space/tools/systems.hpp"
#include "systems/tools/systems.hpp"

namespace pulvis {
namespace {

template <class D>
constexpr bool in_plane = D::axes == 2;
template <class D>
constexpr bool in_space = D::axes == 3;

// Which contacts a scene can have: between particles, with tools, between particles of several processes.
template <class D>
struct Contacts {
  bool pairs, tools, ranks;
  explicit Contacts(const World& w)
      : pairs(w.has<ContactPair<typename D::Contact>>()),
        tools(w.has<ContactPair<typename D::ToolContact>>()),
        ranks(pairs && w.has<RankLink>()) {}
  bool any() const { return pairs || tools; }
};

// ---- the elements ----------------------------------------------------------------------------------
// F: the element formulation of the scene (components/formulation.hpp, components/space/formulation.hpp).
template <class F>
void add_element_forces(World& w, SystemList& force) {
  const bool plastic = w.has<PlasticStrain<F::points>>();
  const bool damped = w.has<DampingForce<typename F::Dimension>>();
  // clang-format off
  if constexpr (in_plane<typename F::Dimension>) {
    force.add<elastic_stress<F>>        ("elastic_stress",    !plastic);
    force.add<trial_stress<F>>          ("trial_stress",      plastic);
    force.add<j2_return_map<F>>         ("j2_return_map",     plastic);
    force.add<internal_force<F>>        ("internal_force");
    force.add<damping_force<F>>         ("damping_force",     damped);
  } else {
    force.add<space::elastic_force<F>>  ("elastic_force",     !plastic);
    force.add<space::plastic_force<F>>  ("plastic_force",     plastic);
    force.add<space::damping_force<F>>  ("damping_force",     damped);
  }
  // clang-format on
}

template <class F>
void add_time_step(World& w, SystemList& list) {
  if constexpr (in_plane<typename F::Dimension>) {
    list.add<stable_time_step<F::points>>("stable_time_step");
  } else {
    list.add<space::stable_time_step<F>>("stable_time_step");
  }
  list.add<highest_mode<F>>("highest_mode", w.has<HighestMode<typename F::Dimension>>());
}

template <class F>
void observe_elements(World& w, SystemList& observe) {
  using D = typename F::Dimension;
  const bool plastic = w.has<PlasticStrain<F::points>>();
  const bool stresses = w.has<ParticleStress<D>>();
  // clang-format off
  observe.add<kinetic_energy<D>>        ("kinetic_energy");
  if constexpr (in_plane<D>) {
    observe.add<elastic_energy<F>>      ("elastic_energy");
  } else {
    observe.add<space::elastic_energy<F>>("elastic_energy");
    observe.add<space::node_spring_energy>("node_spring_energy", w.has<space::Roughness>());
  }
  observe.add<plastic_work<F>>          ("plastic_work",      plastic);
  if constexpr (in_plane<D>) {
    observe.add<hourglass_energy>       ("hourglass_energy",  F::stabilised);
    observe.add<particle_stress<F>>     ("particle_stress",   stresses);
  } else {
    observe.add<space::hourglass_energy>("hourglass_energy",  F::stabilised);
    observe.add<space::particle_stress<F>>("particle_stress", stresses);
  }
  // clang-format on
}

// ---- on sampled steps, once the forces are known -----------------------------------------------------
// What each rank knows of its particles...
template <class F>
void observe_particles(World& w, SystemList& observe) {
  using D = typename F::Dimension;
  const Contacts<D> contacts(w);
  const bool outlines = contacts.any() || w.has<ConstraintReaction>();
  const bool quality = w.has<ContactQuality>();

  // clang-format off
  observe.add<lost_bodies>              ("lost_bodies",       in_plane<D> && contacts.tools);
  observe.add<outline_health>           ("outline_health",    in_plane<D> && outlines);
  observe_elements<F>(w, observe);
  observe.add<space::node_distance>     ("node_distance",     w.has<space::NodeDistance>());
  observe.add<contact_quality>          ("contact_quality",   in_plane<D> && quality);
  observe.add<space::contact_quality>   ("contact_quality",   in_space<D> && quality);
  // clang-format on
}

// ...and the powder as a whole.
template <class D>
void observe_whole(World& w, SystemList& observe) {
  const bool network = w.has<ContactNetwork<D>>();
  const bool bonds = w.has<Fragments>();

  // clang-format off
  observe.add<contact_network>          ("contact_network",   in_plane<D> && network);
  observe.add<space::contact_network>   ("contact_network",   in_space<D> && network);
  observe.add<force_chains<D>>          ("force_chains",      w.has<ForceChains>());
  observe.add<fragments>                ("fragments",         in_plane<D> && bonds);
  observe.add<space::fragments>         ("fragments",         in_space<D> && bonds);
  observe.add<local_density>            ("local_density",     w.has<DensityGrid>());
  observe.add<space::local_density>     ("local_density",     w.has<space::DensityGrid>());
  // clang-format on
}

template <class F>
std::vector<System> observed_of(World& w) {
  SystemList observe(w, When::on_sample);
  observe_particles<F>(w, observe);
  if (!w.has<RankLink>()) observe_whole<typename F::Dimension>(w, observe);
  return observe.taken();
}

// ---- the order of a step: start reading here, with step_list_of ------------------------------------
template <class D>
void add_contacts(World& w, SystemList& force) {
  const auto [pairs, tools, ranks] = Contacts<D>(w);
  const bool touching = pairs || tools;

  // clang-format off
  force.add<receive_outlines<D>>        ("receive_outlines",  ranks);
  force.add<skin_check<D>>              ("skin_check",        touching);
  force.add<find_border<D>>             ("find_border",       ranks);
  force.add<bin_edges>                  ("bin_edges",         in_plane<D> && pairs);
  force.add<space::bin_faces>           ("bin_faces",         in_space<D> && pairs);
  force.add<bin_tool_edges>             ("bin_tool_edges",    in_plane<D> && tools);
  force.add<space::bin_tool_faces>      ("bin_tool_faces",    in_space<D> && tools);
  force.add<list_border_rows>           ("list_border_rows",  in_plane<D> && ranks);
  force.add<list_border_pairs>          ("list_border_pairs", in_space<D> && ranks);
  force.add<pressed_bonds>              ("pressed_bonds",     w.has<WeldPressure<Contact>>());
  force.add<edge_contact>               ("edge_contact",      in_plane<D> && pairs);
  force.add<space::face_contact>        ("face_contact",      in_space<D> && pairs);
  force.add<bond_forces>                ("bond_forces",       w.has<CurveAnchor>());
  force.add<send_contacts>              ("send_contacts",     in_plane<D> && ranks);
  force.add<send_loads>                 ("send_loads",        in_space<D> && ranks);
  force.add<pressed_tool_bonds>         ("pressed_tool_bonds", w.has<WeldPressure<ToolContact>>());
  force.add<tool_contact>               ("tool_contact",      in_plane<D> && tools);
  force.add<space::tool_contact>        ("tool_contact",      in_space<D> && tools);
  force.add<tool_bond_forces>           ("tool_bond_forces",  w.has<ToolAnchor>());
  force.add<receive_contacts>           ("receive_contacts",  in_plane<D> && ranks);
  force.add<receive_loads>              ("receive_loads",     in_space<D> && ranks);
  force.add<contact_totals>             ("contact_totals",    touching);
  force.add<bond_totals>                ("bond_totals",       w.has<BondTotals>());
  force.add<contact_health<D>>          ("contact_health",    touching);
  force.add<ridge_health>               ("ridge_health",      w.has<SurfaceRange>());
  force.add<contact_force>              ("contact_force",     in_plane<D> && touching);
  force.add<space::contact_force>       ("contact_force",     in_space<D> && touching);
  // clang-format on
}

// F: the formulation of the scene's elements.
template <class F>
StepList step_list_of(World& w) {
  using D = typename F::Dimension;
  const Contacts<D> contacts(w);
  const bool constraints = w.has<ConstraintReaction>();
  const bool moved = contacts.tools || constraints;
  const bool cell = w.has<PeriodicCell<D>>();
  SystemList force(w), move(w);

  // clang-format off
  force.add<tool_motion>                ("tool_motion",       moved);
  add_contacts<D>(w, force);
  force.add<cell_load<D>>               ("cell_load",         cell);
  force.add<cell_control<D>>            ("cell_control",      cell);
  add_element_forces<F>(w, force);
  add_time_step<F>(w, force);
  force.add<apply_constraints<D>>       ("apply_constraints", constraints);
  force.add<tool_reaction<D>>           ("tool_reaction",     moved);
  force.add<wall_control<D>>            ("wall_control",      w.has<DrivenWalls>());
  force.add<stage_control<D>>           ("stage_control",     w.has<StageEnds>());
  force.add<tool_servo<D>>              ("tool_servo",        w.has<ToolServos>());

  move.add<cell_kick<D>>                ("cell_kick",         cell);
  move.add<integrate<D>>                ("integrate");
  move.add<contact_curve>               ("contact_curve",     in_plane<D> && contacts.any());
  move.add<space::contact_surface>      ("contact_surface",   in_space<D> && contacts.any());
  move.add<surface_hardness<F>>         ("surface_hardness",  w.has<SurfaceHardness<D>>());
  move.add<send_outlines<D>>            ("send_outlines",     contacts.ranks);
  move.add<cell_motion<D>>              ("cell_motion",       cell);
  move.add<element_health>              ("element_health");
  move.add<return_health>               ("return_health",     w.has<ReturnResidual>());
  move.add<advance_clock<D>>            ("advance_clock");
  // clang-format on
  return {force.taken(), observed_of<F>(w), move.taken()};
}

// What touches at the start is known only after the contact search.
template <class D>
void add_first_contacts(World& w, SystemList& start) {
  using SpacePairBonds = space::BondOffset<FaceContact>;
  using SpaceToolBonds = space::BondOffset<FaceToolContact>;
  const auto [pairs, tools, ranks] = Contacts<D>(w);
  const bool bonds = w.has<BondTotals>();

  // clang-format off
  start.add<skin_check<D>>              ("skin_check",        pairs || tools);
  start.add<find_border<D>>             ("find_border",       ranks);
  start.add<bin_edges>                  ("bin_edges",         in_plane<D> && pairs);
  start.add<space::bin_faces>           ("bin_faces",         in_space<D> && pairs);
  start.add<bin_tool_edges>             ("bin_tool_edges",    in_plane<D> && tools);
  start.add<space::bin_tool_faces>      ("bin_tool_faces",    in_space<D> && tools);
  start.add<list_border_rows>           ("list_border_rows",  in_plane<D> && ranks);
  start.add<list_border_pairs>          ("list_border_pairs", in_space<D> && ranks);
  start.add<edge_contact>               ("edge_contact",      in_plane<D> && pairs);
  start.add<space::face_contact>        ("face_contact",      in_space<D> && pairs);
  start.add<tool_contact>               ("tool_contact",      in_plane<D> && tools);
  start.add<space::tool_contact>        ("tool_contact",      in_space<D> && tools);
  start.add<initial_bonds>              ("initial_bonds",     w.has<CurveAnchor>());
  start.add<space::initial_bonds>       ("initial_bonds",     w.has<SpacePairBonds>());
  start.add<initial_tool_bonds>         ("initial_tool_bonds", w.has<ToolAnchor>());
  start.add<space::initial_tool_bonds>  ("initial_tool_bonds", w.has<SpaceToolBonds>());
  start.add<initial_bond_totals>        ("initial_bond_totals", bonds && w.has<RankLink>());
  start.add<first_penetration>          ("first_penetration", pairs || tools);
  // clang-format on
}

template <class F>
std::vector<System> start_list_of(World& w) {
  using D = typename F::Dimension;
  const bool touching = Contacts<D>(w).any();
  SystemList start(w);
  start.add<contact_curve>("contact_curve", in_plane<D> && touching);
  start.add<space::contact_surface>("contact_surface", in_space<D> && touching);
  start.add<surface_hardness<F>>("surface_hardness", w.has<SurfaceHardness<D>>());
  add_first_contacts<D>(w, start);
  add_time_step<F>(w, start);
  start.add<first_time_step<D>>("first_time_step");
  return start.taken();
}

bool is_in_space(const World& w) { return w.has<space::Shapes>(); }

// visit(F{}) with the formulation of the scene's elements.
template <class Visit>
auto with_formulation_of(const World& w, const Visit& visit) {
  const Formulation formulation = w.resource<Bodies>().formulation;
  return is_in_space(w) ? space::with_hexahedra(formulation, visit)
                        : with_formulation(formulation, visit);
}

}  // namespace

StepList step_list(World& w) {
  return with_formulation_of(w, [&]<class F>(F) { return step_list_of<F>(w); });
}

std::vector<System> start_list(World& w) {
  return with_formulation_of(w, [&]<class F>(F) { return start_list_of<F>(w); });
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
  SystemList observe(world, When::on_sample);
  if (is_in_space(world))
    observe_whole<ThreeD>(world, observe);
  else
    observe_whole<TwoD>(world, observe);
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
      observed_(
          watched(joined(step_list(world).forces, step_list(world).observe), world, *failure_),
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
