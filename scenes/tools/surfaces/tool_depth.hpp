// Penetration depth of points in punches and STL tools, before anything moves.
#pragma once

#include <cstdint>
#include <vector>

#include "components/space/tools.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

class ToolDepth {
 public:
  struct Place {
    double depth;  // m, behind the surface; negative in front of it
    Vec3 out;      // unit vector of the shortest path to the surface, or from it
  };

  // `shape`: of the tool (tool_shapes.hpp). Both must outlive it.
  ToolDepth(const ToolSpec& tool, const ToolShapes::Shape& shape) : tool_(tool), shape_(shape) {}

  // Call before `at`: the sphere that contains all query points, in m.
  void look_about(const Vec3& centre, double reach);
  Place at(const Vec3& point) const;

 private:
  Place in_revolution(const Vec3& from) const;
  Place in_mesh(const Vec3& from) const;

  const ToolSpec& tool_;
  const ToolShapes::Shape& shape_;
  std::vector<std::int32_t> triangles_;  // those that can be the nearest
};

}  // namespace pulvis::space
