// The sample's surface, held and queried by FCL: a half-space where it is plane, triangles where not.
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "components/probe.hpp"
#include "scenes/spec/afm_scene.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// How far the probe may stray from its start, along x or y, m.
double reach_of(const AfmScene& afm);

std::shared_ptr<const TargetShape> make_target(const TargetSpec& target, const Scene& scene,
                                               double reach);

// Heights of a map file: [rows along y][columns along x], m. Throws std::runtime_error with what is wrong.
std::vector<std::vector<double>> read_height_map(const std::filesystem::path& file,
                                                 const std::string& dataset);

// Lowest and highest; the largest step from a point to its neighbour along x or y. m
std::pair<double, double> height_range(const std::vector<std::vector<double>>& heights);
double steepest_step(const std::vector<std::vector<double>>& heights);

// Corners of a surface that rises along one direction, as (along, height) in m: drawn from -reach to +reach.
std::vector<std::array<double, 2>> drawn_profile(const TargetSpec& target, double reach);

// Heights of a map as make_target() takes them. [rows along y][columns along x], m
std::vector<std::vector<double>> drawn_heights(const TargetSpec& target, const Scene& scene);

// Of the profile that make_target() draws: a short wave on a long scan has many.
std::size_t profile_corners(const TargetSpec& target, double reach);

}  // namespace pulvis
