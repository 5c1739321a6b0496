// Declarations of the process: stages, friction, and the settings
// of a run.
#include "scenes/keys/declare.hpp"

namespace pulvis::schema {

const TableDeclaration<StageSpec>& stage() {
  static const TableDeclaration<StageSpec> declaration{
      {"stage", true, "", "A stage of the run; stages run in file order."},
      {{{.name = "name", .kind = Kind::name, .required = true, .doc = "Name shown in the report."},
        to(&StageSpec::name)},
       {{.name = "kind",
         .kind = Kind::choice,
         .choices = words_of<StageSpec::Kind>(
             {{"settle", "tools are fixed while the particles come to rest"},
              {"compact", "tools move and load the powder"},
              {"hold", "tools are fixed and hold the load"},
              {"unload", "tools move back"},
              {"eject", "tools move and push the compact out of the die"},
              {.word = "shear",
               .doc = "tools move and slide a surface under the powder",
               .dimension = Dimension::two}}),
         .required = true,
         .doc = "Purpose of the stage."},
        word_to(&StageSpec::kind)},
       {{.name = "duration",
         .kind = Kind::quantity,
         .unit = "s",
         .range = within(1e-15, 1e6),
         .required = true,
         .doc = "Simulated time of the stage."},
        to(&StageSpec::duration)},
       {{.name = "keep_state",
         .kind = Kind::flag,
         .fallback = value_of(false),
         .doc = "Save the state at the end of the stage as `state-<name>.h5` in the run "
                "folder; other scenes can start from it (`initial_state`)."},
        [](StageSpec& spec, const Decoded& value) { spec.keep_state = value.flag; }}}};
  return declaration;
}

const TableDeclaration<MoveSpec>& move() {
  static const TableDeclaration<MoveSpec> declaration{
      {"stage.move", true, "", "Motion of a tool during the preceding stage."},
      {{{.name = "tool",
         .kind = Kind::reference,
         .refers_to = "tool",
         .required = true,
         .doc = "Tool that moves."},
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
         .doc = "Fraction of the stage over which the speed rises smoothly, and falls again at "
                "the end."},
        to(&MoveSpec::ramp)},
       {{.name = "stiffness",
         .kind = Kind::quantity,
         .unit = "N/m",
         .range = above(0, 1e15),
         .needs = "mass",
         .doc = "Stiffness of a compliant drive along the displacement, for the slice of the "
                "scene's thickness. The displacement then applies to the far end of the "
                "spring, and the tool follows as a mass on the spring. In the next stage the "
                "tool keeps its last position unless that stage also drives it through a "
                "spring.",
         .fallback_doc = "rigid: the tool follows the displacement exactly",
         .in_3d = {.doc = "Stiffness of a compliant drive along the displacement. The "
                          "displacement then applies to the far end of the spring, and the "
                          "tool follows as a mass on the spring. In the next stage the tool "
                          "keeps its last position unless that stage also drives it through a "
                          "spring. If that one has another direction, only the motion along it "
                          "continues."}},
        to(&MoveSpec::stiffness)},
       {{.name = "mass",
         .kind = Kind::quantity,
         .unit = "kg",
         .range = above(0, 1e9),
         .needs = "stiffness",
         .doc = "Mass of the tool and everything fixed to it. Contact with the tool may "
                "require more: a run stops if the mass is too small for its time step.",
         .fallback_doc = "required with `stiffness`"},
        to(&MoveSpec::mass)},
       {{.name = "damping",
         .kind = Kind::number,
         .range = within(0, 10),
         .fallback = value_of(0.0),
         .needs = "stiffness",
         .doc = "Damping of the spring, as a fraction of the critical damping of spring and "
                "mass."},
        to(&MoveSpec::damping)}}};
  return declaration;
}

