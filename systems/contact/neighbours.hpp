// Which particles are near which others, in both dimensions, with their periodic images in a cell: pure geometry of boxes.
#pragma once

#include <vector>

#include "components/cell.hpp"
#include "systems/contact/box.hpp"
#include "systems/contact/by_slot.hpp"

namespace pulvis {

// A particle near another one, either the particle itself or one of its periodic images.
template <class D>
struct NeighbourIn {
  std::int32_t slot;
  ImageIn<D> image{};

  bool operator==(const NeighbourIn&) const = default;
  auto operator<=>(const NeighbourIn&) const = default;
  bool is(int particle) const { return slot == particle && image == ImageIn<D>{}; }
};

// m, offset of an image from its particle.
template <class D>
typename D::Point shift_of(const PeriodicCell<D>* cell, const ImageIn<D>& image) {
  return cell == nullptr ? typename D::Point{} : cell->vectors * image;
}

// Outlines may touch themselves; surfaces of solids are not searched for that.
template <class D>
inline constexpr bool may_fold = D::axes == 2;

// For every slot, the particles whose boxes are within `distance` of its own, itself included if it can fold, ascending by
// slot and image.
// `boxes`: [slots], of those in `slots`; `cell`: null if nothing is periodic.
template <class D>
BySlot<NeighbourIn<D>> near_particles(const std::vector<BoxOf<D>>& boxes,
                                      const std::vector<int>& slots, const PeriodicCell<D>* cell,
                                      double distance);

// Stores what was found for skin_check.
template <class D>
void keep_neighbours(const BySlot<NeighbourIn<D>>& found, const PeriodicCell<D>* cell,
                     ContactIndex& index) {
  index.neighbour_begin = found.begin;
  index.neighbours.clear();
  index.images.clear();
  for (const NeighbourIn<D>& neighbour : found.all) {
    index.neighbours.push_back(neighbour.slot);
    if (cell != nullptr)
      index.images.insert(index.images.end(), neighbour.image.begin(), neighbour.image.end());
  }
  if (cell != nullptr) index.cell_before.assign(cell->vectors.t.begin(), cell->vectors.t.end());
}

}  // namespace pulvis
