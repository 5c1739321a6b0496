#include "cli/campaigns/probe/declare_probe.hpp"

#include "scenes/keys/declare.hpp"

namespace pulvis::schema {

const TableDeclaration<ProbeSpec>& probe_top_level() {
  static const TableDeclaration<ProbeSpec> declaration{
      {"", false, "", "Keys at the top level of the file."},
      {{{.name = "title",
         .kind = Kind::text,
         .doc = "Title of tables and figures.",
         .fallback_doc = "the name of the file"},
        to(&ProbeSpec::title)},
       {{.name = "densities",
         .kind = Kind::numbers,
         .range = above(0, 1.5),
         .required = true,
         .doc = "Relative densities at which the powder is probed, in increasing order. The "
                "last stage of the path's scene is repeated until each of them is reached."},
        [](ProbeSpec& spec, const Decoded& value) { spec.densities = value.numbers; }},
       {{.name = "seeds",
         .kind = Kind::integers,
         .range = within(0, 1e15),
         .doc = "Values of the scene's `seed`. Every path is run with each of them, and "
                "parameters are reported with their scatter.",
         .fallback_doc = "one run with the scene's own seed"},
        [](ProbeSpec& spec, const Decoded& value) { spec.seeds = value.integers; }},
       {{.name = "overrides",
         .kind = Kind::texts,
         .doc = "Changes to the scene of every path, written as for `--set`. They are applied "
                "after all others except those on the command line. In the settings saved with "
                "the results, this key records the `--set` options.",
         .fallback_doc = "none"},
        [](ProbeSpec& spec, const Decoded& value) { spec.overrides = value.texts; }}}};
  return declaration;
}

const TableDeclaration<ProbePath>& probe_path() {
  static const TableDeclaration<ProbePath> declaration{
      {"path", true, "",
       "A load path of the powder; the loading history shapes the yield surface."},
      {{{.name = "name",
         .kind = Kind::name,
         .required = true,
         .doc = "Name used in tables, figures and folders."},
        to(&ProbePath::name)},
       {{.name = "scene",
         .kind = Kind::scene,
         .required = true,
         .doc = "Scene with a periodic cell, as a path relative to the folder of this file. "
                "Its last stage must deform the cell (`[stage.cell]`) far enough to reach the "
                "next density."},
        to(&ProbePath::scene)}}};
  return declaration;
}

const TableDeclaration<ProbeSpec>& probe_probe() {
  static const TableDeclaration<ProbeSpec> declaration{
      {"probe", false, "",
       "Probing of each state: the powder is unloaded first, then loaded in one "
       "direction."},
      {{{.name = "control",
         .kind = Kind::choice,
         .choices = words_of<ProbeSpec::Control>(
             {{"strain", "strains xx and yy increase in a fixed ratio"},
              {"stress", "stresses xx and yy change in a fixed ratio"}}),
         .fallback = value_of("strain"),
         .doc = "Quantity that defines the direction."},
        word_to(&ProbeSpec::control)},
       {{.name = "directions",
         .kind = Kind::integer,
         .range = within(4, 360),
         .fallback = value_of(12),
         .doc = "Number of directions, evenly spaced over the full circle in the plane of xx "
                "and yy. One additional probe applies shear."},
        integer_to(&ProbeSpec::directions)},
       {{.name = "size",
         .kind = Kind::number,
         .range = above(0, 1),
         .fallback = value_of(0.02),
         .doc = "Magnitude of the strain; under stress control, of the stress change divided "
                "by the pressure of the state."},
        to(&ProbeSpec::size)},
       {{.name = "duration",
         .kind = Kind::quantity,
         .unit = "s",
         .range = within(1e-15, 1e6),
         .required = true,
         .doc = "Simulated time of a probe; the preceding unloading takes the same time."},
        to(&ProbeSpec::duration)},
       {{.name = "release",
         .kind = Kind::number,
         .range = above(0, 1),
         .fallback = value_of(0.5),
         .doc = "Fraction of stresses xx and yy of the state to which it is unloaded, so that "
                "all directions start inside the yield surface."},
        to(&ProbeSpec::release)}}};
  return declaration;
}

const TableDeclaration<ProbeSpec>& probe_yield() {
  static const TableDeclaration<ProbeSpec> declaration{
      {"yield", false, "", "Yield criteria. Both are evaluated and reported."},
      {{{.name = "elastic_strain",
         .kind = Kind::number,
         .range = above(0, 0.1),
         .fallback = value_of(2e-4),
         .doc = "Strain magnitude up to which probes count as elastic: moduli are fitted to "
                "these parts of all directions."},
        to(&ProbeSpec::elastic_strain)},
       {{.name = "offset_strain",
         .kind = Kind::number,
         .range = above(0, 0.5),
         .fallback = value_of(0.002),
         .doc = "Magnitude of the plastic strain (xx, yy), i.e. strain minus elastic strain, "
                "at yield."},
        to(&ProbeSpec::offset_strain)},
       {{.name = "dissipation",
         .kind = Kind::number,
         .range = above(0, 0.5),
         .fallback = value_of(0.002),
         .doc = "Energy dissipated per volume at yield, by plastic flow, friction, damping and "
                "fracture, divided by the pressure of the state."},
        to(&ProbeSpec::dissipation)}}};
  return declaration;
}

const Language& probe_language() {
  static const Language language{view_of(probe_top_level()), view_of(probe_path()),
                                 view_of(probe_probe()), view_of(probe_yield())};
  return language;
}

}  // namespace pulvis::schema
