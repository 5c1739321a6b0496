// Outlines of the tools for pictures, frame by frame. Planes and polylines have no end for the powder; here they are
// bodies as long as the powder was at the start: planes that face up or down are punches as wide as the walls beside
// them leave room, the others walls.
#pragma once

#include <vector>

#include "engine/files/record.hpp"
#include "engine/world.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

class ToolOutlines {
 public:
  // `nodes`: x, y of the powder's nodes at the start, m.
  ToolOutlines(const Scene& scene, const World& world, const std::vector<double>& nodes);

  static FieldInfo field();
  bool empty() const { return bodies_.empty(); }
  ToolLines lines() const;
  // x, y of every tool's corners in turn, counted as `lines` does: along its face, then two behind it.
  std::vector<double> points(const World& world) const;

 private:
  struct Box {
    Vec2 low, high;
  };
  struct Body {
    std::size_t tool;
    std::string name;
    Vec2 normal;                   // out of its face
    std::vector<Vec2> face;        // of a polyline, from the tool's place; empty: of a plane
    Vec2 foremost = Vec2::Zero();  // of a polyline's points, the one furthest along the normal
  };
  void take_in(const Vec2& point);
  std::vector<Vec2> face_of_plane(const World& world, const Body& plane) const;
  void clip(const World& world, const Body& wall, const Body& punch, double& from,
            double& to) const;
  std::vector<Vec2> endless_face(const ToolSpec& tool, const Vec2& at) const;
  double depth_behind(const Body& body, const std::vector<Vec2>& face) const;

  std::vector<Body> bodies_;
  Box box_;               // of the powder and the tools around it, at the start
  double thickness_ = 0;  // m, of the bodies
};

}  // namespace pulvis
