// Declarations of force-controlled tools, and of stages that end early.
#include "scenes/keys/declare.hpp"

namespace pulvis::schema {
namespace {

std::vector<Key<ServoSpec>> aims() {
  return {{{.name = "tool",
            .kind = Kind::reference,
            .refers_to = "tool",
            .required = true,
            .doc = "Force-controlled tool, which has contact."},
           index_to(&ServoSpec::tool)},
          {{.name = "force",
            .kind = Kind::quantity,
            .unit = "N",
            .range = within(0, 1e12),
            .required = true,
            .doc = "Target force; in two dimensions for the slice of the scene's thickness."},
           to(&ServoSpec::force)},
          {{.name = "direction",
            .kind = Kind::direction,
            .doc = "Direction of the force exerted by the tool.",
            .fallback_doc = "the normal of a plane or punch; required for other tools"},
           [](ServoSpec& spec, const Decoded& value) { spec.direction = value.vector3; }}};
}

std::vector<Key<ServoSpec>> manners() {
  return {{{.name = "rise",
            .kind = Kind::number,
            .range = above(0, 1),
            .doc = "Fraction of the stage over which the target force changes smoothly from the "
                   "initial force on the tool to `force`.",
            .fallback_doc = "0.2, or from `rate`"},
           to(&ServoSpec::rise)},
          {{.name = "rate",
            .kind = Kind::quantity,
            .unit = "N/s",
            .range = above(0, 1e18),
            .doc = "Alternative to `rise`: mean rate of change of the target force during its "
                   "smooth ramp.",
            .fallback_doc = "from `rise`"},
           to(&ServoSpec::rate)},
          {{.name = "response",
            .kind = Kind::number,
            .range = within(1e-3, 100),
            .fallback = value_of(0.1),
            .doc = "Mass moved by the servo force in addition to the powder, divided by the mass "
                   "of the whole powder: smaller values hold the force more tightly, larger "
                   "values run more smoothly. Contact with the tool may require more."},
           to(&ServoSpec::response)},
          {{.name = "max_speed",
            .formerly = "fastest",
            .kind = Kind::quantity,
            .unit = "m/s",
            .range = within(1e-9, 1e4),
            .fallback = value_of("10 m/s"),
            .doc = "Maximum speed of the servo, whatever the force error. On the way to a higher "
                   "force the speed is also limited by the stiffness of the powder, so that the "
                   "force is not passed."},
           to(&ServoSpec::max_speed)},
          {{.name = "tolerance",
            .kind = Kind::number,
            .range = above(0, 1e9),
            .fallback = value_of(0.05),
            .doc = "Allowed force error over the last tenth of the stage, as a fraction of the "
                   "force. If it is exceeded, the run stops and reports the force reached. A force "
                   "that is passed by more at any time is reported in the table of quality."},
           to(&ServoSpec::tolerance)}};
}

}  // namespace

const TableDeclaration<ServoSpec>& servo() {
  static const TableDeclaration<ServoSpec> declaration = [] {
    TableDeclaration<ServoSpec> made{
        {"stage.servo", true, "",
         "A tool under force control during the preceding stage, at whatever "
         "displacement the force requires. In the next stage it keeps its last position "
         "unless that stage has a servo for it too."},
        aims()};
    for (const auto& key : manners()) made.keys.push_back(key);
    return made;
  }();
  return declaration;
}

const TableDeclaration<UntilSpec>& until() {
  static const TableDeclaration<UntilSpec> declaration{
      {"stage.until", false, "",
       "Ends the preceding stage before its duration is over, at a displacement, relative "
       "density or force. Its tools (or the strains of a periodic cell) come to rest as smoothly "
       "as they started. At "
       "a displacement or relative density they are then at rest, as they begin to slow "
       "down before it. A force is not known in advance: they begin to slow down where it "
       "is reached, it rises further, and [[stage.servo]] holds one. If the condition is "
       "not met within the duration of the stage, the run stops. Exactly one of `force`, "
       "`displacement` and `relative_density` is given.",
       compaction_only, true},
      {{{.name = "tool",
         .kind = Kind::reference,
         .refers_to = "tool",
         .doc = "Tool whose force or displacement is monitored.",
         .fallback_doc = "required with `force` and `displacement`"},
        [](UntilSpec& spec, const Decoded& value) { spec.tool = value.index; }},
       {{.name = "force",
         .kind = Kind::quantity,
         .unit = "N",
         .range = above(0, 1e12),
         .needs = "tool",
         .doc = "Force of the powder on the tool from which on the stage slows down: against the "
                "normal of a plane or punch, the magnitude for other tools.",
         .fallback_doc = "none"},
        to(&UntilSpec::force)},
       {{.name = "displacement",
         .kind = Kind::quantity,
         .unit = "m",
         .range = above(0, largest_size),
         .needs = "tool",
         .doc = "Distance of the tool at rest from its position at the start of the stage.",
         .fallback_doc = "none"},
        to(&UntilSpec::displacement)},
       {{.name = "relative_density",
         .kind = Kind::number,
         .range = above(0, 2),
         .doc = "Relative density of the powder in a die of four planes, or in a periodic cell, "
                "after its tools or strains have come to rest.",
         .fallback_doc = "none",
         .in_3d = {.doc =
                       "Relative density of the powder between six planes, or in a cylindrical die "
                       "between two planes or punches, after they have come to rest."}},
        to(&UntilSpec::relative_density)}}};
  return declaration;
}

}  // namespace pulvis::schema
