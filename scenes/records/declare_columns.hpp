// Keys that say how a record's columns are named and where they begin.
#pragma once

#include <string>

#include "scenes/keys/declare.hpp"

namespace pulvis::lab {

template <class Spec>
schema::Key<Spec> column_key(const char* name, const char* fallback, std::string Spec::*member,
                             const char* doc) {
  using namespace schema;
  return {{.name = name, .kind = Kind::text, .fallback = value_of(fallback), .doc = doc},
          to(member)};
}

template <class Spec>
schema::Key<Spec> header_key() {
  using namespace schema;
  return {{.name = "header_line",
           .kind = Kind::integer,
           .range = within(0, 10000),
           .fallback = value_of(0),
           .doc = "Line of the file that holds the names of the columns; 0: the first line that is "
                  "neither empty nor a comment (#)."},
          integer_to(&Spec::header_line)};
}

}  // namespace pulvis::lab
