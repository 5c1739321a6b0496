#include "systems/space/step.hpp"

#include "components/observed.hpp"
#include "components/space/observed.hpp"
#include "engine/system_list.hpp"
#include "systems/contact/systems.hpp"
#include "systems/ranks/systems.hpp"
#include "systems/space/body/systems.hpp"
#include "systems/space/contact/systems.hpp"
#include "systems/space/observe/systems.hpp"
#include "systems/space/tools/systems.hpp"
#include "systems/tools/systems.hpp"

namespace pulvis::space {
namespace {

struct Touches {  // which kinds of contact are possible
  bool pairs, tools;
  explicit Touches(const World& w)
      : pairs(w.has<ContactPair<FaceContact>>()), tools(w.has<ContactPair<FaceToolContact>>()) {}
  bool any() const { return pairs || tools; }
};

// In sampled steps: of the powder as a whole...
void observe_whole(World& w, SystemList& observe) {
  // clang-format off
  observe.add<contact_network>    ("contact_network",   w.has<ContactNetwork<ThreeD>>());
  observe.add<fragments>          ("fragments",         w.has<Fragments>());
  observe.add<force_chains>       ("force_chains",      w.has<ForceChains>());
  observe.add<local_density>      ("local_density",     w.has<DensityGrid>());
  // clang-format on
}
// ...and all observers, once the forces are known.
template <class F>
std::vector<System> observed_in_space(World& w) {
  SystemList observe(w, When::on_sample);

  // clang-format off
  observe.add<kinetic_energy<ThreeD>>("kinetic_energy");
  observe.add<elastic_energy<F>>  ("elastic_energy");
  observe.add<node_spring_energy> ("node_spring_energy", w.has<Roughness>());
  observe.add<node_distance>      ("node_distance",     w.has<NodeDistance>());
  observe.add<plastic_work<F>>    ("plastic_work",      w.has<PlasticStrain<F::points>>());
  observe.add<hourglass_energy>   ("hourglass_energy",  F::stabilised);
  observe.add<particle_stress<F>> ("particle_stress",   w.has<ParticleStress<ThreeD>>());
  observe.add<contact_quality>    ("contact_quality",   w.has<ContactQuality>());
  // clang-format on
  if (!w.has<RankLink>()) observe_whole(w, observe);
  return observe.taken();
}

// ---- the order of a step: start reading here -----------------------------------------------------
// F: formulation of the elements of the scene (components/space/formulation.hpp).
template <class F>
Steps steps_with(World& w) {
  const bool plastic = w.has<PlasticStrain<F::points>>();
  const Touches touches(w);
  const bool ranks = w.has<RankLink>() && touches.pairs;
  SystemList force(w), move(w);

  // clang-format off
  force.add<tool_motion>         ("tool_motion",       touches.tools);
  force.add<receive_outlines<ThreeD>>("receive_outlines", ranks);
  force.add<skin_check<ThreeD>>  ("skin_check",        touches.any());
  force.add<find_border<ThreeD>>  ("find_border",       ranks);
  force.add<bin_faces>           ("bin_faces",         touches.pairs);
  force.add<bin_tool_faces>      ("bin_tool_faces",    touches.tools);
  force.add<list_border_pairs>   ("list_border_pairs", ranks);
  force.add<face_contact>        ("face_contact",      touches.pairs);
  force.add<send_loads>          ("send_loads",        ranks);
  force.add<tool_contact>        ("tool_contact",      touches.tools);
  force.add<receive_loads>       ("receive_loads",     ranks);
  force.add<contact_totals>      ("contact_totals",    touches.any());
  force.add<bond_totals>         ("bond_totals",       w.has<BondTotals>());
  force.add<contact_health<ThreeD>>("contact_health",    touches.any());
  force.add<contact_force>       ("contact_force",     touches.any());
  force.add<elastic_force<F>>    ("elastic_force",     !plastic);
  force.add<plastic_force<F>>    ("plastic_force",     plastic);
  force.add<damping_force<F>>    ("damping_force",     w.has<DampingForce<ThreeD>>());
  force.add<stable_time_step<F>> ("stable_time_step");
  force.add<tool_reaction<ThreeD>>("tool_reaction",     touches.tools);
  force.add<stage_control>       ("stage_control",     w.has<StageEnds>());
  force.add<tool_servo<ThreeD>>  ("tool_servo",        w.has<ToolServos>());

  move.add<integrate<ThreeD>>    ("integrate");
  move.add<contact_surface>      ("contact_surface",   touches.any());
  move.add<send_outlines<ThreeD>> ("send_outlines",     ranks);
  move.add<element_health>       ("element_health");
  move.add<return_health>        ("return_health",     w.has<ReturnResidual>());
  move.add<advance_clock>        ("advance_clock");
  // clang-format on
  return {force.taken(), observed_in_space<F>(w), move.taken()};
}

template <class F>
std::vector<System> start_with(World& w) {
  const Touches touches(w);
  const bool ranks = w.has<RankLink>() && touches.pairs;
  SystemList start(w);
  start.add<contact_surface>("contact_surface", touches.any());
  start.add<skin_check<ThreeD>>("skin_check", touches.any());
  start.add<find_border<ThreeD>>("find_border", ranks);
  start.add<bin_faces>("bin_faces", touches.pairs);
  start.add<bin_tool_faces>("bin_tool_faces", touches.tools);
  start.add<list_border_pairs>("list_border_pairs", ranks);
  start.add<face_contact>("face_contact", touches.pairs);
  start.add<tool_contact>("tool_contact", touches.tools);
  start.add<initial_bonds>("initial_bonds", w.has<BondOffset<FaceContact>>());
  start.add<initial_tool_bonds>("initial_tool_bonds", w.has<BondOffset<FaceToolContact>>());
  start.add<initial_bond_totals>("initial_bond_totals", w.has<BondTotals>() && ranks);
  start.add<first_penetration>("first_penetration", touches.any());
  start.add<stable_time_step<F>>("stable_time_step");
  start.add<first_time_step>("first_time_step");
  return start.taken();
}

Formulation formulation_of(const World& w) { return w.resource<Bodies>().formulation; }

}  // namespace

Steps steps_of(World& w) {
  return with_hexahedra(formulation_of(w), [&]<class F>(F) { return steps_with<F>(w); });
}

std::vector<System> observers_of_whole(World& w) {
  SystemList observe(w, When::on_sample);
  observe_whole(w, observe);
  return observe.taken();
}

std::vector<System> start_of(World& w) {
  return with_hexahedra(formulation_of(w), [&]<class F>(F) { return start_with<F>(w); });
}

}  // namespace pulvis::space
