// Checks of materials, shared by all families.
#pragma once

#include <functional>
#include <string>

#include "scenes/spec/scene.hpp"

namespace pulvis {

using Refuse = std::function<void(const std::string& path, const std::string& message)>;

void check_materials(const Scene& scene, const Refuse& refuse);

}  // namespace pulvis
