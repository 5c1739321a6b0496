// Guesses the unit of a number that was given without one.
#pragma once

#include <string>

#include "scenes/language/schema.hpp"

namespace pulvis::schema {

// '"400 um" or "0.4 mm"' for 400 and a length: the same quantity in the unit that gives a usual magnitude
// within the key's range, and in the next larger unit. Angles are in degrees first.
std::string quantity_example(const KeyInfo& key, double number);

}  // namespace pulvis::schema
