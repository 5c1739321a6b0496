// Declarations of what happens to the powder: placement by hand, stages, friction, and the settings
// of a run.
#include "scenes/keys/declare.hpp"

namespace pulvis::schema {

const TableDeclaration<BodySpec>& body() {
  static const TableDeclaration<BodySpec> declaration{
      {"body", true, "", "One particle, placed by hand."},
      {{{.name = "particle",
         .kind = Kind::reference,
         .refers_to = "particle",
         .required = true,
         .doc = "Its class."},
        index_to(&BodySpec::particle)},
       {{.name = "position",
         .kind = Kind::vector,
         .unit = "m",
         .range = within(-largest_size, largest_size),
         .required = true,
         .doc = "Centre of the outline."},
        to(&BodySpec::position)},
       {{.name = "angle",
         .kind = Kind::quantity,
         .unit = "rad",
         .range = within(-1000, 1000),
         .fallback = value_of("0 deg"),
         .doc = "Turn, counter-clockwise."},
        to(&BodySpec::angle)},
       {{.name = "velocity",
         .kind = Kind::vector,
         .unit = "m/s",
         .range = within(-1e5, 1e5),
         .fallback = pair_of("0 m/s", "0 m/s"),
         .doc = "Initial velocity of the centre."},
        to(&BodySpec::velocity)},
       {{.name = "angular_velocity",
         .kind = Kind::quantity,
         .unit = "rad/s",
         .range = within(-1e12, 1e12),
         .fallback = value_of("0 rad/s"),
         .doc = "Initial spin, counter-clockwise."},
        to(&BodySpec::angular_velocity)}}};
  return declaration;
}

const TableDeclaration<StageSpec>& stage() {
  static const TableDeclaration<StageSpec> declaration{
      {"stage", true, "", "A part of the run; stages follow each other in the order of the file."},
      {{{.name = "name", .kind = Kind::name, .required = true, .doc = "Shown in the report."},
        to(&StageSpec::name)},
       {{.name = "kind",
         .kind = Kind::choice,
         .choices = {{"settle", "no tool moves, the particles come to rest"},
                     {"compact", "tools move and load the powder"},
                     {"hold", "no tool moves, the load is kept"},
                     {"unload", "tools move back"},
                     {"eject", "tools move and push the compact out of the die"},
                     {"shear", "tools move and draw a surface along under the powder"}},
         .required = true,
         .doc = "What the stage is for."},
        [](StageSpec& spec, const Decoded& value) {
          spec.kind = static_cast<StageSpec::Kind>(value.index);
        }},
       {{.name = "duration",
         .kind = Kind::quantity,
         .unit = "s",
         .range = within(1e-15, 1e6),
         .required = true,
         .doc = "Simulated time."},
        to(&StageSpec::duration)},
       {{.name = "keep_state",
         .kind = Kind::flag,
         .fallback = value_of(false),
         .doc = "Keep the state at the stage's end as `state-<name>.h5` in the run's folder: other "
                "scenes can begin with it (`initial_state`)."},
        [](StageSpec& spec, const Decoded& value) { spec.keep_state = value.flag; }}}};
  return declaration;
}

const TableDeclaration<MoveSpec>& move() {
  static const TableDeclaration<MoveSpec> declaration{
      {"stage.move", true, "", "What one tool does during the stage above it."},
      {{{.name = "tool",
         .kind = Kind::reference,
         .refers_to = "tool",
         .required = true,
         .doc = "The tool that moves."},
        index_to(&MoveSpec::tool)},
       {{.name = "displacement",
         .kind = Kind::vector,
         .unit = "m",
         .range = within(-largest_size, largest_size),
         .required = true,
         .doc = "Displacement over the stage."},
        to(&MoveSpec::displacement)},
       {{.name = "ramp",
         .kind = Kind::number,
         .range = above(0, 0.5),
         .fallback = value_of(0.1),
         .doc =
             "Share of the stage in which the speed rises smoothly, and falls again at its end."},
        to(&MoveSpec::ramp)},
       {{.name = "stiffness",
         .kind = Kind::quantity,
         .unit = "N/m",
         .range = above(0, 1e15),
         .needs = "mass",
         .doc = "Of a drive that gives, along the displacement, which is then that of its far end: "
                "the tool follows as a mass on a spring, on the slice of the scene's thickness. In "
                "the stage after it the tool stands where it was left, unless that drives it so, "
                "too.",
         .fallback_doc = "rigid: the tool moves as the displacement says"},
        to(&MoveSpec::stiffness)},
       {{.name = "mass",
         .kind = Kind::quantity,
         .unit = "kg",
         .range = above(0, 1e9),
         .needs = "stiffness",
         .doc = "Of the tool with what is fixed to it. What touches the tool may ask for more: a "
                "run stops where the mass is too small for its time step.",
         .fallback_doc = "required with `stiffness`"},
        to(&MoveSpec::mass)},
       {{.name = "damping",
         .kind = Kind::number,
         .range = within(0, 10),
         .fallback = value_of(0.0),
         .needs = "stiffness",
         .doc =
             "Dashpot beside the spring, as a share of the critical damping of spring and mass."},
        to(&MoveSpec::damping)}}};
  return declaration;
}

const TableDeclaration<FrictionSpec>& friction() {
  static const TableDeclaration<FrictionSpec> declaration{
      {"friction", true, "", "Friction of one pair, instead of `contact.friction`."},
      {{{.name = "between",
         .kind = Kind::name_pair,
         .required = true,
         .doc = "Two materials, or a material and a tool; a material may meet itself."},
        [](FrictionSpec& spec, const Decoded& value) {
          spec.first = value.names[0];
          spec.second = value.names[1];
        }},
       {{.name = "coefficient",
         .kind = Kind::number,
         .range = within(0, 10),
         .required = true,
         .doc = "Coulomb's coefficient; the dynamic one where there is a static one."},
        to(&FrictionSpec::coefficient)},
       {{.name = "static_coefficient",
         .kind = Kind::number,
         .range = within(0, 10),
         .needs = "decay_length",
         .doc = "Of surfaces that have not slid against each other since they met.",
         .fallback_doc = "`coefficient`"},
        to(&FrictionSpec::static_coefficient)},
       {{.name = "decay_length",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .needs = "static_coefficient",
         .doc = "Sliding distance in which what the static coefficient is above the dynamic one "
                "falls to "
                "1/e.",
         .fallback_doc = "required with `static_coefficient`"},
        to(&FrictionSpec::decay_length)},
       {{.name = "shear_strength",
         .kind = Kind::quantity,
         .unit = "Pa",
         .range = above(0, 1e13),
         .doc = "Shear stress that the surfaces do not pass at any pressure.",
         .fallback_doc = "none"},
        to(&FrictionSpec::shear_strength)},
       {{.name = "rate",
         .kind = Kind::number,
         .range = within(-1, 1),
         .needs = "reference_speed",
         .doc = "What sliding with the speed v adds to the coefficients: rate x ln(1 + v/v_0); "
                "negative where friction falls with speed. They do not fall below 0.",
         .fallback_doc = "friction does not depend on speed"},
        to(&FrictionSpec::rate)},
       {{.name = "reference_speed",
         .kind = Kind::quantity,
         .unit = "m/s",
         .range = within(1e-9, 1e4),
         .needs = "rate",
         .doc = "v_0: well below it the coefficients are those given. A rising law of a v_0 far "
                "below the speeds that occur is stiff and chatters.",
         .fallback_doc = "required with `rate`"},
        to(&FrictionSpec::reference_speed)}}};
  return declaration;
}

const TableDeclaration<ContactSpec>& contact() {
  static const TableDeclaration<ContactSpec> declaration{
      {"contact", false, "", "Contact of everything with everything."},
      {{{.name = "friction",
         .kind = Kind::number,
         .range = within(0, 10),
         .fallback = value_of(0.0),
         .doc = "Coulomb's coefficient of every pair that no `[[friction]]` names."},
        to(&ContactSpec::friction)},
       // Softer than 0.3, the punch force of the unit cell is more than 2% below that of the default.
       {{.name = "stiffness",
         .kind = Kind::number,
         .range = within(0.35, 100),
         .fallback = value_of(0.5),
         .doc = "Contact stiffness over bulk modulus times edge length over element area. Elastic "
                "contacts and relative densities above 0.97 want 10: a run tells what force it "
                "misses."},
        to(&ContactSpec::stiffness)},
       {{.name = "damping",
         .kind = Kind::number,
         .range = within(0, 1),
         .fallback = value_of(0.0),
         .doc = "Share of the critical damping of the contact spring."},
        to(&ContactSpec::damping)},
       {{.name = "skin",
         .kind = Kind::number,
         .range = within(0.01, 10),
         .fallback = value_of(0.2),
         .doc = "Share of the shortest edge that surfaces may approach each other before the "
                "search for "
                "contacts is done anew. Costs time only, changes no result."},
        to(&ContactSpec::skin)}}};
  return declaration;
}

const TableDeclaration<ElementSpec>& element() {
  static const TableDeclaration<ElementSpec> declaration{
      {"element", false, "", "The finite elements of all particles: quads."},
      {{{.name = "formulation",
         .kind = Kind::choice,
         .choices = {{"four-point",
                      "2x2 Gauss points, one dilatation (mean dilatation): few rows of them bend "
                      "wrongly, one by -60% to several times (docs/accuracy.md)"},
                     {"one-point",
                      "one point, hourglass modes held by elastic-plastic bending: faster"},
                     {"standard",
                      "2x2 Gauss points, each with its own dilatation: locks, for comparison"}},
         .fallback = value_of("one-point"),
         .doc = "Where an element takes its stresses."},
        [](ElementSpec& spec, const Decoded& value) {
          spec.formulation = static_cast<Formulation>(value.index);
        }}}};
  return declaration;
}

const TableDeclaration<TimeSpec>& time() {
  static const TableDeclaration<TimeSpec> declaration{
      {"time", false, "", "Time integration."},
      {{{.name = "safety",
         .kind = Kind::number,
         .range = between(0, 1),
         .fallback = value_of(0.9),
         .doc = "Share of the stable time step that is used."},
        to(&TimeSpec::safety)},
       {{.name = "estimate",
         .kind = Kind::choice,
         .choices = {{"element", "that of the fastest element, as if it swung alone: a bound"},
                     {"highest-mode",
                      "that of each particle's fastest oscillation as a whole, followed by power "
                      "iteration: up to a quarter longer"}},
         .fallback = value_of("element"),
         .doc = "What the stable time step is taken from."},
        [](TimeSpec& spec, const Decoded& value) {
          spec.estimate = static_cast<TimeSpec::Estimate>(value.index);
        }}}};
  return declaration;
}

const TableDeclaration<OutputSpec>& output() {
  static const TableDeclaration<OutputSpec> declaration{
      {"output", false, "", "How much is written."},
      {{{.name = "frames",
         .kind = Kind::integer,
         .range = within(1, 1e6),
         .fallback = value_of(50),
         .doc = "Fields written over the run, besides the first."},
        integer_to(&OutputSpec::frames)},
       {{.name = "samples",
         .kind = Kind::integer,
         .range = within(1, 1e8),
         .fallback = value_of(1000),
         .doc = "Rows of the history over the run, besides the first."},
        integer_to(&OutputSpec::samples)},
       {{.name = "density_cells",
         .kind = Kind::counts,
         .range = within(1, 1000),
         .doc =
             "Columns and rows of a grid between the tools whose cells' relative densities are "
             "kept: in every frame, and their minimum, maximum and standard deviation over time. "
             "Needs a tool on each of the four sides.",
         .fallback_doc = "no local densities"},
        [](OutputSpec& spec, const Decoded& value) { spec.density_cells = value.counts; }},
       {{.name = "contacts",
         .kind = Kind::flag,
         .fallback = value_of(false),
         .doc =
             "The network of contacts: forces, normals and lengths of every pair that touches and "
             "force chains in every frame; coordination, fabric and mean forces over time."},
        flag_to(&OutputSpec::contacts)},
       {{.name = "particle_stress",
         .kind = Kind::flag,
         .fallback = value_of(false),
         .doc =
             "Mean stress of every particle in every frame, of the compact over time. The network "
             "of contacts has it, too."},
        flag_to(&OutputSpec::particle_stress)}}};
  return declaration;
}

const TableDeclaration<LimitSpec>& limits() {
  static const TableDeclaration<LimitSpec> declaration{
      {"limits", false, "", "Health: a run that passes one of these stops."},
      {{{.name = "energy_balance",
         .kind = Kind::number,
         .range = above(0, 1e6),
         .fallback = value_of(0.05),
         .doc =
             "`energy_balance_error`: error of the energy balance over the largest energy so far."},
        to(&LimitSpec::energy_balance)},
       {{.name = "penetration",
         .kind = Kind::number,
         .range = above(0, 1e6),
         .fallback = value_of(0.5),
         .doc = "Penetration over the length of a boundary edge, of a tool's corner in an outline "
                "and of an outline in itself, too."},
        to(&LimitSpec::penetration)},
       {{.name = "unconverged_projections",
         .kind = Kind::number,
         .range = within(0, 1),
         .fallback = value_of(1e-3),
         .doc = "Share of the closest points of contacting outlines that Newton's method did not "
                "find, of all so far, or of the first 10,000. Sound runs have one in a million at "
                "most; a thousandth is below what the mesh costs in force."},
        to(&LimitSpec::unconverged_projections)},
       {{.name = "kinetic_energy",
         .kind = Kind::number,
         .range = above(0, 1e6),
         .doc = "`kinetic_ratio`: largest kinetic over internal energy, judged from a tenth of the "
                "run on; for "
                "runs meant to be quasi-static.",
         .fallback_doc = "no limit"},
        to(&LimitSpec::kinetic_energy)}}};
  return declaration;
}

}  // namespace pulvis::schema
