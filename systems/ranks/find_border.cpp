// find_border: which particles of other ranks are near those of this one, and the positions of their outlines.
//
// Law      every rank sends the box of its own particles to all others, and to each rank what is near its box. So both
//          ranks of a pair of particles have both outlines, and find the same candidates
// Runs     between skin_check, which triggers it, and the broad phase
// Active   when the run has several ranks
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "systems/ranks/border.hpp"
#include "systems/ranks/systems.hpp"

namespace pulvis {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

struct Extent {  // a box, z = 0 in two dimensions; initially empty
  std::array<double, 3> low{endless, endless, endless}, high{-endless, -endless, -endless};

  void take(std::size_t axis, double x) {
    low[axis] = std::min(low[axis], x);
    high[axis] = std::max(high[axis], x);
  }
  void take(const Extent& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      take(k, other.low[k]);
      take(k, other.high[k]);
    }
  }
  template <std::size_t N>
  bool is_near(const Extent& other, const std::array<double, N>& shift, double distance) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const double by = k < N ? shift[k] : 0;
      if (!(low[k] + by <= other.high[k] + distance && other.low[k] <= high[k] + by + distance))
        return false;
    }
    return true;
  }
  bool is_empty() const { return low[0] > high[0]; }
};

Extent extent_of(TwoD, std::span<const double> points) {
  Extent extent;
  for (std::size_t i = 0; i < points.size(); ++i) extent.take(i % 2, points[i]);
  extent.take(2, 0);
  return extent;
}
Extent extent_of(ThreeD, std::span<const double> points) {
  Extent extent;
  for (std::size_t i = 0; i < points.size(); ++i) extent.take(i % 3, points[i]);
  return extent;
}

// Whether `own`, or an image of it, comes near `there`.
template <class D>
bool comes_near(const Extent& own, const Extent& there, const PeriodicCell<D>* cell,
                double distance) {
  if (there.is_empty()) return false;
  if (cell == nullptr) return own.is_near(there, typename D::Point{}, distance);
  const Tensor<D> inverse = cell->vectors.inverse();
  typename D::Point apart{}, half{};
  for (std::size_t k = 0; k < D::axes; ++k) {
    apart[k] = 0.5 * (there.low[k] + there.high[k] - own.low[k] - own.high[k]);
    half[k] = 0.5 * (there.high[k] - there.low[k] + own.high[k] - own.low[k]) + distance;
  }
  const typename D::Point middle = inverse * apart;
  ImageIn<D> first, last;
  for (std::size_t k = 0; k < D::axes; ++k) {
    double width = 0;
    for (std::size_t i = 0; i < D::axes; ++i) width += std::abs(inverse(k, i)) * half[i];
    first[k] = static_cast<int>(std::floor(middle[k] - width));
    last[k] = static_cast<int>(std::ceil(middle[k] + width));
  }
  bool found = false;
  for_images<D>(first, last, [&](const ImageIn<D>& image) {
    found = found || own.is_near(there, cell->vectors * image, distance);
  });
  return found;
}

// The box of the particles of every rank.
std::vector<Extent> extents_of_ranks(const RankLink& link, const Extent& own) {
  const auto count = static_cast<std::size_t>(link.ranks->count());
  std::vector<double> numbers(6 * count, -endless);
  double* mine = &numbers[6 * static_cast<std::size_t>(link.ranks->rank())];
  for (std::size_t k = 0; k < 3; ++k) {
    mine[k] = -own.low[k];
    mine[3 + k] = own.high[k];
  }
  link.ranks->maximum(numbers);
  std::vector<Extent> all(count);
  for (std::size_t r = 0; r < count; ++r)
    for (std::size_t k = 0; k < 3; ++k) {
      all[r].low[k] = -numbers[6 * r + k];
      all[r].high[k] = numbers[6 * r + 3 + k];
    }
  return all;
}

}  // namespace

template <class D>
void find_border<D>::operator()() const {
  if (!index->due) return;
  const PeriodicCell<D>* periodic = cell ? &**cell : nullptr;
  const Outlines positions(outlines.position);
  std::vector<Extent> extent;
  Extent own;
  for (const int slot : bodies->own_slots) {
    extent.push_back(extent_of(D{}, positions.of(slot)));
    own.take(extent.back());
  }
  const std::vector<Extent> of_rank = extents_of_ranks(*link, own);
  std::vector<Ranks::Bytes> to(of_rank.size());
  std::vector<std::vector<int>> sent(of_rank.size());
  for (std::size_t r = 0; r < of_rank.size(); ++r) {
    if (static_cast<int>(r) == link->ranks->rank()) continue;
    for (std::size_t i = 0; i < extent.size(); ++i)
      if (comes_near(extent[i], of_rank[r], periodic, index->neighbourhood))
        sent[r].push_back(bodies->own_slots[i]);
    std::ranges::sort(sent[r]);
    to[r] = bytes_of_slots(sent[r]);
  }
  const std::vector<Ranks::Bytes> from = link->ranks->all_to_all(std::move(to));
  std::vector<int> border;
  link->border.clear();
  for (std::size_t r = 0; r < of_rank.size(); ++r) {
    if (sent[r].empty() && from[r].empty()) continue;
    link->border.push_back({static_cast<int>(r), sent[r], slots_in(from[r])});
    const auto& received = link->border.back().receive;
    border.insert(border.end(), received.begin(), received.end());
  }
  bodies->set_border(border);
  tell_border(*link, outlines.all());
  const Outlines old(before);
  for (const int slot : border) std::ranges::copy(positions.of(slot), old.of(slot).begin());
}

template struct find_border<TwoD>;
template struct find_border<ThreeD>;

}  // namespace pulvis
