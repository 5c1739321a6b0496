// Levers meshed with external software (Gmsh), with or without their tip.
//
// In the file x runs along the lever, x = 0 at the clamp; z points away from the sample, z = 0 is the middle
// of the lever without the coating. Groups: the volumes "lever" and, where present, "coating", "tip" and
// "glue"; the surfaces "clamp", held; "face", the lever's lower side, also under a tip; "back", the
// side that the laser hits; "end", of a tip in the file, where forces act.
#pragma once

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/lever/mesh/gmsh_solid.hpp"
#include "scenes/lever/mesh/lever_mesh.hpp"

namespace pulvis {

// A side of the lever, seen from above.
struct LeverSide {
  PlanMesh plan;
  std::vector<int> node;  // [points of the plan]
  std::vector<double> z;  // [points of the plan] m
};

struct LeverSolid {
  GmshSolid solid;
  LeverSide face, back;
  std::vector<std::vector<int>> end;  // nodes of its facets; empty without a tip
  double length = 0, thickness = 0;   // m, of the lever without the coating
  double tip_height = 0;              // m, below the lever without the coating
  Eigen::Vector2d tip_axis{0, 0};     // m, the middle of the end
};

// Reads the file of a lever of shape "mesh" into it, with the data of its tip; errors are reported as problems.
void load_meshed_lever(Scene& scene, const schema::Origins& origins, Problems& problems);

// Adds the lever, and a tip that is in its file, to an empty draft.
LeverMesh add_meshed_lever(SolidDraft& draft, const LeverSpec& lever);

}  // namespace pulvis
