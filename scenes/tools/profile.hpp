// Target surfaces: reliefs from a few parameters, as far as the powder can travel over them.
#pragma once

#include <vector>

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Corners of one pitch of a periodic relief, from crest to crest without the last one: x from 0 to the
// pitch, heights measured from the crest (<= 0), m.
std::vector<Vec2> one_pitch(const ProfileSpec& relief);

// The depth that gives an arithmetic mean deviation Ra from the mean line, m: exact for periodic reliefs.
double depth_for(const ProfileSpec& relief, double ra);

void check_profile(const ToolSpec& tool, const std::string& path, const schema::Origins& origins,
                   Problems& problems);

// Converts the scene's profiles to polylines that extend from left of the powder to right of it, however
// far the tool moves along it.
void make_profiles(Scene& scene, const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
