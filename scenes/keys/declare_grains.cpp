// Declaration of grains: what a particle is made of.
#include "scenes/keys/declare.hpp"
#include "scenes/keys/tables.hpp"

namespace pulvis::schema {

const TableDeclaration<GrainsSpec>& grains() {
  static const TableDeclaration<GrainsSpec> declaration{
      {"particle.grains",
       false,
       "",
       "The particle is made of grains: a Voronoi tessellation of its outline. Every grain is a "
       "body "
       "of its own; what holds them together is a `[[bond]]`.",
       {"compaction"},
       true},
      {{{.name = "number",
         .kind = Kind::integer,
         .range = within(2, 4096),
         .doc = "How many grains a particle has; or `size`."},
        [](GrainsSpec& spec, const Decoded& value) {
          spec.number = static_cast<int>(value.integer);
        }},
       {{.name = "size",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .doc = "Mean size of a grain: the diameter of the circle of its area; or `number`."},
        to(&GrainsSpec::size)},
       {{.name = "variants",
         .kind = Kind::integer,
         .range = within(1, 1000),
         .fallback = value_of(4),
         .doc =
             "Tessellations that are made by the scene's `seed`; every particle gets one of them. "
             "Equal grains are computed together, up to eight at a time: few variants are "
             "faster."},
        integer_to(&GrainsSpec::variants)},
       {{.name = "relaxation",
         .kind = Kind::integer,
         .range = within(0, 1000),
         .fallback = value_of(5),
         .doc = "Steps of Lloyd's method, which make grains equal; 0: a Poisson-Voronoi "
                "tessellation."},
        integer_to(&GrainsSpec::relaxation)},
       {{.name = "aspect_ratio",
         .kind = Kind::number,
         .range = within(1, 10),
         .fallback = value_of(1.0),
         .doc = "Length over width of the mean grain."},
        to(&GrainsSpec::aspect_ratio)},
       {{.name = "direction",
         .kind = Kind::quantity,
         .unit = "rad",
         .range = within(-1000, 1000),
         .fallback = value_of("0 deg"),
         .doc = "Of the grains' length, from the particle's own x axis."},
        to(&GrainsSpec::direction)},
       {{.name = "edges",
         .kind = Kind::integer,
         .range = within(8, 400),
         .fallback = value_of(12),
         .doc =
             "Edges of the mesh along the outline of a mean grain; `mesh.size` instead gives their "
             "length."},
        integer_to(&GrainsSpec::edges)}}};
  return declaration;
}

}  // namespace pulvis::schema
