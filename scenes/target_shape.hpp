// The sample's surface, held and queried by FCL: a half-space where it is plane, triangles where not.
#pragma once

#include <memory>

#include "components/probe.hpp"
#include "scenes/afm_scene.hpp"
#include "scenes/scene.hpp"

namespace pulvis {

// `reach`: m, how far the probe may stray from its start, along x or y.
std::shared_ptr<const TargetShape> make_target(const TargetSpec& target, const Scene& scene,
                                               double reach);

// Heights of a map file: [rows along y][columns along x], m. Throws std::runtime_error with what is wrong.
std::vector<std::vector<double>> read_height_map(const std::filesystem::path& file,
                                                 const std::string& dataset);

}  // namespace pulvis