const TableDeclaration<FrictionSpec>& friction() {
  static const TableDeclaration<FrictionSpec> declaration{
      {"friction", true, "", "Friction of one pair, overriding `contact.friction`."},
      {{{.name = "between",
         .kind = Kind::name_pair,
         .required = true,
         .doc = "Two materials, or a material and a tool; the two materials may be the same."},
        [](FrictionSpec& spec, const Decoded& value) {
          spec.first = value.names[0];
          spec.second = value.names[1];
        }},
       {{.name = "coefficient",
         .kind = Kind::number,
         .range = within(0, 10),
         .required = true,
         .doc = "Coulomb friction coefficient; the dynamic one if a static one is given."},
        to(&FrictionSpec::coefficient)},
       {{.name = "static_coefficient",
         .kind = Kind::number,
         .range = within(0, 10),
         .needs = "decay_length",
         .doc = "Static coefficient: applies to surfaces that have not slid since they came "
                "into contact.",
         .fallback_doc = "`coefficient`"},
        to(&FrictionSpec::static_coefficient)},
       {{.name = "decay_length",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .needs = "static_coefficient",
         .doc = "Sliding distance over which the excess of the static over the dynamic "
                "coefficient decays to 1/e.",
         .fallback_doc = "required with `static_coefficient`"},
        to(&FrictionSpec::decay_length)},
       {{.name = "shear_strength",
         .kind = Kind::quantity,
         .unit = "Pa",
         .range = above(0, 1e13),
         .doc = "Upper limit of the frictional shear stress at any pressure.",
         .fallback_doc = "none"},
        to(&FrictionSpec::shear_strength)},
       {{.name = "rate",
         .kind = Kind::number,
         .range = within(-1, 1),
         .needs = "reference_speed",
         .doc = "Rate dependence: sliding at speed v adds rate x ln(1 + v/v_0) to the "
                "coefficients; negative if friction decreases with speed. Coefficients do not "
                "fall below 0.",
         .fallback_doc = "no rate dependence"},
        to(&FrictionSpec::rate)},
       {{.name = "reference_speed",
         .kind = Kind::quantity,
         .unit = "m/s",
         .range = within(1e-9, 1e4),
         .needs = "rate",
         .doc = "v_0: well below this speed the coefficients have the given values. An "
                "increasing law with v_0 far below the actual speeds is stiff and causes "
                "chatter.",
         .fallback_doc = "required with `rate`"},
        to(&FrictionSpec::reference_speed)}}};
  return declaration;
}

