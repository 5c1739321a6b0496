// Declaration of grains, of which a particle consists.
#include "scenes/keys/declare.hpp"
#include "scenes/keys/tables.hpp"

namespace pulvis::schema {

const TableDeclaration<GrainsSpec>& grains() {
  static const TableDeclaration<GrainsSpec> declaration{
      {"particle.grains",
       false,
       "",
       "The particle consists of grains: a Voronoi tessellation of its outline. Every "
       "grain is a separate body; grains are held together by a `[[bond]]`.",
       {"compaction"},
       true,
       Dimension::two},
      {{{.name = "number",
         .kind = Kind::integer,
         .range = within(2, 4096),
         .doc = "Number of grains per particle; alternative to `size`."},
        [](GrainsSpec& spec, const Decoded& value) {
          spec.number = static_cast<int>(value.integer);
        }},
       {{.name = "size",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .doc = "Mean grain size: the diameter of the circle of equal area; alternative to "
                "`number`."},
        to(&GrainsSpec::size)},
       {{.name = "variants",
         .kind = Kind::integer,
         .range = within(1, 1000),
         .fallback = value_of(4),
         .doc = "Number of tessellations generated from the scene's `seed`; each particle uses "
                "one of them. Identical grains are computed together, up to eight at a time, "
                "so fewer variants run faster."},
        integer_to(&GrainsSpec::variants)},
       {{.name = "relaxation",
         .kind = Kind::integer,
         .range = within(0, 1000),
         .fallback = value_of(5),
         .doc = "Number of iterations of Lloyd's method, which evens out the grains; 0: a "
                "Poisson-Voronoi tessellation."},
        integer_to(&GrainsSpec::relaxation)},
       {{.name = "aspect_ratio",
         .kind = Kind::number,
         .range = within(1, 10),
         .fallback = value_of(1.0),
         .doc = "Mean aspect ratio of the grains, length over width."},
        to(&GrainsSpec::aspect_ratio)},
       {{.name = "direction",
         .kind = Kind::quantity,
         .unit = "rad",
         .range = within(-1000, 1000),
         .fallback = value_of("0 deg"),
         .doc = "Direction of the long axis of the grains, from the particle's own x axis."},
        to(&GrainsSpec::direction)},
       {{.name = "edges",
         .kind = Kind::integer,
         .range = within(8, 400),
         .fallback = value_of(12),
         .doc = "Number of mesh edges along the outline of an average grain; alternatively, "
                "`mesh.size` sets their length."},
        integer_to(&GrainsSpec::edges)}}};
  return declaration;
}

}  // namespace pulvis::schema
