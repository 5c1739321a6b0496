// contact_network: combines the points of all contact rows into one contact for every pair of particles,
// and for every particle and tool that touch.
//
// Law      force = sum over the points of both half passes, as contact_force gives them to the bodies; the
//          normal is the direction of the sum of their normal components, so that it does not depend on the
//          mesh nodes. Length: current tributary length of the touching points, mean of both sides
// Runs     on sampled steps, after the narrow phases
// Active   when the scene requests contacts
#include "engine/entry.hpp"
#include "systems/contact/by_slot.hpp"
#include "systems/contact/contact_outlines.hpp"
#include "systems/observe/gathered_contacts.hpp"
#include "systems/observe/nearest_of_tool.hpp"
#include "systems/observe/systems.hpp"

namespace pulvis {
namespace {

using Gathered = GatheredContact<TwoD>;
using Image = ImageIn<TwoD>;

// Adds the points of a row that carry a force; normal_at(point, g) points into the sampled particle. `shift` m, from the
// position of the sampled particle to where it touches the link's first one.
template <class At, class NormalAt>
void add_points(const Curve& sampled, const Read<PointForce<At>>& force, Row<At> row, double side,
                const NormalAt& normal_at, Gathered& contact, const Point& shift = {}) {
  for (int g = 0; g < edge_points; ++g) {
    const Point f{force(row, 2 * g), force(row, 2 * g + 1)};
    if (f[0] == 0 && f[1] == 0) continue;
    const Point at = sampled.value(kernels::edge_u[g]), along = sampled.slope(kernels::edge_u[g]);
    const double length = kernels::edge_w[g] * length_of(along);
    contact.add({{at[0] + shift[0], at[1] + shift[1]}, normal_at(at, g), f, length}, side);
  }
}

std::vector<ContactLink<TwoD>> links_of_pairs(const Bodies& bodies, const ContactIndex& index,
                                              const Outlines& outlines,
                                              const TouchingPairs& pairs) {
  const auto& pair = pairs.rows.pair;
  const auto& touches = pairs.rows.touches;
  const auto& force = pairs.rows.force;
  const Read<ClosestPoint>& closest = pairs.closest;
  const auto add_row = [&](Row<Contact> row, double side, Gathered& contact) {
    const auto normal_at = [&](const Point&, int g) {
      const CurvePoint there = closest(row, g).unpacked();
      return outlines.from(pair(row, 2), there.edge).normal(there.u);
    };
    const Point shift = side > 0 || !pairs.images ? Point{} : pairs.images->shift(row);
    add_points(outlines.edge(pair(row, 0), pair(row, 1)), force, row, side, normal_at, contact,
               {-shift[0], -shift[1]});
  };
  const auto period_of = [&](const Image& image) {
    return pairs.images ? pairs.images->cell->vectors * image : Point{};
  };
  const auto image_of = [&](Row<Contact> row) {
    return pairs.images ? pairs.images->of(row) : Image{};
  };
  // Each pair belongs to its particle of lower number, whose rows and those against it are searched.
  auto links = list_by_slot<ContactLink<TwoD>>(
      static_cast<int>(bodies.slots.size()), [&](int slot, std::vector<ContactLink<TwoD>>& found) {
        const int number = outlines.number(slot);
        if (number == Bodies::empty_slot) return;
        const auto s = static_cast<std::size_t>(slot);
        ContactsOfParticle<TwoD> partners(number);
        for (int r = index.sampled_begin[s]; r < index.sampled_begin[s + 1]; ++r) {
          const Row<Contact> row(r);
          if (touches(row) == 0) continue;
          const int other = outlines.number(pair(row, 2));
          const Image image = image_of(row);
          if (counts_for_first<TwoD>(number, other, image))
            add_row(row, 1, partners.with(other, image, period_of(image)));
        }
        for (int k = index.other_begin[s]; k < index.other_begin[s + 1]; ++k) {
          const Row<Contact> row(entry(index.other_rows, k));
          if (touches(row) == 0) continue;
          const int other = outlines.number(pair(row, 0));
          const Image n = image_of(row), image{-n[0], -n[1]};
          if (counts_for_first<TwoD>(number, other, image))
            add_row(row, -1, partners.with(other, image, period_of(image)));
        }
        partners.move_to(found, 2);
      });
  sort_by_numbers(links.all);
  return std::move(links.all);
}

}  // namespace

void contact_network::operator()() const {
  const Outlines outlines(*bodies, control.values());
  network->pairs.clear();
  network->tools.clear();
  if (pairs) network->pairs = links_of_pairs(*bodies, *index, outlines, *pairs);
  if (!tools) return;

  for (const int slot : bodies->slot_of_number) {
    const auto s = static_cast<std::size_t>(slot);
    ContactsOfParticle<TwoD> partners(outlines.number(slot));
    for (int r = index->tool_begin[s]; r < index->tool_begin[s + 1]; ++r) {
      const Row<ToolContact> row(r);
      if (tools->rows.touches(row) == 0) continue;
      add_points(
          outlines.edge(slot, tools->rows.pair(row, 1)), tools->rows.force, row, 1,
          [&](const Point& at, int) { return nearest_of_tool(*tools, row, at).normal; },
          partners.with(tools->rows.pair(row, 2)));
    }
    partners.move_to(network->tools, 1);
  }
  sort_by_numbers(network->tools);
}

}  // namespace pulvis
