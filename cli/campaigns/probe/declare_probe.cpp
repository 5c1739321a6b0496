#include "cli/campaigns/probe/declare_probe.hpp"

#include <fmt/format.h>

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

const TableDeclaration<ProbePowder>& probe_powder() {
  static const TableDeclaration<ProbePowder> declaration{
      {"powder", true, "",
       "A variant of the powder: every path is run with each of them, and its yield surfaces are "
       "compared. Without this table there is one powder, that of the scenes."},
      {{{.name = "name",
         .kind = Kind::name,
         .required = true,
         .doc = "Name used in tables, figures and folders, after that of the path."},
        to(&ProbePowder::name)},
       {{.name = "overrides",
         .kind = Kind::texts,
         .doc = "What is different: changes to the scene of every path, written as for `--set`.",
         .fallback_doc = "none: the powder of the scenes"},
        [](ProbePowder& powder, const Decoded& value) { powder.overrides = value.texts; }}}};
  return declaration;
}

const TableDeclaration<ProbeSpec>& probe_probe() {
  static const TableDeclaration<ProbeSpec> declaration{
      {"probe", false, "",
       "Probing of each state: the powder is unloaded first, then loaded in one "
       "direction."},
      {{{.name = "control",
         .kind = Kind::choice,
         .choices =
             words_of<ProbeSpec::Control>({{"strain", "the strains increase in a fixed ratio"},
                                           {"stress", "the stresses change in a fixed ratio"}}),
         .fallback = value_of("strain"),
         .doc = "Quantity that defines the direction."},
        word_to(&ProbeSpec::control)},
       {{.name = "directions",
         .kind = Kind::integer,
         .range = within(4, 360),
         .fallback = value_of(12),
         .doc = "Number of directions, evenly spaced over the full circle. In two dimensions they "
                "are in the plane of xx and yy, and one more probe applies shear xy. In three "
                "they are in the plane of triaxial compression and extension along z, of xx = yy "
                "and zz, and three more probes apply shear xy, yz and zx."},
        integer_to(&ProbeSpec::directions)},
       {{.name = "deviatoric",
         .kind = Kind::integer,
         .range = within(3, 360),
         .fallback = value_of(6),
         .doc = "Number of Lode angles, evenly spaced over the full circle, at which the volume is "
                "kept; under stress control the pressure. 0 degrees is compression along z, 120 "
                "along y, 240 along x. Only for paths in three dimensions."},
        integer_to(&ProbeSpec::deviatoric)},
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
         .doc = "Simulated time of a probe. The unloading before the probes of a state takes the "
                "same time."},
        to(&ProbeSpec::duration)},
       {{.name = "release",
         .kind = Kind::number,
         .range = above(0, 1),
         .fallback = value_of(0.5),
         .doc = "Fraction of the state's stresses to which it is unloaded, so that all directions "
                "start inside the yield surface. Normal stresses are unloaded, zz in three "
                "dimensions only, and shear stresses above 5% of the pressure."},
        to(&ProbeSpec::release)}}};
  return declaration;
}

const TableDeclaration<GivenDirection>& probe_direction() {
  const auto part = [](std::size_t k, const char* where) {
    return Key<GivenDirection>{
        {.name = tensor_part_names[k],
         .kind = Kind::number,
         .range = within(-1, 1),
         .fallback = value_of(0.0),
         .doc = fmt::format("Component {} of the direction{}.", tensor_part_names[k], where)},
        [k](GivenDirection& direction, const Decoded& value) {
          direction.parts[k] = value.number;
        }};
  };
  constexpr const char* in_space = ", only for paths in three dimensions";
  static const TableDeclaration<GivenDirection> declaration{
      {"direction", true, "",
       "An additional direction of strain, or of the change of stress, as components of a tensor. "
       "Only their ratios matter: the magnitude is `probe.size`."},
      {{{.name = "name",
         .kind = Kind::name,
         .required = true,
         .doc = "Name used in tables and folders."},
        to(&GivenDirection::name)},
       part(0, ""),
       part(1, ""),
       part(2, in_space),
       part(3, ""),
       part(4, in_space),
       part(5, in_space)}};
  return declaration;
}

const TableDeclaration<ProbeSpec>& probe_yield() {
  static const TableDeclaration<ProbeSpec> declaration{
      {"yield", false, "", "Yield criteria. Both are evaluated and reported."},
      {{{.name = "elastic_strain",
         .kind = Kind::number,
         .range = above(0, 0.1),
         .fallback = value_of(2e-4),
         .doc = "Strain magnitude up to which probes count as elastic: the stiffness is fitted to "
                "these parts of all directions."},
        to(&ProbeSpec::elastic_strain)},
       {{.name = "offset_strain",
         .kind = Kind::number,
         .range = above(0, 0.5),
         .fallback = value_of(0.002),
         .doc =
             "Magnitude of the plastic strain, i.e. strain minus elastic strain, at yield. It is "
             "the square root of the sum of squares of all components of the tensor; in two "
             "dimensions of those in the plane."},
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
                                 view_of(probe_powder()),    view_of(probe_probe()),
                                 view_of(probe_direction()), view_of(probe_yield())};
  return language;
}

}  // namespace pulvis::schema
