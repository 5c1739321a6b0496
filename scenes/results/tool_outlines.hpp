// Outlines of the tools for plots, frame by frame. To the powder, planes and polylines are infinite; here they are
// bodies as long as the powder was at the start: planes that face up or down are punches that fill the width
// between the walls, the others are walls.
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
  // x, y of the corners, tool by tool, counted as in `lines`: along the face, then two behind it.
  std::vector<double> points(const World& world) const;

 private:
  struct Box {
    Vec2 low, high;
  };
  struct Body {
    std::size_t tool;
    std::string name;
    Vec2 normal;                   // out of its face
    std::vector<Vec2> face;        // of a polyline, relative to the tool's position; empty: a plane
    Vec2 foremost = Vec2::Zero();  // of a polyline's points, the one furthest along the normal
  };
  void take_in(const Vec2& point);
  std::vector<Vec2> face_of_plane(const World& world, const Body& plane) const;
  void clip(const World& world, const Body& wall, const Body& punch, double& from,
            double& to) const;
  std::vector<Vec2> endless_face(const ToolSpec& tool, const Vec2& at) const;
  double depth_behind(const Body& body, const std::vector<Vec2>& face) const;

  std::vector<Body> bodies_;
  Box box_;               // of the powder and the surrounding tools, at the start
  double thickness_ = 0;  // m, of the bodies
};

}  // namespace pulvis
