// Copies [die] into the packings and tools of a scene, so that its width is given in one place.
#pragma once

#include <optional>
#include <string>

#include "scenes/language/document.hpp"
#include "scenes/language/problem.hpp"

namespace pulvis {

struct MissingWidth {  // of the die
  document::Origin origin;
  std::string message;
};

// Removes [die] from the tree. Anything missing or contradictory is added to `problems`, except a missing width: that may
// only follow from another mistake, and is to be told if the rest of the scene is right.
std::optional<MissingWidth> fill_die(document::Table& root, Problems& problems);

}  // namespace pulvis
