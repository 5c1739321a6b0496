// Packing keys shared by two and three dimensions. Spec: PackingSpec of either.
#pragma once

#include <utility>

#include "scenes/keys/declare.hpp"

namespace pulvis::schema {

template <class Spec>
Key<Spec> class_of_lattice_key(Words lattices) {
  return {{.name = "particle",
           .kind = Kind::reference,
           .refers_to = "particle",
           .required = true,
           .only_for = std::move(lattices),
           .doc = "Particle class."},
          index_to(&Spec::particle)};
}

template <class Spec>
Key<Spec> height_key(const char* doc) {
  return {{.name = "height",
           .kind = Kind::quantity,
           .unit = "m",
           .range = within(smallest_size, largest_size),
           .only_for = "random",
           .doc = doc,
           .fallback_doc = "from count and density"},
          to(&Spec::height)};
}

template <class Spec>
Key<Spec> count_key() {
  return {{.name = "count",
           .kind = Kind::integer,
           .range = within(1, 1e5),
           .only_for = "random",
           .doc = "Total number of particles of all classes, if those specify fractions.",
           .fallback_doc = "the sum of the numbers of the classes, or from density and height"},
          integer_to(&Spec::count)};
}

template <class Spec>
Key<Spec> density_key(const char* densest, const char* doc) {
  return {{.name = "density",
           .kind = Kind::number,
           .range = within(0.05, 0.999),
           .choices = {{"touching", "until all motion has ceased"}, {"densest", densest}},
           .only_for = "random",
           .doc = doc,
           .fallback_doc = "from count and height"},
          [](Spec& packing, const Decoded& value) {
            using Dense = typename Spec::Dense;
            if (value.is_word)
              packing.dense = value.index == 0 ? Dense::touching : Dense::densest;
            else
              packing.density = value.number;
          }};
}

template <class Spec>
Key<Spec> file_of_packing_key(const char* doc) {
  return {{.name = "file", .kind = Kind::file, .required = true, .only_for = "csv", .doc = doc},
          to(&Spec::file)};
}

}  // namespace pulvis::schema
