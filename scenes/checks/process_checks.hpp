// Checks of stages and friction entries that do not depend on the dimension.
#pragma once

#include <string>
#include <vector>

#include "scenes/spec/material_checks.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

void check_stages(const Scene& scene, const Refuse& refuse);

void check_frictions(const Scene& scene, const std::vector<std::string>& tools,
                     const Refuse& refuse);

void check_bonds(const Scene& scene, const std::vector<std::string>& tools, const Refuse& refuse);

// Refuses what is declared but never referenced.
void refuse_unused(const std::string& path, const std::string& name, const std::string& user,
                   const Refuse& refuse);

}  // namespace pulvis
