// Declaration of the die.
#include "scenes/keys/declare.hpp"
#include "scenes/keys/tables.hpp"

namespace pulvis::schema {

const TableDeclaration<DieSpec>& die() {
  static const TableDeclaration<DieSpec> declaration{
      {"die", false, "",
       "The die, given once: random packings get its width, packings its corner, where they do not "
       "say them; and plane tools `left`, `right`, `bottom` and `top` stand around it, the last on "
       "the packing's top where there is one, but for those that the scene has itself. Values that "
       "differ from it are "
       "refused. A saved scene has the packings and tools that come of it. `[die]` alone makes the "
       "tools around the one packing.",
       compaction_only, true},
      {{{.name = "width",
         .kind = Kind::quantity,
         .unit = "m",
         .range = within(smallest_size, largest_size),
         .doc = "Between the walls.",
         .fallback_doc = "that of the one packing: columns times spacing, or `width`"},
        to(&DieSpec::width)},
       {{.name = "corner",
         .kind = Kind::vector,
         .unit = "m",
         .range = within(-largest_size, largest_size),
         .doc = "Lower left corner.",
         .fallback_doc = "that of the one packing, or the origin"},
        [](DieSpec& spec, const Decoded& value) { spec.corner = value.vector; }}}};
  return declaration;
}

}  // namespace pulvis::schema
