// Tools that are not planes: polylines in contact with particles, and constraints on nodes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "components/dimension.hpp"
#include "components/entities.hpp"
#include "engine/entry.hpp"

namespace pulvis {

// A chain of straight pieces, each followed by a corner, relative to the tool's position.
struct ToolSurface {
  struct Piece {
    double x = 0, y = 0;       // m, a point on the straight piece
    double tx = 1, ty = 0;     // its direction; the powder is on the left
    double low = 0, high = 0;  // m, extent along t from (x, y); infinite at the ends of the chain
    double corner_x = 0, corner_y = 0;  // m, centre of the arc at its end
    double radius = 0;                  // m, of the arc; 0 in valleys and at sharp corners
    double next_tx = 1, next_ty = 0;    // direction of the next piece
    double side = 0;  // +1 convex corner of the tool, -1 valley, 0: the chain continues straight
  };
  using Box = std::array<double, 4>;  // m: x low, y low, x high, y high

  std::vector<Piece> pieces;
  std::vector<Box>
      tree;  // bounding boxes, the chain halved recursively; see systems/contact/surface_search
};

struct ToolShapes {  // only if a tool is not a plane
  static constexpr const char* resource_name = "tool_shapes";
  static constexpr bool fixed = true;
  enum class Kind { plane, polyline, constraint };
  std::vector<Kind> kind;            // [tools]
  std::vector<ToolSurface> surface;  // [tools]; empty unless a polyline
  bool is(int tool, Kind wanted) const { return entry(kind, tool) == wanted; }
  const ToolSurface& surface_of(int tool) const { return entry(surface, tool); }
};

// ---- polylines ----------------------------------------------------------------------------------
struct SurfaceRange : Component<ToolContact, std::int32_t, 2> {
  static constexpr ComponentInfo info{"surface_range", "-",
                                      "first and last piece of the polyline that can touch"};
};

// ---- constraints ----------------------------------------------------------------------------------------
struct ConstrainedNode {  // (node of a particle, direction in which it is constrained)
  static constexpr const char* name = "constrained_node";
  static constexpr bool laned = false, by_chunk = true;
};
struct ConstraintTarget : Component<ConstrainedNode, std::int32_t, 3> {
  static constexpr ComponentInfo info{"target", "-", "node and lane in the chunk, tool"};
};
template <class D>
struct ConstraintDirection : Component<ConstrainedNode, double, D::axes> {
  static constexpr ComponentInfo info{"direction", "-", "in which the node is held"};
};
template <class D>
struct ConstraintTravel : Component<ConstrainedNode, double, D::axes> {
  static constexpr ComponentInfo info{
      "travel", "-", "displacement of the node in its direction, per displacement of the tool"};
};
struct ConstraintOrigin : Component<ConstrainedNode, double, 1> {
  static constexpr ComponentInfo info{"origin", "m", "place of the node at time 0, in direction"};
};
struct ConstraintReaction : Component<ConstrainedNode, double, 1> {
  static constexpr ComponentInfo info{"reaction", "N",
                                      "of the constraint on the node, in direction"};
};

struct ConstraintIndex {
  static constexpr const char* resource_name = "constraint_index";
  static constexpr bool fixed = true;
  std::vector<std::int32_t> begin;  // [chunks + 1] into constrained nodes
};

}  // namespace pulvis
