// What a number without a unit may have been meant to be.
#pragma once

#include <string>

#include "scenes/language/schema.hpp"

namespace pulvis::schema {

// '"400 um" or "0.4 mm"' for 400 and a length: the same quantity in the unit in which it is of the usual size
// and within the key's range, and in the next one. Angles are in degrees first.
std::string quantity_example(const KeyInfo& key, double number);

}  // namespace pulvis::schema
