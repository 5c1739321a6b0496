// Target surfaces: reliefs from their few numbers, as far as the powder can come over them.
#pragma once

#include <vector>

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Corners of one pitch of a relief that repeats, from crest to crest without the last one: x from 0 to the
// pitch, heights from the crest down (<= 0), m.
std::vector<Vec2> one_pitch(const ProfileSpec& relief);

// The depth that gives an arithmetic mean deviation Ra from the mean line, m: exact for all that repeat.
double depth_for(const ProfileSpec& relief, double ra);

void check_profile(const ToolSpec& tool, const std::string& path, const schema::Origins& origins,
                   Problems& problems);

// Turns the scene's profiles into polylines, from left of the powder to right of it, however far the tool is
// moved along it.
void make_profiles(Scene& scene, const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
