#include "scenes/probe/declare_probe.hpp"

#include "scenes/keys/declare.hpp"

namespace pulvis::schema {

const TableDeclaration<ProbeSpec>& probe_top_level() {
  static const TableDeclaration<ProbeSpec> declaration{
      {"", false, "", "Keys before the first table."},
      {{{.name = "title",
         .kind = Kind::text,
         .doc = "What tables and pictures are headed with.",
         .fallback_doc = "the name of the file"},
        to(&ProbeSpec::title)},
       {{.name = "densities",
         .kind = Kind::numbers,
         .range = above(0, 1.5),
         .required = true,
         .doc = "Relative densities at which the powder is probed, rising. The last stage of a "
                "path's scene is gone through again and again, until each of them."},
        [](ProbeSpec& spec, const Decoded& value) { spec.densities = value.numbers; }},
       {{.name = "seeds",
         .kind = Kind::integers,
         .range = within(0, 1e15),
         .doc = "Every path is gone with each of these as the scene's `seed`: parameters are then "
                "given with their scatter.",
         .fallback_doc = "the scene's own, once"},
        [](ProbeSpec& spec, const Decoded& value) { spec.seeds = value.integers; }},
       {{.name = "overrides",
         .kind = Kind::texts,
         .doc = "Changes of every path's scene as `--set` makes them, applied after all others but "
                "those of the "
                "command line. The settings that are saved beside results keep here what `--set` "
                "gave.",
         .fallback_doc = "none"},
        [](ProbeSpec& spec, const Decoded& value) { spec.overrides = value.texts; }}}};
  return declaration;
}

const TableDeclaration<ProbePath>& probe_path() {
  static const TableDeclaration<ProbePath> declaration{
      {"path", true, "",
       "A load path of the powder: what it was pressed by shapes its yield surface."},
      {{{.name = "name",
         .kind = Kind::name,
         .required = true,
         .doc = "What it is called in tables, pictures and folders."},
        to(&ProbePath::name)},
       {{.name = "scene",
         .kind = Kind::scene,
         .required = true,
         .doc = "A scene with a periodic cell, as a path from this file's folder. Its last stage "
                "must deform the cell (`[stage.cell]`) far enough for the next density."},
        to(&ProbePath::scene)}}};
  return declaration;
}

const TableDeclaration<ProbeSpec>& probe_probe() {
  static const TableDeclaration<ProbeSpec> declaration{
      {"probe", false, "",
       "How each state is probed: unloaded first, then loaded in one direction."},
      {{{.name = "control",
         .kind = Kind::choice,
         .choices = {{"strain", "strains xx and yy grow in a fixed ratio"},
                     {"stress", "stresses xx and yy change in a fixed ratio"}},
         .fallback = value_of("strain"),
         .doc = "What has the direction."},
        [](ProbeSpec& spec, const Decoded& value) {
          spec.control = static_cast<ProbeSpec::Control>(value.index);
        }},
       {{.name = "directions",
         .kind = Kind::integer,
         .range = within(4, 360),
         .fallback = value_of(12),
         .doc = "Evenly over the full turn in the plane of xx and yy. One more probe shears."},
        integer_to(&ProbeSpec::directions)},
       {{.name = "size",
         .kind = Kind::number,
         .range = above(0, 1),
         .fallback = value_of(0.02),
         .doc = "Length of the strain; under stress control that of the stress over the pressure "
                "of the state."},
        to(&ProbeSpec::size)},
       {{.name = "duration",
         .kind = Kind::quantity,
         .unit = "s",
         .range = within(1e-15, 1e6),
         .required = true,
         .doc = "Simulated time of a probe; as long again for the unloading before it."},
        to(&ProbeSpec::duration)},
       {{.name = "release",
         .kind = Kind::number,
         .range = above(0, 1),
         .fallback = value_of(0.5),
         .doc = "Share of the state's stresses xx and yy to which it is unloaded: all directions "
                "start inside the yield surface."},
        to(&ProbeSpec::release)}}};
  return declaration;
}

const TableDeclaration<ProbeSpec>& probe_yield() {
  static const TableDeclaration<ProbeSpec> declaration{
      {"yield", false, "", "What counts as yielding. Both criteria are evaluated and told."},
      {{{.name = "elastic_strain",
         .kind = Kind::number,
         .range = above(0, 0.1),
         .fallback = value_of(2e-4),
         .doc = "Length of the strain up to which probes count as elastic: moduli are fitted to "
                "these parts of all directions."},
        to(&ProbeSpec::elastic_strain)},
       {{.name = "offset_strain",
         .kind = Kind::number,
         .range = above(0, 0.5),
         .fallback = value_of(0.002),
         .doc = "Length of the plastic strain (xx, yy): strain less elastic strain."},
        to(&ProbeSpec::offset_strain)},
       {{.name = "dissipation",
         .kind = Kind::number,
         .range = above(0, 0.5),
         .fallback = value_of(0.002),
         .doc = "Energy dissipated per volume, by plastic flow, friction, damping and fracture, "
                "over the pressure of the state."},
        to(&ProbeSpec::dissipation)}}};
  return declaration;
}

const Language& probe_language() {
  static const Language language{view_of(probe_top_level()), view_of(probe_path()),
                                 view_of(probe_probe()), view_of(probe_yield())};
  return language;
}

}  // namespace pulvis::schema
