#include "scenes/lever/mesh/ball_cells.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>

namespace pulvis {
namespace {

constexpr std::array<std::array<std::size_t, 4>, 6> faces_of_cell{
    {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

// ((parts - weight) a + weight b) over parts.
BallKey between(const BallKey& a, const BallKey& b, int weight = 1, int parts = 2) {
  BallKey at;
  for (std::size_t k = 0; k < 4; ++k) at[k] = ((parts - weight) * a[k] + weight * b[k]) / parts;
  return at;
}

// A cell is a box in its coordinates: the child at a corner extends half way to all others.
std::array<BallCell, 8> children(const BallCell& cell) {
  std::array<BallCell, 8> all;
  for (std::size_t c = 0; c < 8; ++c)
    for (std::size_t k = 0; k < 8; ++k) all[c][k] = between(cell[c], cell[k]);
  return all;
}

// Size along its longest side.
int size_of(const BallCell& cell) {
  int size = 0;
  for (std::size_t k = 0; k < 4; ++k) size = std::max(size, std::abs(cell[6][k] - cell[0][k]));
  return size;
}

using Points = std::set<BallKey>;

Points points_of(const std::vector<BallCell>& cells) {
  Points points;
  for (const BallCell& cell : cells) points.insert(cell.begin(), cell.end());
  return points;
}

// Whether a quarter of one of the faces has a node inside: a neighbour is less than half as large.
bool meets_much_smaller(const BallCell& cell, const Points& points) {
  if (size_of(cell) < 4) return false;
  for (const auto& face : faces_of_cell)
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; j <= 4; ++j) {
        if (i % 2 == 0 && j % 2 == 0) continue;
        const BallKey low = between(cell[face[0]], cell[face[1]], i, 4);
        const BallKey high = between(cell[face[3]], cell[face[2]], i, 4);
        if (points.contains(between(low, high, j, 4))) return true;
      }
  return false;
}

BallKey on_face(std::size_t axis, int value, int u, int v, int layer) {
  BallKey at{0, 0, 0, layer};
  at[axis] = value;
  at[(axis + 1) % 3] = u;
  at[(axis + 2) % 3] = v;
  return at;
}

}  // namespace

BallCells::BallCells(int across) : across_(across), layers_(std::max(1, across / 2)) {
  add_core();
  add_shells();
}

void BallCells::add_core() {
  constexpr int one = fineness();
  for (int i = 0; i < across(); i += one)
    for (int j = 0; j < across(); j += one)
      for (int k = 0; k < across(); k += one)
        cells_.push_back({{{i, j, k, 0},
                           {i + one, j, k, 0},
                           {i + one, j + one, k, 0},
                           {i, j + one, k, 0},
                           {i, j, k + one, 0},
                           {i + one, j, k + one, 0},
                           {i + one, j + one, k + one, 0},
                           {i, j + one, k + one, 0}}});
}

void BallCells::add_shells() {
  constexpr int one = fineness();
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {0, across()})
      for (int u = 0; u < across(); u += one)
        for (int v = 0; v < across(); v += one)
          for (int l = 0; l < layers(); l += one) {
            const auto at = [&](int du, int dv, int dl) {
              return on_face(axis, side, u + du, v + dv, l + dl);
            };
            cells_.push_back({at(0, 0, 0), at(one, 0, 0), at(one, one, 0), at(0, one, 0),
                              at(0, 0, one), at(one, 0, one), at(one, one, one), at(0, one, one)});
          }
}

void BallCells::divide(const std::function<bool(const BallCell&)>& too_large) {
  const auto pass = [&](const auto& wanted) {
    std::vector<BallCell> next;
    for (const BallCell& cell : cells_) {
      if (!wanted(cell)) {
        next.push_back(cell);
        continue;
      }
      const auto parts = children(cell);
      next.insert(next.end(), parts.begin(), parts.end());
    }
    const bool divided = next.size() > cells_.size();
    cells_ = std::move(next);
    return divided;
  };
  while (pass([&](const BallCell& cell) { return size_of(cell) > 1 && too_large(cell); }))
    ;
  bool divided = true;
  while (divided) {
    const Points points = points_of(cells_);
    divided = pass([&](const BallCell& cell) { return meets_much_smaller(cell, points); });
  }
}

std::vector<BallCells::Hanging> BallCells::hanging() const {
  const Points points = points_of(cells_);
  std::vector<BallCell> largest_first = cells_;
  std::ranges::stable_sort(largest_first, std::ranges::greater{}, size_of);
  Points told;
  std::vector<Hanging> all;
  const auto tell = [&](const BallKey& middle, std::vector<BallKey> on) {
    if (points.contains(middle) && told.insert(middle).second)
      all.push_back({middle, std::move(on)});
  };
  for (const BallCell& cell : largest_first) {
    if (size_of(cell) < 2) continue;
    for (const auto& face : faces_of_cell) {
      for (std::size_t c = 0; c < 4; ++c) {
        const BallKey &a = cell[face[c]], &b = cell[face[(c + 1) % 4]];
        tell(between(a, b), {a, b});
      }
      tell(between(cell[face[0]], cell[face[2]]),
           {cell[face[0]], cell[face[1]], cell[face[2]], cell[face[3]]});
    }
  }
  return all;
}

std::vector<std::array<BallKey, 4>> BallCells::surface() const {
  std::vector<std::array<BallKey, 4>> faces;
  for (const BallCell& cell : cells_)
    for (const auto& f : faces_of_cell)
      if (std::ranges::all_of(f, [&](std::size_t c) { return cell[c][3] == layers(); }))
        faces.push_back({cell[f[0]], cell[f[1]], cell[f[2]], cell[f[3]]});
  return faces;
}

}  // namespace pulvis