const TableDeclaration<ContactSpec>& contact() {
  static const TableDeclaration<ContactSpec> declaration{
      {"contact", false, "", "Contact between all bodies and tools."},
      {{{.name = "friction",
         .kind = Kind::number,
         .range = within(0, 10),
         .fallback = value_of(0.0),
         .doc = "Coulomb friction coefficient of all pairs not listed in a `[[friction]]`."},
        to(&ContactSpec::friction)},
       // Below 0.3, the punch force of the unit cell is more than 2% too low.
       {{.name = "stiffness",
         .kind = Kind::number,
         .range = within(0.35, 100),
         .doc = "Stiffness of the contact springs, as a multiple of bulk modulus times edge length "
                "divided by the area of the element behind the edge. Soft springs give way as "
                "well as the particles do, so that elastic contacts, springback, residual stress "
                "and moduli are too soft. The run reports the resulting errors.",
         .fallback_doc = "14",
         .in_3d = {.doc = "Stiffness of the contact springs, as a multiple of bulk modulus times "
                          "face area divided by the volume of the element behind the face, on "
                          "average over the surface of a particle. Soft springs give way as well "
                          "as the particles do, so that elastic "
                          "contacts, springback, residual stress and moduli are too soft. The "
                          "run reports the resulting errors.",
                   .fallback_doc = "20"}},
        to(&ContactSpec::stiffness)},
       {{.name = "tangential_stiffness",
         .kind = Kind::number,
         .range = within(0.1, 100),
         .doc = "Stiffness of the tangential springs of friction, measured like `stiffness`. "
                "More than 0.4 of `stiffness` costs time steps.",
         .fallback_doc = "`stiffness` up to 2, above 0.4 of it, but at least 2"},
        to(&ContactSpec::tangential_stiffness)},
       {{.name = "hardness",
         .kind = Kind::number,
         .range = within(1, 1000),
         .doc =
             "Indentation hardness of the surfaces over their flow stress (constraint factor). "
             "A contact narrower than an element cannot indent it; where the contact pressure "
             "exceeds the mean pressure of the element behind plus this multiple of its flow "
             "stress, the surface indents permanently instead. 1000: surfaces do not indent. Only "
             "for materials that yield, without a rate law, and a `stiffness` of 5 or more.",
         .fallback_doc = "3 for a `stiffness` of 5 or more"},
        to(&ContactSpec::hardness)},
       {{.name = "inertance",
         .kind = Kind::number,
         .range = within(0, 0.95),
         .doc = "Inerters between the boundary nodes and two layers behind them, so that stiff "
                "contact springs do not shorten the time step: share of the reduced mass of two "
                "nodes. They add no mass to the motion of a particle as a whole, and do not act at "
                "rest.",
         .fallback_doc =
             "0.9 if `stiffness` is above 2, otherwise 0; 0 for a single body without tools"},
        to(&ContactSpec::inertance)},
       {{.name = "damping",
         .kind = Kind::number,
         .range = within(0, 1),
         .fallback = value_of(0.0),
         .doc = "Fraction of the critical damping of the contact spring."},
        to(&ContactSpec::damping)},
       {{.name = "skin",
         .kind = Kind::number,
         .range = within(0.01, 10),
         .fallback = value_of(0.2),
         .doc = "Skin distance of the contact search, as a fraction of the shortest edge, in "
                "three dimensions of the smallest face: how far surfaces may approach each other "
                "before the search is repeated. It affects run time, not results."},
        to(&ContactSpec::skin)}}};
  return declaration;
}

const TableDeclaration<ElementSpec>& element() {
  static const TableDeclaration<ElementSpec> declaration{
      {"element", false, "",
       "Finite elements of all particles: quads, in three dimensions 8-node hexahedra."},
      {{{.name = "formulation",
         .kind = Kind::choice,
         .choices = {{.word = "four-point",
                      .doc = "2x2 Gauss points with a single dilatation (mean dilatation); "
                             "inaccurate in bending with few element rows: with one row, errors "
                             "range from -60% to a factor of several (docs/accuracy.md)",
                      .dimension = Dimension::two},
                     {"one-point",
                      "one Gauss point with hourglass modes stabilised by elastic-plastic "
                      "bending; faster"},
                     {.word = "standard",
                      .doc = "2x2 Gauss points, each with its own dilatation; locks, for "
                             "comparison only",
                      .dimension = Dimension::two},
                     {.word = "eight-point",
                      .doc = "2x2x2 Gauss points with a single dilatation (mean dilatation): the "
                             "reference",
                      .dimension = Dimension::three}},
         .fallback = value_of("one-point"),
         .doc = "Element formulation."},
        [](ElementSpec& spec, const Decoded& value) {
          constexpr std::array in_order{Formulation::four_point, Formulation::one_point,
                                        Formulation::standard, Formulation::four_point};
          spec.formulation = in_order.at(static_cast<std::size_t>(value.index));
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
         .doc = "Fraction of the stable time step that is used."},
        to(&TimeSpec::safety)},
       {{.name = "estimate",
         .kind = Kind::choice,
         .choices = words_of<TimeSpec::Estimate>(
             {{"element", "from the highest frequency of any single element: a lower bound"},
              {"highest-mode",
               "from the highest frequency of each whole particle, tracked by power "
               "iteration; up to a quarter longer"}}),
         .doc = "Basis of the stable time step.",
         .fallback_doc = "`highest-mode` if `contact.inertance` is above 0, otherwise `element`"},
        word_to(&TimeSpec::estimate)}}};
  return declaration;
}

