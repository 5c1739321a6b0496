#include "scenes/meshes/star_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/entry.hpp"
#include "engine/portable_math.hpp"
#include "engine/result_cache.hpp"
#include "scenes/meshes/smooth_mesh.hpp"

namespace pulvis {
namespace {

// The core's corners are the boundary nodes start, start + columns, start + n/2, start + n/2 + columns.
struct Split {
  int start, columns;
};

std::size_t wrapped(int i, std::size_t n) {
  const int size = static_cast<int>(n);
  return static_cast<std::size_t>((i % size + size) % size);
}

StarGrid grid_of(const std::vector<Point>& boundary, const Point& centre, int rings,
                 const Split& split) {
  constexpr double core = 0.6;  // of the distance outwards, before smoothing
  const int n = static_cast<int>(boundary.size());
  const OGrid grid{split.columns, n / 2 - split.columns, rings};
  std::vector<Point> outline, rim;
  for (int i = 0; i < n; ++i) {
    outline.push_back(boundary[wrapped(split.start + i, boundary.size())]);
    rim.push_back(between(centre, outline.back(), core));
  }
  const auto even = [](int edges) {
    return stations_of(std::vector<double>(static_cast<std::size_t>(edges), 1.0));
  };
  StarGrid result{
      nodes_of(grid, outline, rim, ring_shares(rings, 1), even(grid.columns), even(grid.rows)),
      quads_of(grid)};
  std::copy(boundary.begin(), boundary.end(), result.nodes.begin());
  for (Quad& quad : result.quads)
    for (Row<Node>& node : quad)
      if (node.value < n) node = Row<Node>((node.value + split.start) % n);
  return result;
}

struct MirrorLine {
  int sum;          // i -> sum - i maps the boundary nodes onto their mirror images
  bool along_axis;  // the line is the outline's x or y axis
};

std::vector<MirrorLine> mirror_lines(const std::vector<Point>& boundary, const Point& centre) {
  const int n = static_cast<int>(boundary.size());
  const auto at = [&](int i) { return boundary[wrapped(i, boundary.size())]; };
  const auto distance = [](const Point& a, const Point& b) {
    return portable::hypot(a[0] - b[0], a[1] - b[1]);
  };
  const double tolerance = 1e-6 * distance(at(0), centre);
  const auto mirrors = [&](int m) {
    for (int i = 0; i < n; ++i)
      if (std::abs(distance(at(i), centre) - distance(at(m - i), centre)) > tolerance ||
          std::abs(distance(at(i), at(i + 1)) - distance(at(m - i), at(m - i - 1))) > tolerance)
        return false;
    return true;
  };
  const auto along_axis = [&](int m) {
    const Point on_line = between(at(m / 2), at((m + 1) / 2), 0.5);
    return std::min(std::abs(on_line[0] - centre[0]), std::abs(on_line[1] - centre[1])) < tolerance;
  };
  std::vector<MirrorLine> lines;
  for (int m = 0; m < n; ++m)
    if (mirrors(m)) lines.push_back({m, along_axis(m)});
  return lines;
}

bool keeps(const Split& split, int line, int n) {
  const int corners[4] = {split.start, split.start + split.columns, split.start + n / 2,
                          split.start + n / 2 + split.columns};
  return std::ranges::all_of(corners, [&](int corner) {
    return std::ranges::any_of(corners,
                               [&](int other) { return (line - corner - other) % n == 0; });
  });
}

// Equal sizes are requested as far as the boundary edges are equal: the smallest time step of a round outline
// is then that of the disc mesh, and slender ends keep well-shaped elements.
double size_share(const std::vector<Point>& boundary) {
  double minimum = std::numeric_limits<double>::max(), maximum = 0;
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    const Point &a = boundary[i], &b = boundary[(i + 1) % boundary.size()];
    const double length = portable::hypot(b[0] - a[0], b[1] - a[1]);
    minimum = std::min(minimum, length);
    maximum = std::max(maximum, length);
  }
  return 0.6 * minimum / maximum;
}

// Corners of a core by their distances from node 0 along the outline: does not depend on the sense of the outline.
std::array<int, 4> places_of(const Split& split, int n) {
  std::array<int, 4> places{};
  const auto half = static_cast<std::size_t>(n / 2);
  for (int k = 0; k < 4; ++k) {
    const int corner = split.start + (k % 2) * split.columns + k / 2 * n / 2;
    entry(places, k) = std::min(static_cast<int>(wrapped(corner, 2 * half)),
                                static_cast<int>(wrapped(-corner, 2 * half)));
  }
  std::ranges::sort(places);
  return places;
}

class Search {
 public:
  Search(const std::vector<Point>& boundary, const Point& centre, int rings, int iterations)
      : boundary_(boundary),
        centre_(centre),
        rings_(rings),
        iterations_(iterations),
        share_(size_share(boundary)),
        lines_(mirror_lines(boundary, centre)) {}

