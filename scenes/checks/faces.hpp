// Flat faces of tools, and where prescribed moves carry them: written once for two and three dimensions.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

template <class Vec>
struct Face {
  int tool = 0;
  Vec point = Vec::Zero();   // m, the part of the face that is farthest from the powder
  Vec normal = Vec::Zero();  // unit vector, into the powder
};

template <class Vec>
struct StageMoves {
  std::vector<std::pair<int, Vec>> of_tools;  // m, displacement of each tool that moves
  bool decided =
      true;  // by these moves alone: no force, spring or `until` decides how far tools get
};

struct Meeting {  // of two tools that face each other
  int stage = 0;
  int first = 0, second = 0;  // the first moves farther
  double apart = 0;           // m, at the start of the stage
  double closing = 0;         // m, over the stage
};

namespace faces {

constexpr double parallel = 1e-9;  // 1 - cosine

template <class Vec>
Vec displacement_of(const StageMoves<Vec>& stage, int tool) {
  for (const auto& [moved, displacement] : stage.of_tools)
    if (moved == tool) return displacement;
  return Vec::Zero();
}

template <class Vec>
std::optional<Meeting> meeting_in(const StageMoves<Vec>& stage, const std::vector<Face<Vec>>& all) {
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      const Vec& n = all[i].normal;
      if (n.dot(all[j].normal) > parallel - 1) continue;
      const double apart = (all[j].point - all[i].point).dot(n);
      const double own = displacement_of(stage, all[i].tool).dot(n);
      const double other = -displacement_of(stage, all[j].tool).dot(n);
      if (apart <= 0 || own + other < apart) continue;
      const bool swapped = other > own;
      return Meeting{0, swapped ? all[j].tool : all[i].tool, swapped ? all[i].tool : all[j].tool,
                     apart, own + other};
    }
  return std::nullopt;
}

}  // namespace faces

// The first stage whose moves leave no room between two faces.
template <class Vec>
std::optional<Meeting> first_meeting(std::vector<Face<Vec>> all,
                                     const std::vector<StageMoves<Vec>>& stages) {
  for (std::size_t s = 0; s < stages.size() && stages[s].decided; ++s) {
    if (auto meeting = faces::meeting_in(stages[s], all)) {
      meeting->stage = static_cast<int>(s);
      return meeting;
    }
    for (Face<Vec>& face : all) face.point += faces::displacement_of(stages[s], face.tool);
  }
  return std::nullopt;
}

// The tool of a stage that moves away from the powder while none approaches it; none if a tool without a flat face
// moves, which may load the powder.
template <class Vec>
std::optional<int> tool_that_leaves(const StageMoves<Vec>& stage,
                                    const std::vector<Face<Vec>>& all) {
  constexpr double across = 1e-9;  // -, of the displacement
  std::optional<int> leaving;
  for (const auto& [tool, displacement] : stage.of_tools) {
    const Face<Vec>* face = nullptr;
    for (const Face<Vec>& one : all)
      if (one.tool == tool) face = &one;
    if (face == nullptr) return std::nullopt;
    const double towards = face->normal.dot(displacement);
    if (towards > across * displacement.norm()) return std::nullopt;
    if (towards < -across * displacement.norm()) leaving = tool;
  }
  return leaving;
}

// "tools 'top' and 'bottom' ...": of a stage that leaves no room between them.
std::string told_meeting(const Meeting& meeting, const Scene& scene, const std::string& first,
                         const std::string& second);
// Warnings for stages of kind "compact" that load nothing; `leaving`: the names of the tools, "" for other stages.
std::vector<std::string> leaving_warnings(const Scene& scene,
                                          const std::vector<std::string>& leaving);

}  // namespace pulvis
