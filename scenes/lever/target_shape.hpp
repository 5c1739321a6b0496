// The sample's surface, stored and queried with FCL: a half-space where it is plane, otherwise triangles.
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "components/probe.hpp"
#include "scenes/spec/afm_scene.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// How far the probe may move from its start, along x or y, m.
double reach_of(const AfmScene& afm);

std::shared_ptr<const TargetShape> make_target(const TargetSpec& target, const Scene& scene,
                                               double reach);

// Heights of a map file: [rows along y][columns along x], m. Throws std::runtime_error with what is wrong.
std::vector<std::vector<double>> read_height_map(const std::filesystem::path& file,
                                                 const std::string& dataset);

// Lowest and highest height; the largest step from a point to its neighbour along x or y. m
std::pair<double, double> height_range(const std::vector<std::vector<double>>& heights);
double steepest_step(const std::vector<std::vector<double>>& heights);

// Corners of a surface that varies along one direction, as (along, height) in m: from -reach to +reach.
std::vector<std::array<double, 2>> drawn_profile(const TargetSpec& target, double reach);

// Heights of a map as make_target() uses them. [rows along y][columns along x], m
std::vector<std::vector<double>> drawn_heights(const TargetSpec& target, const Scene& scene);

// Number of corners of the profile that make_target() draws: a short wave on a long scan has many.
std::size_t profile_corners(const TargetSpec& target, double reach);

}  // namespace pulvis
