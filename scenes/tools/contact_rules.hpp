// Contact rules between the scene's materials and tools.
#pragma once

#include <string>

#include "components/run_state.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Between two materials, or a material and a tool.
FrictionParameters friction_of(const Scene& scene, const std::string& a, const std::string& b);

// {}: none.
AdhesionParameters adhesion_of(const Scene& scene, const std::string& a, const std::string& b);
bool has_adhesion(const Scene& scene);

ContactRules contact_rules(const Scene& scene);

}  // namespace pulvis
