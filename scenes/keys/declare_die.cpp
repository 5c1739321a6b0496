// Declaration of the die.
#include "scenes/keys/declare.hpp"
#include "scenes/keys/tables.hpp"

namespace pulvis::schema {

const TableDeclaration<DieSpec>& die() {
  static const TableDeclaration<DieSpec> declaration{
      {"die", false, "",
       "The die, defined once. It gives random packings their width and packings "
       "their corner unless they set them, and adds the plane tools `left`, `right`, "
       "`bottom` and `top` unless the scene defines them; `top` rests on the packing "
       "if there is one. Values that contradict it are refused. A saved scene holds "
       "the resulting packings and tools. An empty `[die]` puts the tools around the "
       "only packing. In three dimensions a box also has the tools `front` and `back`; a "
       "cylindrical die "
       "has the tools `die`, `bottom` and `top`.",
       compaction_only, true},
      {{{.name = "width",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .doc = "Distance between the walls.",
         .fallback_doc = "that of the only packing: columns times spacing, or `width`",
         .in_3d = {.doc = "Size of a box along x.", .fallback_doc = "that of the only packing"}},
        to(&DieSpec::width)},
       {{.name = "depth",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .doc = "Size of a box along y.",
         .fallback_doc = "that of the only packing, or `width`",
         .dimension = Dimension::three},
        to(&DieSpec::depth)},
       {{.name = "diameter",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .doc = "Diameter of a cylindrical die along z, instead of a box.",
         .fallback_doc = "that of the only packing, or a box",
         .dimension = Dimension::three},
        to(&DieSpec::diameter)},
       {{.name = "corner",
         .kind = Kind::vector,
         .unit = "m",
         .range = within(-largest_size, largest_size),
         .doc = "Lower left corner.",
         .fallback_doc = "that of the only packing, or the origin",
         .in_3d =
             {.doc = "Corner with the smallest x, y and z; of a cylindrical die, the centre of its "
                     "floor."}},
        [](DieSpec& spec, const Decoded& value) { spec.corner = value.vector3; }}}};
  return declaration;
}

}  // namespace pulvis::schema
