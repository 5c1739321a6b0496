// bin_faces, bin_tool_faces: broad phase in three dimensions: rebuilds the contact rows once the surfaces have moved
// through the skin.
//
// History (closest points, friction springs) is matched by the key (particle, other, image, face) or (particle, face, tool): rows
// are sorted by it, so that old and new rows of a particle are merged in one pass.
// Runs     after skin_check, which decides when; a sync point (row counts change)
#include <oneapi/tbb/parallel_for.h>

#include <cmath>

#include "systems/space/contact/broad_phase.hpp"
#include "systems/space/contact/systems.hpp"
#include "systems/space/contact/tool_search.hpp"

namespace pulvis::space {
namespace {

struct FaceKey {
  std::int32_t slot, face, other;
  ImageIn<ThreeD> image{};
};
FaceKey key_of(const FaceCandidate& c) { return {c.slot, c.face, c.other.slot, c.other.image}; }
FaceKey key_of(const ToolCandidate& c) { return {c.slot, c.face, c.tool}; }

// The sort order of rows.
template <class At>
std::array<std::int32_t, 6> order_of(const FaceKey& key) {
  const auto [x, y, z] = key.image;
  if constexpr (std::is_same_v<At, FaceContact>) return {key.slot, key.other, x, y, z, key.face};
  return {key.slot, key.face, key.other};
}

// The keys of the rows from the last rebuild.
template <class At>
struct KeysBefore {
  const Write<ContactPair<At>>& pair;
  const Write<ContactImage<At>>* image;  // in a periodic cell
  FaceKey operator()(Row<At> row) const {
    FaceKey key{pair(row, 0), pair(row, 1), pair(row, 2)};
    for (std::size_t k = 0; image != nullptr && k < key.image.size(); ++k)
      key.image[k] = (*image)(row, static_cast<int>(k));
    return key;
  }
};

// For every new row the old one with the same key, or -1. Old rows of a slot: `before_begin`, from the last rebuild; empty
// if there was none.
template <class At, class Candidate>
std::vector<std::int32_t> rows_before(const std::vector<std::int32_t>& before_begin,
                                      const KeysBefore<At>& before, const BySlot<Candidate>& now) {
  std::vector<std::int32_t> source(now.all.size(), -1);
  if (before_begin.empty()) return source;
  const auto old_order = [&](std::int32_t row) { return order_of<At>(before(Row<At>(row))); };
  for_slots(static_cast<int>(now.begin.size()) - 1, [&](int slot) {
    std::int32_t b = entry(before_begin, slot);
    const std::int32_t end = entry(before_begin, slot + 1);
    for (auto n = entry(now.begin, slot); n < entry(now.begin, slot + 1); ++n) {
      const auto order = order_of<At>(key_of(entry(now.all, n)));
      while (b < end && old_order(b) < order) ++b;
      if (b < end && old_order(b) == order) entry(source, n) = b;
    }
  });
  return source;
}

// kappa = k K s of the sampled face, s its stiffness, in series with the mean of the other surface, like two springs: a sphere touching
// its mirror image gets the same force as on a rigid plane.
double stiffness_of_pair(const ContactStiffness& material, const ShapedBodies<ThreeD>& bodies,
                         const FaceKey& key) {
  const double a = entry(material.bulk.values(), key.slot) *
                   entry(bodies.shape_of(key.slot).faces, key.face).stiffness;
  const double b =
      entry(material.bulk.values(), key.other) * bodies.shape_of(key.other).mean_face_stiffness;
  return material.rules->stiffness * a * b / (a + b);
}

// Of surfaces that may be bonded from the start, relative to the others.
double initial_stiffness(const ContactStiffness& material, const ShapedBodies<ThreeD>& bodies,
                         const FaceKey& key) {
  if (!material.bonds) return 1;
  const auto& slots = bodies.bodies->slots;
  const BondRules& bonds = **material.bonds;
  return bonds.contact_stiffness(
      bonds.initial_between(entry(slots, key.slot), entry(slots, key.other)));
}
double initial_stiffness_with_tool(const ContactStiffness& material,
                                   const ShapedBodies<ThreeD>& bodies, const FaceKey& key) {
  if (!material.bonds) return 1;
  const BondRules& bonds = **material.bonds;
  return bonds.contact_stiffness(
      bonds.initial_with_tool(key.other, entry(bodies.bodies->slots, key.slot)));
}

template <class At>
void set_row(Row<At> row, const FaceKey& key, const Shape::Face& face, double kappa, double rho,
             double friction, double share_of_critical, const NewRows<At>& rows) {
  using Law = ContactLaw<At>;
  rows.pair(row, 0) = key.slot;
  rows.pair(row, 1) = key.face;
  rows.pair(row, 2) = key.other;
  rows.law(row, Law::stiffness) = kappa;
  rows.law(row, Law::friction) = friction;
  // c = 2 xi sqrt(kappa rho h): the mass per area of the element behind, on the contact spring.
  rows.law(row, Law::damping) = 2 * share_of_critical * std::sqrt(kappa * rho * face.thickness);
  rows.law(row, Law::inv_size) = 1 / face.size;
}

// Nothing is known about a new row: all its points are active.
template <class At>
void activate(Row<At> row, const NewRows<At>& rows) {
  for (int i = 0; i < ReactivationDistance<At>::count; ++i) rows.activation(row, i) = 0;
}

void start_from(int face, Row<FaceContact> row, const Write<ContactPoint>& point) {
  for (int g = 0; g < face_points; ++g) {
    point(row, ContactPoint::numbers * g + ContactPoint::face_u) = face + 0.5;
    point(row, ContactPoint::numbers * g + ContactPoint::v) = 0.5;
  }
}

}  // namespace

void bin_faces::operator()() const {
  if (!index->due) return;
  const ContactRules& rules = *material.rules;
  const SurfaceBoxes boxes = surface_boxes(bodies, position.values());
  const PeriodicCell<ThreeD>* periodic = pairs.cell ? &**pairs.cell : nullptr;
  const BySlot<Neighbour> neighbours =
      near_particles(boxes.particle, bodies.bodies->present_slots, periodic, index->neighbourhood);
  BySlot<FaceCandidate> found =
      face_candidates(bodies, boxes, periodic, neighbours, index->skin + index->reach);
  const std::vector<std::int32_t> source = rows_before<FaceContact>(
      index->sampled_begin, {rows.pair, pairs.image ? &*pairs.image : nullptr}, found);
  structure.rebuild(source);
  tbb::parallel_for(std::size_t{0}, found.all.size(), [&](std::size_t r) {
    const Row<FaceContact> row(static_cast<std::int64_t>(r));
    const FaceKey key = key_of(found.all[r]);
    const auto material_of = [&](int slot) { return entry(bodies.bodies->slots, slot).material; };
    set_row(row, key, entry(bodies.shape_of(key.slot).faces, key.face),
            stiffness_of_pair(material, bodies, key) * initial_stiffness(material, bodies, key),
            std::min(entry(material.density.values(), key.slot),
                     entry(material.density.values(), key.other)),
            rules.between(material_of(key.slot), material_of(key.other)).friction.coefficient,
            rules.damping, rows);
    for (std::size_t k = 0; pairs.image && k < key.image.size(); ++k)
      (*pairs.image)(row, static_cast<int>(k)) = key.image[k];
    if (source[r] >= 0) return;
    activate(row, rows);
    start_from(found.all[r].start, row, point);
  });
  pairs.list->list(rows.pair.values(),
                   pairs.image ? pairs.image->values() : std::span<std::int32_t>{},
                   found.begin.size());
  index->sampled_begin = std::move(found.begin);
  keep_neighbours(neighbours, periodic, *index);
}

namespace {

// The triangles of mesh tools that the rows can touch.
void list_triangles(const BySlot<ToolCandidate>& found, const FaceLook& look,
                    const ToolSurfaces& tools, const bin_tool_faces::Triangles& triangles) {
  std::vector<std::int32_t>& list = triangles.lists->triangles;
  list.clear();
  for (std::size_t r = 0; r < found.all.size(); ++r) {
    const ToolCandidate& c = found.all[r];
    const Row<FaceToolContact> row(static_cast<std::int64_t>(r));
    triangles.range(row, 0) = static_cast<std::int32_t>(list.size());
    if (tools.shape(c.tool).kind == ToolShapes::Kind::mesh) look.add_triangles(c, list);
    triangles.range(row, 1) = static_cast<std::int32_t>(list.size());
  }
}

}  // namespace

void bin_tool_faces::operator()() const {
  if (!index->due) return;
  const ContactRules& rules = *material.rules;
  const FaceLook look{bodies, position.values(), tools, index->skin + index->reach};
  BySlot<ToolCandidate> found = tool_candidates(look);
  structure.rebuild(
      rows_before<FaceToolContact>(index->tool_begin, {rows.columns.pair, nullptr}, found));
  for (std::size_t r = 0; r < found.all.size(); ++r) {
    const FaceKey key = key_of(found.all[r]);
    const Shape::Face& face = entry(bodies.shape_of(key.slot).faces, key.face);
    set_row(Row<FaceToolContact>(static_cast<std::int64_t>(r)), key, face,
            rules.stiffness * entry(material.bulk.values(), key.slot) * face.stiffness *
                initial_stiffness_with_tool(material, bodies, key),
            entry(material.density.values(), key.slot),
            rules.with_tool(key.other, entry(bodies.bodies->slots, key.slot).material)
                .friction.coefficient,
            rules.damping, rows.columns);
    activate(Row<FaceToolContact>(static_cast<std::int64_t>(r)), rows.columns);
  }
  if (triangles) list_triangles(found, look, tools, *triangles);
  rows.blocks->divide(found.begin);
  index->tool_begin = std::move(found.begin);
}

}  // namespace pulvis::space
