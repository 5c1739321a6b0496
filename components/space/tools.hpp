// Shapes of rigid tools in three dimensions. What is fixed of a tool stands relative to its position (ToolPosition).
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

// A closed surface of triangles, counter-clockwise as seen from outside.
struct TriangleMesh {
  struct Triangle {
    std::array<Point, 3> corner;  // m
    // Outward unit vectors: of the triangle; of its edges (from corner k on) and corners, between those of all that meet
    // there (weighted with their angles: Baerentzen & Aanaes 2005), which tell inside from outside where these are nearest.
    Point normal;
    std::array<Point, 3> edge_normal, corner_normal;
  };
  struct
      Node {  // of a binary tree of boxes: of the triangles [first, first + count); halves where count is 0
    std::array<double, 3> low{}, high{};
    std::int32_t first = 0,
                 count =
                     0;  // of an inner node, `first` is its second half; the first one follows it
  };
  std::vector<Triangle> triangles;  // in the order of the tree
  std::vector<Node> tree;
};

struct ToolShapes {
  static constexpr const char* resource_name = "space_tool_shapes";
  static constexpr bool fixed = true;
  // A die is the inside of a round hole along the tool's normal, a punch a body of revolution about it.
  enum class Kind { plane, die, punch, mesh };
  struct Shape {
    Kind kind = Kind::plane;
    double radius = 0;     // m, of a die
    ToolSurface meridian;  // of a punch: x the radius, y along the normal, mirrored at the axis
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

// Triangles of tools that candidates can touch, made with the rows: each has a range of them.
struct TriangleLists {
  static constexpr const char* resource_name = "triangle_lists";
  std::vector<std::int32_t> triangles;

  // Those of a row to `list`. `range`: first and end.
  void append(const std::int32_t* range, std::vector<std::int32_t>& list) const {
    list.insert(list.end(), triangles.begin() + range[0], triangles.begin() + range[1]);
  }
  // The ranges, as long as they are, one after the other: of rows whose triangles were put together in their order.
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