  void look_at(const Split& split) {
    const int n = static_cast<int>(boundary_.size());
    if (split.columns < 1 || split.columns >= n / 2) return;
    const StarGrid grid = grid_of(boundary_, centre_, rings_, split);
    const double measure =
        rough_measure(grid.nodes, grid.quads, boundary_.size(), share_, iterations_);
    found_.push_back(worth_of(split, measure - 2));
  }

  // Round-off must not decide between splits that are as good because the outline is symmetric.
  Split best() const {
    constexpr double as_good = 1 + 1e-6;
    if (found_.empty()) return {0, 1};
    const int n = static_cast<int>(boundary_.size());
    const double least = std::ranges::min(found_, {}, &Found::score).score;
    const auto rank = [n](const Found& f) {
      return std::pair(!keeps(f.split, 0, n), places_of(f.split, n));
    };
    const Found* best = nullptr;
    for (const Found& found : found_)
      if (found.score <= as_good * least && (best == nullptr || rank(found) < rank(*best)))
        best = &found;
    return best->split;
  }

 private:
  struct Found {
    double score;
    Split split;
  };

  Found worth_of(const Split& split, double excess) const {
    // By number of mirror lines kept (a rectangular core has two, a square one four): factor on the measure's
    // excess over that of equal squares, compared with a grid without symmetry.
    constexpr std::array<double, 5> worth{1, 0.75, 0.65, 0.65, 0.6};
    constexpr double worth_of_an_axis = 0.95;
    std::size_t kept = 0;
    double factor = 1;
    for (const MirrorLine& line : lines_) {
      if (!keeps(split, line.sum, static_cast<int>(boundary_.size()))) continue;
      ++kept;
      if (line.along_axis) factor *= worth_of_an_axis;
    }
    return {excess * factor * worth[std::min<std::size_t>(kept, 4)], split};
  }

  const std::vector<Point>& boundary_;
  Point centre_;
  int rings_, iterations_;
  double share_;
  std::vector<MirrorLine> lines_;
  std::vector<Found> found_;
};

// On so few boundary nodes that all splits can be tried.
Split coarse_split(const std::vector<Point>& boundary, const Point& centre, int coarse) {
  std::vector<Point> nodes;
  for (int i = 0; i < coarse; ++i) {
    const double place = static_cast<double>(i) * static_cast<double>(boundary.size()) / coarse;
    const auto before = static_cast<std::size_t>(place);
    nodes.push_back(between(boundary[before], boundary[(before + 1) % boundary.size()],
                            place - static_cast<double>(before)));
  }
  Search search(nodes, centre, 1, 25);
  for (int columns = 1; columns < coarse / 2; ++columns)
    for (int start = 0; start < coarse / 2; ++start) search.look_at({start, columns});
  return search.best();
}

// The whole numbers at most `reach` from a place: the same ones in both senses of the outline, which rounded places
// are not.
std::pair<int, int> around(double place, double reach) {
  constexpr double round_off = 1e-9;
  return {static_cast<int>(std::ceil(place - reach - round_off)),
          static_cast<int>(std::floor(place + reach + round_off))};
}

Split best_split(const std::vector<Point>& boundary, const Point& centre, int rings) {
  constexpr int most_for_all = 24, most_for_many = 256;
  const int n = static_cast<int>(boundary.size());
  const int coarse = std::min(n, most_for_all);
  const Split rough = coarse_split(boundary, centre, coarse);
  if (n == coarse && rings == 1) return rough;
  const double more = static_cast<double>(n) / coarse;
  // The rough split is known to within half a coarse edge.
  const double reach = n <= most_for_many ? std::min(2.0, std::ceil(more / 2)) : 1.0;
  Search search(boundary, centre, rings, 40);
  const auto [first, last] = around(more * rough.start, reach);
  const auto [first_end, last_end] = around(more * (rough.start + rough.columns), reach);
  for (int start = first; start <= last; ++start)
    for (int end = first_end; end <= last_end; ++end)
      search.look_at({static_cast<int>(wrapped(start, boundary.size())), end - start});
  return search.best();
}

struct GridKey {
  std::vector<Point> boundary;
  Point centre;
  int rings;
  bool operator==(const GridKey&) const = default;
};

StarGrid smoothed_grid(const GridKey& key) {
  const auto& [boundary, centre, rings] = key;
  StarGrid grid = grid_of(boundary, centre, rings, best_split(boundary, centre, rings));
  smooth_mesh(grid.nodes, grid.quads, boundary.size(), size_share(boundary));
  return grid;
}

}  // namespace

StarGrid star_grid(const std::vector<Point>& boundary, const Point& centre, int rings) {
  // Checks, memory estimate, summary and layout of a scene all request the same grids.
  static ResultCache<GridKey, StarGrid> cache(1'000'000);  // nodes
  return cache.get({boundary, centre, rings}, smoothed_grid,
                   [](const StarGrid& grid) { return grid.nodes.size(); });
}

}  // namespace pulvis
