// contact_quality: how far the surfaces penetrate each other, and which contacts are too narrow for their mesh.
//
// Law      Overlap as in two dimensions (systems/observe/contact_quality.cpp), with the current area of a point in place of
//          its length; the penetration work is not summed: scenes/results/contact_findings.hpp takes the springs' energy.
//          Faces in a contact: sum of the shares of its touching Gauss points in the areas of their faces. Its width is the
//          diameter of the circle of that area, in faces and, with their undeformed sizes, in m
// Runs     in sampled steps, after the narrow phases
// Active   if contact is possible
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/entry.hpp"
#include "systems/contact/by_slot.hpp"
#include "systems/observe/quality_sum.hpp"
#include "systems/space/contact/assembly.hpp"
#include "systems/space/observe/surface_points.hpp"

namespace pulvis::space {
namespace {

SurfaceVector vector_of(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }

// Contact of one particle with one other, or with a tool.
struct TouchedFaces {
  int other = 0;
  SurfaceVector force{};  // N
  double area = 0;        // m^2, undeformed
  double faces = 0;       // -
  double overlap = 0;     // m^3

  void add_point(const Shape::Face& face, int g, const SurfaceVector& f) {
    force = force + f;
    const double of_point = entry(face.weight, g);
    area += of_point;
    faces += of_point / (face.size * face.size);
  }
  // `of_point`: m^2, current area.
  void add_overlap(double of_point, double depth) {
    if (depth > 0) overlap += of_point * depth;  // others are held by a bond or by adhesion
  }
  ContactQuality quality() const {
    const auto across = [](double in_contact) {
      return std::sqrt(4 / std::numbers::pi * in_contact);
    };
    const double size = std::sqrt(force.x * force.x + force.y * force.y + force.z * force.z);
    ContactQuality found{.overlap = overlap, .force = size};
    if (across(faces) >= ContactQuality::min_edges) return found;
    found.narrow_force = size;
    found.narrow_width = size * across(area);
    found.narrow_edges = size * across(faces);
    return found;
  }
};

struct TouchLooker {
  const contact_quality& s;

  const Shape::Face& face_of(int slot, int face) const {
    return entry(s.bodies.shape_of(slot).faces, face);
  }
  TouchedFaces with_other(int pair) const {
    const contact_force::Pairs& rows = s.pairs->rows;
    TouchedFaces found;
    const SurfaceVector shift =
        s.pairs->images
            ? vector_of(s.pairs->images->shift(Row<FaceContact>(entry(rows.of->begin, pair))))
            : SurfaceVector{};
    for_touching_points(rows, pair, [&](Row<FaceContact> row, int g, const auto& force) {
      const int slot = rows.pair(row, 0), face = rows.pair(row, 1);
      found.add_point(face_of(slot, face), g, vector_of(force));
      const SampledPoint at = sampled_point(s.bodies.patch(s.position.values(), slot, face), g);
      const PointOnSurface there =
          closest_point(s.bodies, s.position.values(), s.pairs->point, row, g, rows.pair(row, 2));
      found.add_overlap(0.5 * at.area, dot(there.x - (at.x - shift), there.normal));
    });
    return found;
  }
  void find_pairs(int slot, std::vector<ContactQuality>& found) const {
    const FacePairs& of = *s.pairs->rows.of;
    const std::int32_t end = entry(s.index->sampled_begin, slot + 1);
    for (int p = of.from_row(entry(s.index->sampled_begin, slot)); entry(of.begin, p) < end; ++p)
      found.push_back(with_other(p).quality());
  }

  void add_tool(Row<FaceToolContact> row, TouchedFaces& found) const {
    const auto& rows = s.tools->rows;
    const int slot = rows.pair(row, 0), face = rows.pair(row, 1);
    const PatchNumbers own = s.bodies.patch(s.position.values(), slot, face);
    const auto gaps = gaps_to_tool(s.bodies, s.position.values(), *s.tools, row);
    for (int g = 0; g < face_points; ++g) {
      const auto part = [&](int k) { return rows.force(row, face_points * k + g); };
      const SurfaceVector f{part(0), part(1), part(2)};
      if (f.x == 0 && f.y == 0 && f.z == 0) continue;
      found.add_point(face_of(slot, face), g, f);
      found.add_overlap(sampled_point(own, g).area,
                        entry(gaps, g / lane_count).gap[g % lane_count]);
    }
  }
  void find_tools(int slot, std::vector<ContactQuality>& found) const {
    std::vector<TouchedFaces> sides;
    for (const Row<FaceToolContact> row :
         RowRange<FaceToolContact>::of(s.index->tool_begin, slot)) {
      if (s.tools->rows.touches(row) == 0) continue;
      const int tool = s.tools->rows.pair(row, 2);
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
