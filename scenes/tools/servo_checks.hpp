// Checks of a stage's forces and early ends, across its keys.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/material_checks.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// The direction in which a servo pushes; zero where neither it nor its tool defines one.
Vec3 direction_of(const ServoSpec& servo, const Scene& scene);

// Whether a servo pulls a tool with this normal off the powder, which follows only a tool that it is bonded to.
bool pulls_off(const Scene& scene, const std::string& tool, const Vec3& direction,
               const Vec3& normal);
inline constexpr const char* pulled_off =
    "points away from the powder, which is not bonded to '{}', allowed: along its normal, or "
    "across it";

void check_servos(const Scene& scene, const StageSpec& stage, const std::string& path,
                  const schema::Origins& origins, Problems& problems);

// Whether the moves of a stage reach the displacement that ends it, in two or three dimensions. Servos and compliant drives
// may reach any displacement.
inline void check_travel(const UntilSpec& until, const std::vector<MoveSpec>& moves,
                         const std::vector<ServoSpec>& servos, const std::string& path,
                         const Refuse& refuse) {
  if (!until.displacement || !until.tool) return;
  if (std::ranges::find(servos, *until.tool, &ServoSpec::tool) != servos.end()) return;
  const auto move = std::ranges::find(moves, *until.tool, &MoveSpec::tool);
  if (move != moves.end() && move->stiffness) return;
  const double moved = move == moves.end() ? 0 : move->displacement.norm();
  if (*until.displacement > moved)
    refuse(
        path + ".displacement",
        fmt::format(
            "{:g} m cannot be reached: the stage moves the tool by {:g} m, allowed: at most that",
            *until.displacement, moved));
}

}  // namespace pulvis
