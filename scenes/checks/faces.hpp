// Flat faces of tools, and where prescribed moves carry them.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

struct Face {
  int tool = 0;
  Vec3 point = Vec3::Zero();   // m, the part of the face that is farthest from the powder
  Vec3 normal = Vec3::Zero();  // unit vector, into the powder
};

struct StageMoves {
  std::vector<std::pair<int, Vec3>> of_tools;  // m, displacement of each tool that moves
  bool decided =
      true;  // by these moves alone: no force, spring or `until` decides how far tools get
};

struct Meeting {  // of two tools that face each other
  int stage = 0;
  int first = 0, second = 0;  // the first moves farther
  double apart = 0;           // m, at the start of the stage
  double closing = 0;         // m, over the stage
};

// Of a scene's tools that have one.
std::vector<Face> faces_of(const Scene& scene);
// Of its stages.
std::vector<StageMoves> moves_of(const Scene& scene);

// The first stage whose moves leave no room between two faces.
std::optional<Meeting> first_meeting(std::vector<Face> all, const std::vector<StageMoves>& stages);

// The tool of a stage that moves away from the powder while none approaches it; none if a tool without a flat face
// moves, which may load the powder.
std::optional<int> tool_that_leaves(const StageMoves& stage, const std::vector<Face>& all);

}  // namespace pulvis
