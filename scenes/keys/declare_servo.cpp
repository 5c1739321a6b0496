// Declarations of tools that hold a force, and of stages that end early.
#include "scenes/keys/declare.hpp"

namespace pulvis::schema {
namespace {

std::vector<Key<ServoSpec>> aims() {
  return {{{.name = "tool",
            .kind = Kind::reference,
            .refers_to = "tool",
            .required = true,
            .doc = "The tool that holds the force: a plane or a polyline."},
           index_to(&ServoSpec::tool)},
          {{.name = "force",
            .kind = Kind::quantity,
            .unit = "N",
            .range = within(0, 1e12),
            .required = true,
            .doc = "With which it is to push, on the slice of the scene's thickness."},
           to(&ServoSpec::force)},
          {{.name = "direction",
            .kind = Kind::direction,
            .doc = "The direction in which it pushes.",
            .fallback_doc = "a plane's normal; required of polylines"},
           [](ServoSpec& spec, const Decoded& value) { spec.direction = value.vector; }}};
}

std::vector<Key<ServoSpec>> manners() {
  return {
      {{.name = "rise",
        .kind = Kind::number,
        .range = above(0, 1),
        .doc = "Share of the stage in which the force asked for goes smoothly from what the "
               "tool bears at its beginning to `force`.",
        .fallback_doc = "0.2, or by `rate`"},
       to(&ServoSpec::rise)},
      {{.name = "rate",
        .kind = Kind::quantity,
        .unit = "N/s",
        .range = above(0, 1e18),
        .doc = "Instead of `rise`: how fast the force asked for changes, in the mean of its "
               "smooth ramp.",
        .fallback_doc = "by `rise`"},
       to(&ServoSpec::rate)},
      {{.name = "response",
        .kind = Kind::number,
        .range = within(1e-3, 100),
        .fallback = value_of(0.1),
        .doc = "Mass that the set force has to move besides the powder, over that of the whole "
               "powder: less holds the force more tightly, more is calmer. What touches the tool "
               "may ask for more."},
       to(&ServoSpec::response)},
      {{.name = "max_speed",
        .formerly = "fastest",
        .kind = Kind::quantity,
        .unit = "m/s",
        .range = within(1e-9, 1e4),
        .fallback = value_of("10 m/s"),
        .doc = "Speed that the servo does not pass, whatever force is missing."},
       to(&ServoSpec::max_speed)},
      {{.name = "tolerance",
        .kind = Kind::number,
        .range = above(0, 1e9),
        .fallback = value_of(0.05),
        .doc = "Share of the force by which it may be off at the end of the stage; otherwise "
               "the run stops and says what was reached."},
       to(&ServoSpec::tolerance)}};
}

}  // namespace

const TableDeclaration<ServoSpec>& servo() {
  static const TableDeclaration<ServoSpec> declaration = [] {
    TableDeclaration<ServoSpec> made{
        {"stage.servo", true, "",
         "A tool that holds a force during the stage above it, whatever displacement that takes. "
         "In the "
         "stage after it, it stands where it was left, unless that has a servo for it too."},
        aims()};
    for (const auto& key : manners()) made.keys.push_back(key);
    return made;
  }();
  return declaration;
}

const TableDeclaration<UntilSpec>& until() {
  static const TableDeclaration<UntilSpec> declaration{
      {"stage.until", false, "",
       "Ends the stage above it before its time is over; its tools, or strains, then come to rest "
       "as "
       "smoothly as they started. A stage whose time is over before that stops the run. One of "
       "`force`, "
       "`displacement` and `relative_density`.",
       compaction_only, true},
      {{{.name = "tool",
         .kind = Kind::reference,
         .refers_to = "tool",
         .doc = "Whose force or displacement it is.",
         .fallback_doc = "required with `force` and `displacement`"},
        [](UntilSpec& spec, const Decoded& value) { spec.tool = value.index; }},
       {{.name = "force",
         .kind = Kind::quantity,
         .unit = "N",
         .range = above(0, 1e12),
         .needs = "tool",
         .doc = "Of the powder on the tool: against the normal of a plane, the whole of a "
                "polyline's.",
         .fallback_doc = "none"},
        to(&UntilSpec::force)},
       {{.name = "displacement",
         .kind = Kind::quantity,
         .unit = "m",
         .range = above(0, largest_size),
         .needs = "tool",
         .doc = "How far the tool is from where it stood when the stage began.",
         .fallback_doc = "none"},
        to(&UntilSpec::displacement)},
       {{.name = "relative_density",
         .kind = Kind::number,
         .range = above(0, 2),
         .doc =
             "Of the powder in a die of four planes; or in a periodic cell, when its strains have "
             "come to rest.",
         .fallback_doc = "none"},
        to(&UntilSpec::relative_density)}}};
  return declaration;
}

}  // namespace pulvis::schema
