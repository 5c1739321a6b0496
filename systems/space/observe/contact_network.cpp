// contact_network: sums the points of all contact rows into one contact for every pair of particles, and for every
// particle and tool in contact.
//
// Law      force = sum over the points of both half passes, as contact_force applies them to the bodies; the normal is the
//          direction of the sum of their normal parts, so that it does not depend on node positions. Area: current
//          area of the points with a force, mean of both sides
// Runs     in sampled steps, after the narrow phases
// Active   if the scene asks for contacts
#include "engine/entry.hpp"
#include "systems/contact/by_slot.hpp"
#include "systems/observe/gathered_contacts.hpp"
#include "systems/space/observe/surface_points.hpp"

namespace pulvis::space {
namespace {

using Gathered = GatheredContact<ThreeD>;
using Image = ImageIn<ThreeD>;

Point point_of(const SurfaceVector& v) { return {v.x, v.y, v.z}; }

struct Looker {
  const contact_network& s;

  int number(int slot) const { return entry(s.bodies.bodies->slots, slot).number; }
  // Adds the points of a face with a force: force_at(g), and normal_at(g), which points into the sampled particle.
  // `shift`: m, from where the sampled particle touches the link's first one to its position.
  template <class ForceAt, class NormalAt>
  void add_points(int slot, int number, double side, const ForceAt& force_at,
                  const NormalAt& normal_at, Gathered& contact, const Point& shift = {}) const {
    for (int g = 0; g < face_points; ++g) {
      const SurfaceVector force = force_at(g);
      if (force.x == 0 && force.y == 0 && force.z == 0) continue;
      const SampledPoint own = sampled_point(s.bodies.patch(s.position.values(), slot, number), g);
      const SurfaceVector at = own.x - SurfaceVector{shift[0], shift[1], shift[2]};
      contact.add({point_of(at), point_of(normal_at(g)), point_of(force), own.area}, side);
    }
  }
  void add_pair(Row<FaceContact> row, double side, Gathered& contact) const {
    const auto force_at = [&](int g) {
      const auto part = [&](int k) { return s.pairs->force(row, 3 * g + k); };
      return SurfaceVector{part(0), part(1), part(2)};
    };
    const auto normal_at = [&](int g) {
      return closest_point(s.bodies, s.position.values(), s.pairs->point, row, g,
                           s.pairs->pair(row, 2))
          .normal;
    };
    const Point shift = side > 0 || !s.pairs->images ? Point{} : s.pairs->images->shift(row);
    add_points(s.pairs->pair(row, 0), s.pairs->pair(row, 1), side, force_at, normal_at, contact,
               shift);
  }
  void add_tool(Row<FaceToolContact> row, Gathered& contact) const {
    const int slot = s.tools->rows.pair(row, 0), face = s.tools->rows.pair(row, 1);
    const auto gaps = gaps_to_tool(s.bodies, s.position.values(), *s.tools, row);
    const auto normal_at = [&](int g) { return normal_of(gaps, g); };
    const auto force_at = [&](int g) {
      const auto part = [&](int k) { return s.tools->rows.force(row, face_points * k + g); };
      return SurfaceVector{part(0), part(1), part(2)};
    };
    add_points(slot, face, 1, force_at, normal_at, contact);
  }

  Image image_of(Row<FaceContact> row) const {
    return s.pairs->images ? s.pairs->images->of(row) : Image{};
  }
  // With that particle, or its image.
  void add_to(ContactsOfParticle<ThreeD>& partners, int slot, int other, const Image& image,
              Row<FaceContact> row, double side) const {
    if (!counts_for_first<ThreeD>(number(slot), other, image)) return;
    const Point period = s.pairs->images ? s.pairs->images->cell->vectors * image : Point{};
    add_pair(row, side, partners.with(other, image, period));
  }
  // Searches the rows of a particle and those against it.
  void find_pairs(int slot, std::vector<ContactLink<ThreeD>>& found) const {
    ContactsOfParticle<ThreeD> partners(number(slot));
    for (const Row<FaceContact> row : RowRange<FaceContact>::of(s.index->sampled_begin, slot)) {
      if (s.pairs->touches(row) != 0)
        add_to(partners, slot, number(s.pairs->pair(row, 2)), image_of(row), row, 1);
    }
    const FacePairs& of = *s.pairs->of;
    for (int k = entry(of.other_begin, slot); k < entry(of.other_begin, slot + 1); ++k) {
      for (const Row<FaceContact> row :
           RowRange<FaceContact>::of(of.begin, entry(of.of_other, k))) {
        const Image n = image_of(row);
        if (s.pairs->touches(row) != 0)
          add_to(partners, slot, number(s.pairs->pair(row, 0)), {-n[0], -n[1], -n[2]}, row, -1);
      }
    }
    partners.move_to(found, 2);
  }
  void find_tools(int slot, std::vector<ContactLink<ThreeD>>& found) const {
    ContactsOfParticle<ThreeD> partners(number(slot));
    for (const Row<FaceToolContact> row : RowRange<FaceToolContact>::of(s.index->tool_begin, slot))
      if (s.tools->rows.touches(row) != 0) add_tool(row, partners.with(s.tools->rows.pair(row, 2)));
    partners.move_to(found, 1);
  }
};

}  // namespace

void contact_network::operator()() const {
  const Looker looker{*this};
  const auto found_by = [&](const auto& find) {
    auto links = list_by_slot<ContactLink<ThreeD>>(
        bodies.slots(), [&](int slot, std::vector<ContactLink<ThreeD>>& found) {
          if (bodies.bodies->owns(slot)) find(slot, found);
        });
    sort_by_numbers(links.all);
    return std::move(links.all);
  };
  network->pairs.clear();
  network->tools.clear();
  if (pairs)
    network->pairs = found_by([&](int slot, auto& found) { looker.find_pairs(slot, found); });
  if (tools)
    network->tools = found_by([&](int slot, auto& found) { looker.find_tools(slot, found); });
}

}  // namespace pulvis::space
