// Tool surfaces in three dimensions for display, frame by frame. Planes and dies are infinite for the powder; here they
// extend as far as the powder and the planes around it did at the start. A plane across a die is as round as the die.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "engine/entry.hpp"
#include "engine/files/record.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

class ToolSheets {
 public:
  // `powder`: bounding box of its nodes at the start, m.
  ToolSheets(const Scene& scene, const Eigen::AlignedBox3d& powder);

  static FieldInfo field();
  const ToolFaces& faces() const { return faces_; }
  // Position in Scene::tools of a tool in faces(): constraints have no surface.
  std::size_t number_of(int tool) const { return entry(numbers_, tool); }
  // Rows of the field: `places` holds x, y, z of the tools in order.
  std::vector<double> points(std::span<const double> places) const;

 private:
  using Ring = std::vector<Vec3>;

  void add_tool(const Scene& scene, const ToolSpec& tool);
  void add_sheet(const ToolSpec& plane);
  void add_die(const ToolSpec& die);
  void add_punch(const ToolSpec& punch);
  void add_triangles(const ToolSpec& tool);
  void add_piece(std::span<const Vec3> corners);  // three or four, relative to the tool's position
  void add_between(std::span<const Ring> rings);
  void add_quads(std::int32_t inner, std::int32_t outer, std::int32_t count, bool is_tip);

  Eigen::AlignedBox3d box_;
  ToolFaces faces_;
  std::vector<Vec3> corners_;  // m, relative to the tool's position
  std::vector<int> tool_;      // of each corner, position in faces_.names
  std::vector<std::size_t> numbers_;
};

}  // namespace pulvis::space
