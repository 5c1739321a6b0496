// Tips and probes meshed with external software (Gmsh), attached to a lever that Pulvis meshes.
//
// In the file z = 0 is the lever's lower face, the tip lies below it, its axis is x = y = 0. Groups: the
// volumes "tip" and, where there is one, "glue"; the surfaces "foot", in z = 0, and "end", where forces act.
#pragma once

#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/lever/mesh/gmsh_solid.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis {

struct TipSolid {
  GmshSolid solid;
  std::vector<int> foot;              // nodes
  std::vector<std::vector<int>> end;  // nodes of its facets
  double height = 0;                  // m, to the lowest point of the end
  double reach = 0;                   // m, of the foot from the axis, along x or y
};

// Reads the file of a tip of shape "mesh" into it; errors are reported as problems.
void load_meshed_tip(Scene& scene, const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
