// What a lever may have wrong though each of its values is allowed: mostly a unit.
#pragma once

#include <string>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

// N/m, of the beam or the two arms of a V, normal to its plane: E w t^3/(4 L^3). None of a meshed lever.
std::optional<double> rough_stiffness(const Scene& scene);

// One line each, with the ratio that is unusual. None of a meshed lever.
std::vector<std::string> lever_warnings(const Scene& scene);

}  // namespace pulvis
