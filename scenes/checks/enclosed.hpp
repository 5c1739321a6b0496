// What the tools of a die enclose, wherever they are, and how much of it is powder.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

using Places = std::vector<Vec3>;  // m, of the tools
// m^2 or m^3 that the tools enclose; 0 if nothing is left.
using Enclosed = std::function<double(const Places&)>;

// None if something else than flat walls or a cylindrical die, or another run, decides what is enclosed.
std::optional<Enclosed> enclosed(const Scene& scene);

// m^2 or m^3, of all particles.
double content_of_powder(const Scene& scene, const std::vector<BodySpec>& bodies);

Places tools_at_start(const Scene& scene);
// After this share of all moves.
Places tools_moved(Places places, const std::vector<MoveSpec>& moves, double share);

}  // namespace pulvis
