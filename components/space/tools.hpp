// Shapes of rigid tools in three dimensions. Fixed geometry is given relative to the tool's position (ToolPosition).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "components/contact.hpp"
#include "components/space/shape.hpp"
#include "components/surface.hpp"
#include "engine/access.hpp"

namespace pulvis::space {

// A closed surface of triangles, counter-clockwise seen from outside.
struct TriangleMesh {
  struct Triangle {
    std::array<Point, 3> corner;  // m
    // Outward unit normals: of the triangle; of its edges (edge k starts at corner k) and corners, averaged over all
    // adjacent triangles (angle-weighted: Baerentzen & Aanaes 2005), used for the inside test near edges and corners.
    Point normal;
    std::array<Point, 3> edge_normal, corner_normal;
  };
  struct
      Node {  // of a binary tree of boxes: leaf: triangles [first, first + count); inner node: count 0
    std::array<double, 3> low{}, high{};
    std::int32_t first = 0,
                 count =
                     0;  // in an inner node, `first` is its second child; the first one comes next
  };
  std::vector<Triangle> triangles;  // in tree order
  std::vector<Node> tree;
};

struct ToolShapes {
  static constexpr const char* resource_name = "space_tool_shapes";
  static constexpr bool fixed = true;
  // A hole is round, along the tool's normal, without an end. A body of revolution is about that normal: a punch, a die
  // with a mouth. A constraint touches nothing.
  enum class Kind { plane, hole, revolution, mesh, constraint };
  struct Shape {
    Kind kind = Kind::plane;
    double radius = 0;     // m, of a hole
    ToolSurface meridian;  // of a body of revolution: x is the radius, y along the normal
    TriangleMesh mesh;
  };
  std::vector<Shape> of_tool;
};

struct ToolSurfaces {
  Read<ToolNormal> normal;
  Read<ToolPosition> position;
  Read<ToolShapes> shapes;

  const ToolShapes::Shape& shape(int tool) const { return entry(shapes->of_tool, tool); }
  Point normal_of(int tool) const {
    const Row<Tool> row(tool);
    return {normal(row, 0), normal(row, 1), normal(row, 2)};
  }
  Point position_of(int tool) const {
    const Row<Tool> row(tool);
    return {position(row, 0), position(row, 1), position(row, 2)};
  }
};

// Tool triangles that candidates can touch, built with the rows: each row has a range of them.
struct TriangleLists {
  static constexpr const char* resource_name = "triangle_lists";
  std::vector<std::int32_t> triangles;

  // Appends the triangles of a row to `list`. `range`: first and end.
  void append(const std::int32_t* range, std::vector<std::int32_t>& list) const {
    list.insert(list.end(), triangles.begin() + range[0], triangles.begin() + range[1]);
  }
  // Makes the ranges consecutive, keeping their lengths: for rows whose triangles were concatenated in row order.
  static void make_consecutive(std::span<std::int32_t> ranges) {
    std::int32_t end = 0;
    for (std::size_t k = 0; k < ranges.size(); k += 2) {
      const std::int32_t count = ranges[k + 1] - ranges[k];
      ranges[k] = end;
      ranges[k + 1] = end += count;
    }
  }

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(triangles);
  }
};

}  // namespace pulvis::space