const TableDeclaration<OutputSpec>& output() {
  static const TableDeclaration<OutputSpec> declaration{
      {"output", false, "", "Amount of output."},
      {{{.name = "frames",
         .kind = Kind::integer,
         .range = within(1, 1e6),
         .fallback = value_of(50),
         .doc = "Number of field outputs over the run, in addition to the initial one."},
        integer_to(&OutputSpec::frames)},
       {{.name = "samples",
         .kind = Kind::integer,
         .range = within(1, 1e8),
         .fallback = value_of(1000),
         .doc = "Number of rows of the history over the run, in addition to the initial one."},
        integer_to(&OutputSpec::samples)},
       {{.name = "density_cells",
         .kind = Kind::counts,
         .range = within(1, 1000),
         .doc = "Columns and rows of a grid between the tools in which local relative "
                "densities are recorded: in every frame, and their minimum, maximum and "
                "standard deviation over time. Requires a tool on each of the four sides.",
         .fallback_doc = "no local densities",
         .dimension = Dimension::two},
        [](OutputSpec& spec, const Decoded& value) { spec.density_cells = value.counts; }},
       {{.name = "density_cells",
         .kind = Kind::counts,
         .range = within(1, 200),
         .doc =
             "Number of cells along x, y and z of a grid between the tools in which local "
             "relative densities are recorded: in every frame, and their minimum, maximum "
             "and standard deviation over time. Requires an enclosed region: six planes "
             "along the axes, or a cylindrical die along one axis between two planes or punches.",
         .fallback_doc = "no local densities",
         .dimension = Dimension::three},
        [](OutputSpec& spec, const Decoded& value) { spec.density_cells3 = value.counts3; }},
       {{.name = "contacts",
         .kind = Kind::flag,
         .fallback = value_of(false),
         .doc = "Record the contact network: forces, normals and lengths (in three dimensions "
                "areas) of all touching pairs and force chains in every frame; coordination "
                "number, fabric and mean forces "
                "over time."},
        flag_to(&OutputSpec::contacts)},
       {{.name = "particle_stress",
         .kind = Kind::flag,
         .fallback = value_of(false),
         .doc = "Record the mean stress of every particle in every frame and of the compact "
                "over time. Included in `contacts`."},
        flag_to(&OutputSpec::particle_stress)}}};
  return declaration;
}

const TableDeclaration<LimitSpec>& limits() {
  static const TableDeclaration<LimitSpec> declaration{
      {"limits", false, "", "Health limits: a run that exceeds one of them stops."},
      {{{.name = "energy_balance",
         .kind = Kind::number,
         .range = above(0, 1e6),
         .fallback = value_of(0.05),
         .doc = "`energy_balance_error`: error of the energy balance divided by the largest "
                "energy so far."},
        to(&LimitSpec::energy_balance)},
       {{.name = "penetration",
         .kind = Kind::number,
         .range = above(0, 1e6),
         .fallback = value_of(0.5),
         .doc = "Penetration divided by the boundary edge length. Also applies to the corner "
                "of a tool in an outline and to self-penetration of an outline."},
        to(&LimitSpec::penetration)},
       {{.name = "unconverged_projections",
         .kind = Kind::number,
         .range = within(0, 1),
         .fallback = value_of(1e-3),
         .doc = "Fraction of closest-point projections between contacting outlines in which "
                "Newton's method failed to converge, relative to all projections so far but at "
                "least 10,000. Normal runs have at most one in a million; one in a thousand "
                "affects the force less than the mesh does."},
        to(&LimitSpec::unconverged_projections)},
       {{.name = "kinetic_energy",
         .kind = Kind::number,
         .range = above(0, 1e6),
         .doc = "`kinetic_ratio`: largest ratio of kinetic to internal energy under more than a "
                "tenth of the largest load and with more than 1% of the largest internal energy "
                "so far, checked at the end of every stage. "
                "Without it the quality table judges by 0.1 and the run goes on, unless bodies "
                "start with a velocity. A run that is dynamic on purpose sets a large value.",
         .fallback_doc = "none that stops the run"},
        to(&LimitSpec::kinetic_energy)}}};
  return declaration;
}

}  // namespace pulvis::schema
