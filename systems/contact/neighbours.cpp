#include "systems/contact/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace pulvis {
namespace {

// Particles by cell of a uniform grid; a cell is as large as the largest particle, so that neighbours are in
// adjacent cells.
template <class D>
class ParticleGrid {
 public:
  ParticleGrid(const std::vector<BoxOf<D>>& boxes, const std::vector<int>& ids, double distance) {
    BoxOf<D> all = entry(boxes, ids.front());
    for (const int i : ids) {
      const BoxOf<D>& b = entry(boxes, i);
      all = joined(all, b);
      for (std::size_t k = 0; k < D::axes; ++k)
        size_ = std::max(size_, b.high[k] - b.low[k] + distance);
    }
    low_ = all.low;
    // A particle that flew away must not inflate the grid; far cells are clamped to the last one.
    constexpr double most = D::axes == 2 ? 4096 : 256;
    std::size_t cells = 1;
    for (std::size_t k = 0; k < D::axes; ++k) {
      count_[k] = static_cast<int>(std::clamp((all.high[k] - all.low[k]) / size_ + 1, 1.0, most));
      cells *= static_cast<std::size_t>(count_[k]);
    }
    begin_.assign(cells + 1, 0);
    for (const int i : ids) entry(begin_, cell(indices(entry(boxes, i))) + 1) += 1;
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    members_.resize(ids.size());
    std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
    for (const int i : ids) entry(members_, entry(next, cell(indices(entry(boxes, i))))++) = i;
  }

  template <class Visit>
  void around(const BoxOf<D>& box, const Visit& visit) const {
    ImageIn<D> low = indices(box), high = low;
    for (std::size_t k = 0; k < D::axes; ++k) {
      low[k] = std::max(low[k] - 1, 0);
      high[k] = std::min(high[k] + 1, count_[k] - 1);
    }
    for_images<D>(low, high, [&](const ImageIn<D>& at) {
      const int c = cell(at);
      for (int m = entry(begin_, c); m < entry(begin_, c + 1); ++m) visit(entry(members_, m));
    });
  }

 private:
  ImageIn<D> indices(const BoxOf<D>& box) const {
    const typename D::Point middle = box.middle();
    ImageIn<D> at;
    for (std::size_t k = 0; k < D::axes; ++k)
      at[k] = static_cast<int>(std::clamp((middle[k] - low_[k]) / size_, 0.0, count_[k] - 1.0));
    return at;
  }
  int cell(const ImageIn<D>& at) const {
    int number = 0;
    for (std::size_t k = D::axes; k > 0; --k) number = number * count_[k - 1] + at[k - 1];
    return number;
  }

  double size_ = 0;
  std::array<double, D::axes> low_{};
  std::array<int, D::axes> count_{};
  std::vector<std::int32_t> begin_, members_;
};

// All particles wrapped into the cell, and the images that come near the cell.
template <class D>
class PeriodicImages {
 public:
  using Box = BoxOf<D>;
  using Neighbour = NeighbourIn<D>;

  PeriodicImages(const PeriodicCell<D>& cell, const std::vector<Box>& boxes,
                 const std::vector<int>& slots, double distance)
      : home_(boxes.size()), boxes_(boxes.size()), of_(boxes.size()), ids_(slots) {
    const Tensor<D> inverse = cell.vectors.inverse();
    std::optional<Box> all;
    for (const int s : slots) {
      ImageIn<D>& home = entry(home_, s);
      const typename D::Point share = inverse * entry(boxes, s).middle();
      for (std::size_t k = 0; k < D::axes; ++k)
        home[k] = -static_cast<std::int32_t>(std::floor(share[k]));
      entry(boxes_, s) = moved(entry(boxes, s), cell.vectors * home);
      entry(of_, s) = {s, home};
      all = all ? joined(*all, entry(boxes_, s)) : entry(boxes_, s);
    }
    const ImageIn<D> most = farthest(inverse, *all, distance);
    ImageIn<D> least;
    for (std::size_t k = 0; k < D::axes; ++k) least[k] = -most[k];
    for_images<D>(least, most, [&](const ImageIn<D>& image) {
      if (image == ImageIn<D>{}) return;
      const typename D::Point shift = cell.vectors * image;
      for (const int s : slots) {
        const Box box = moved(entry(boxes_, s), shift);
        if (!near(box, *all, distance)) continue;
        ids_.push_back(static_cast<int>(boxes_.size()));
        boxes_.push_back(box);
        Neighbour of{s, entry(home_, s)};
        for (std::size_t k = 0; k < D::axes; ++k) of.image[k] += image[k];
        of_.push_back(of);
      }
    });
  }

