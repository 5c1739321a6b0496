// Checks of stages and frictions that do not depend on the dimension.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "scenes/spec/material_checks.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// `moves`, `drives`: how many prescribed moves, and what else (servos, driven cells) moves tools in the stage. `movers`: the
// tables that can, for a refusal.
void check_stage_kind(const StageSpec& stage, std::size_t moves, std::size_t drives,
                      const std::string& movers, const std::string& path, const Refuse& refuse);

void check_frictions(const Scene& scene, const std::vector<std::string>& tools,
                     const Refuse& refuse);

// Whether a displacement that ends a stage is reached by the moves of the stage, of two or three dimensions. Servos and drives
// that give may reach any.
template <class Move, class Servo>
void check_travel(const UntilSpec& until, const std::vector<Move>& moves,
                  const std::vector<Servo>& servos, const std::string& path, const Refuse& refuse) {
  if (!until.displacement || !until.tool) return;
  if (std::ranges::find(servos, *until.tool, &Servo::tool) != servos.end()) return;
  const auto move = std::ranges::find(moves, *until.tool, &Move::tool);
  if (move != moves.end() && move->stiffness) return;
  const double moved = move == moves.end() ? 0 : move->displacement.norm();
  if (*until.displacement > moved)
    refuse(
        path + ".displacement",
        fmt::format("{:g} m is not reached: the stage moves the tool by {:g} m, allowed: at most "
                    "that",
                    *until.displacement, moved));
}

// What is declared and not referred to.
void refuse_unused(const std::string& path, const std::string& name, const std::string& user,
                   const Refuse& refuse);

}  // namespace pulvis
