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
       "only packing.",
       compaction_only, true, Dimension::two},
      {{{.name = "width",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .doc = "Distance between the walls.",
         .fallback_doc = "that of the only packing: columns times spacing, or `width`"},
        to(&DieSpec::width)},
       {{.name = "corner",
         .kind = Kind::vector,
         .unit = "m",
         .range = within(-largest_size, largest_size),
         .doc = "Lower left corner.",
         .fallback_doc = "that of the only packing, or the origin"},
        [](DieSpec& spec, const Decoded& value) { spec.corner = value.vector; }}}};
  return declaration;
}

}  // namespace pulvis::schema
