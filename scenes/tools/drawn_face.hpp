// Faces of punches and walls from drawings: polylines whose points are an open line in an SVG or DXF file.
#pragma once

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// The line with the powder to its left: its chord's left normal is along `normal`. Its points are as in the drawing,
// or, given `point`, moved so that the one furthest along `normal` is level with it, the middle of the ends beside it.
std::vector<Vec2> placed_face(std::vector<Vec2> line, const Vec2& normal, const Vec2* point);

// Fills the points of the scene's polylines that have a file. One that rests on the packing gets its height once that is
// known.
void read_drawn_faces(Scene& scene, const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
