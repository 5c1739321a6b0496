// contact_quality: which contacts in three dimensions are too narrow for their mesh.
//
// Law      Faces in a contact: sum of the shares of its touching Gauss points in the areas of their faces. Its width is the
//          diameter of the circle of that area, in faces and, with their undeformed sizes, in m
// Runs     in sampled steps, after the narrow phases
// Active   if contact is possible
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "engine/entry.hpp"
#include "systems/contact/by_slot.hpp"
#include "systems/observe/quality_sum.hpp"
#include "systems/space/contact/assembly.hpp"
#include "systems/space/observe/systems.hpp"

namespace pulvis::space {
namespace {

// Contact of one particle with one other, or with a tool.
struct TouchedFaces {
  int other = 0;
  std::array<double, 3> force{};  // N
  double area = 0;                // m^2, undeformed
  double faces = 0;               // -

  void add_point(const Shape::Face& face, int g, double x, double y, double z) {
    force[0] += x;
    force[1] += y;
    force[2] += z;
    const double of_point = entry(face.weight, g);
    area += of_point;
    faces += of_point / (face.size * face.size);
  }
  ContactQuality quality() const {
    const auto across = [](double in_contact) {
      return std::sqrt(4 / std::numbers::pi * in_contact);
    };
    const double size = std::sqrt(force[0] * force[0] + force[1] * force[1] + force[2] * force[2]);
    ContactQuality found{.force = size};
    if (across(faces) >= ContactQuality::min_edges) return found;
    found.narrow_force = size;
    found.narrow_width = size * across(area);
    found.narrow_edges = size * across(faces);
    return found;
  }
};

struct TouchLooker {
  const contact_quality& s;

  TouchedFaces with_other(int pair) const {
    const contact_force::Pairs& pairs = *s.pairs;
    TouchedFaces found;
    const std::array<double, 3>* force = entry(pairs.loads->pairs, pair).own.data();
    for (const Row<FaceContact> row : RowRange<FaceContact>::of(pairs.of->begin, pair)) {
      if (pairs.touches(row) == 0) continue;
      const Shape::Face& face =
          entry(s.bodies.shape_of(pairs.pair(row, 0)).faces, pairs.pair(row, 1));
      for (unsigned left = touching_points(&pairs.activation(row)); left != 0; left &= left - 1) {
        const auto [x, y, z] = *force++;
        found.add_point(face, std::countr_zero(left), x, y, z);
      }
    }
    return found;
  }
  void find_pairs(int slot, std::vector<ContactQuality>& found) const {
    const FacePairs& of = *s.pairs->of;
    const std::int32_t end = entry(s.index->sampled_begin, slot + 1);
    for (int p = of.from_row(entry(s.index->sampled_begin, slot)); entry(of.begin, p) < end; ++p)
      found.push_back(with_other(p).quality());
  }

  void add_tool(Row<FaceToolContact> row, TouchedFaces& found) const {
    const auto part = [&](int k, int g) { return s.tools->force(row, face_points * k + g); };
    const Shape::Face& face =
        entry(s.bodies.shape_of(s.tools->pair(row, 0)).faces, s.tools->pair(row, 1));
    for (int g = 0; g < face_points; ++g)
      if (part(0, g) != 0 || part(1, g) != 0 || part(2, g) != 0)
        found.add_point(face, g, part(0, g), part(1, g), part(2, g));
  }
  void find_tools(int slot, std::vector<ContactQuality>& found) const {
    std::vector<TouchedFaces> sides;
    for (const Row<FaceToolContact> row :
         RowRange<FaceToolContact>::of(s.index->tool_begin, slot)) {
      if (s.tools->touches(row) == 0) continue;
      const int tool = s.tools->pair(row, 2);
      auto side = std::ranges::find(sides, tool, &TouchedFaces::other);
      if (side == sides.end()) side = sides.insert(side, TouchedFaces{.other = tool});
      add_tool(row, *side);
    }
    for (const TouchedFaces& side : sides) found.push_back(side.quality());
  }
};

}  // namespace

void contact_quality::operator()() const {
  const TouchLooker looker{*this};
  const auto found = list_by_slot<ContactQuality>(
      bodies.slots(), [&](int slot, std::vector<ContactQuality>& contacts) {
        if (!bodies.bodies->owns(slot)) return;
        if (pairs) looker.find_pairs(slot, contacts);
        if (tools) looker.find_tools(slot, contacts);
      });
  *quality = exact_sum(found.all, link);
}

}  // namespace pulvis::space
