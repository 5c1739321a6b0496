#include "scenes/packing/solids/support_table.hpp"

#include <algorithm>
#include <cmath>

namespace pulvis::space {
namespace {

constexpr int cells = 12;  // along an edge of the cube
constexpr std::size_t cells_of_side = cells * cells;

double part(const V3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

std::size_t cell_of(const V3& d) {
  const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
  const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  const double most = part(d, axis);
  const auto place = [&](int along) {
    const double share = part(d, along % 3) / std::abs(most);  // -1 .. 1
    return static_cast<std::size_t>(
        std::clamp(static_cast<int>((share + 1) / 2 * cells), 0, cells - 1));
  };
  const std::size_t side = static_cast<std::size_t>(2 * axis + (most < 0 ? 1 : 0));
  return side * cells_of_side + place(axis + 1) * cells + place(axis + 2);
}

// On the cube's surface, u and v from -1 to 1.
V3 direction_at(std::size_t side, double u, double v) {
  const double most = side % 2 == 0 ? 1 : -1;
  if (side < 2) return {most, u, v};
  return side < 4 ? V3{v, most, u} : V3{u, v, most};
}

std::size_t extreme_of(const std::vector<V3>& points, const V3& d) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (dot(points[i], d) > dot(points[best], d)) best = i;
  return best;
}

}  // namespace

// p is extreme along no n of a cell around c, |n - c| <= r, if (p - q).c + r |p - q| < 0, q being extreme along c.
SupportTable::SupportTable(std::vector<V3> points) : points_(std::move(points)) {
  constexpr double half = 1.0 / cells;
  const double around = std::sqrt(2.0) * half * (1 + 1e-9);
  for (std::size_t cell = 0; cell < 6 * cells_of_side; ++cell) {
    const std::size_t row = cell % cells_of_side / cells, column = cell % cells;
    const V3 c = direction_at(cell / cells_of_side, (2 * static_cast<double>(row) + 1) * half - 1,
                              (2 * static_cast<double>(column) + 1) * half - 1);
    const V3 q = points_[extreme_of(points_, c)];
    begin_.push_back(static_cast<std::int32_t>(candidates_.size()));
    for (const V3& p : points_)
      if (dot(p - q, c) + around * length(p - q) >= 0) candidates_.push_back(p);
  }
  begin_.push_back(static_cast<std::int32_t>(candidates_.size()));
}

const V3& SupportTable::extreme(const V3& direction) const {
  const std::size_t cell = cell_of(direction);
  const V3* best = &candidates_[static_cast<std::size_t>(begin_[cell])];
  const V3* const end = candidates_.data() + begin_[cell + 1];
  double most = dot(*best, direction);
  for (const V3* p = best + 1; p < end; ++p) {
    const double here = dot(*p, direction);
    if (here > most) most = here, best = p;
  }
  return *best;
}

}  // namespace pulvis::space