  const std::vector<Box>& boxes() const { return boxes_; }
  const std::vector<int>& ids() const { return ids_; }
  // The image with that index, as seen by the particle in `slot` from its actual position.
  Neighbour seen_from(int slot, int id) const {
    Neighbour there = entry(of_, id);
    const ImageIn<D>& own = entry(home_, slot);
    for (std::size_t k = 0; k < D::axes; ++k) there.image[k] -= own[k];
    return there;
  }

 private:
  // As many periods on each side as can reach across: the extent of all over the distance of two faces of the cell, which
  // is 1 over the length of a row of the inverse.
  static ImageIn<D> farthest(const Tensor<D>& inverse, const Box& all, double distance) {
    double square = 0;
    for (std::size_t k = 0; k < D::axes; ++k)
      square += (all.high[k] - all.low[k]) * (all.high[k] - all.low[k]);
    const double extent = std::sqrt(square) + distance;
    ImageIn<D> most;
    for (std::size_t k = 0; k < D::axes; ++k) {
      double row = 0;
      for (std::size_t i = 0; i < D::axes; ++i) row += inverse(k, i) * inverse(k, i);
      most[k] = static_cast<std::int32_t>(std::ceil(extent * std::sqrt(row)));
    }
    return most;
  }

  std::vector<ImageIn<D>> home_;  // [slots]
  std::vector<Box> boxes_;        // [slots], then images
  std::vector<Neighbour> of_;     // for each box: whose, by which periods
  std::vector<int> ids_;
};

}  // namespace

template <class D>
BySlot<NeighbourIn<D>> near_particles(const std::vector<BoxOf<D>>& own_boxes,
                                      const std::vector<int>& slots, const PeriodicCell<D>* cell,
                                      double distance) {
  using Neighbour = NeighbourIn<D>;
  const auto count = static_cast<int>(own_boxes.size());
  if (slots.empty()) return BySlot<Neighbour>::none(count);
  std::optional<PeriodicImages<D>> images;
  if (cell != nullptr) images.emplace(*cell, own_boxes, slots, distance);
  const std::vector<BoxOf<D>>& boxes = images ? images->boxes() : own_boxes;
  const ParticleGrid<D> grid(boxes, images ? images->ids() : slots, distance);
  std::vector<std::uint8_t> present(own_boxes.size());
  for (const int slot : slots) entry(present, slot) = 1;
  return list_by_slot<Neighbour>(count, [&](int slot, std::vector<Neighbour>& found) {
    if (entry(present, slot) == 0) return;
    const auto first = static_cast<std::ptrdiff_t>(found.size());
    const BoxOf<D>& own = entry(boxes, slot);
    grid.around(own, [&](int other) {
      if (!near(own, entry(boxes, other), distance)) return;
      const Neighbour there = images ? images->seen_from(slot, other) : Neighbour{other};
      if (may_fold<D> || !there.is(slot)) found.push_back(there);
    });
    std::sort(found.begin() + first, found.end());
  });
}

template BySlot<NeighbourIn<TwoD>> near_particles(const std::vector<BoxOf<TwoD>>&,
                                                  const std::vector<int>&,
                                                  const PeriodicCell<TwoD>*, double);
template BySlot<NeighbourIn<ThreeD>> near_particles(const std::vector<BoxOf<ThreeD>>&,
                                                    const std::vector<int>&,
                                                    const PeriodicCell<ThreeD>*, double);

}  // namespace pulvis
