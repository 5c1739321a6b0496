// Shared by several tables of reduce.toml: keys for a record's columns, and the powders of Table 3.2.
#pragma once

#include <string>

#include "scenes/keys/declare.hpp"

namespace pulvis::lab {

inline std::vector<schema::Choice> powders() {  // with their Poisson's ratios
  return {{"OFHC Cu", "0.35"}, {"316L", "0.3"}, {"salt", "0.252"}, {"sugar", "0.25"}};
}

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
           .doc = "Line of the file with the column names; 0: the first line that is neither "
                  "empty nor a comment (#), or, if there are lines of text above, the line "
                  "directly above the numbers if it is unambiguous."},
          integer_to(&Spec::header_line)};
}

}  // namespace pulvis::lab
