// Likely mistakes in a lever whose values are all allowed: mostly a wrong unit.
#pragma once

#include <string>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// N/m, of the beam or the two arms of a V, normal to its plane: E w t^3/(4 L^3). None if meshed.
std::optional<double> rough_stiffness(const Scene& scene);

// One line for each unusual ratio. None for a meshed lever.
std::vector<std::string> lever_warnings(const Scene& scene);

}  // namespace pulvis
