// local_density: how much of every cell of a grid between the tools is particle, and how much is tool.
//
// Source   systems/cell_area_kernel.hpp. The outlines are the polygons of the boundary nodes, whose area
//          is that of the particle. The grid spans the tools' true surfaces at that time; where a side is a
//          polyline it reaches to the deepest point of its surface, and the cells lose what the tool fills
// Runs     on sampled steps
// Active   when the scene asks for density cells
#include <limits>

#include "engine/portable_math.hpp"
#include "systems/cell_area_kernel.hpp"
#include "systems/systems.hpp"

namespace pulvis {
namespace {

using Side = DensityGrid::Side;

bool along_x(int side) { return side == Side::left || side == Side::right; }
double outward(int side) { return side == Side::left || side == Side::bottom ? -1 : 1; }

// The chain of a polyline tool where it stands, with straight ends that go on for `far`.
std::vector<Point> chain_of(const std::vector<Point>& surface, Point tool, double far) {
  std::vector<Point> chain{{}};
  for (const Point& p : surface) chain.push_back({tool[0] + p[0], tool[1] + p[1]});
  const auto beyond = [far](const Point& end, const Point& inner) {
    const double dx = end[0] - inner[0], dy = end[1] - inner[1], length = portable::hypot(dx, dy);
    return Point{end[0] + far * dx / length, end[1] + far * dy / length};
  };
  chain.front() = beyond(chain[1], chain[2]);
  chain.push_back(beyond(chain[chain.size() - 1], chain[chain.size() - 2]));
  return chain;
}

// Farthest outwards that the chain of `side` comes between `low` and `high` of the other axis.
double farthest(const std::vector<Point>& chain, int side, double low, double high) {
  const std::size_t out = along_x(side) ? 0 : 1, across = 1 - out;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const Point &a = chain[i], &b = chain[i + 1];
    const double from = std::min(a[across], b[across]), to = std::max(a[across], b[across]);
    if (to < low || from > high) continue;
    for (const double at : {std::max(from, low), std::min(to, high)}) {
      const double share = to > from ? (at - a[across]) / (b[across] - a[across]) : 0;
      most = std::max(most, outward(side) * (a[out] + share * (b[out] - a[out])));
    }
  }
  return outward(side) * most;
}

class Grid {
 public:
  Grid(DensityGrid& grid, const Read<ToolPosition>& position) : grid_(grid) {
    for (int s = 0; s < 4; ++s) {
      const Row<Tool> tool(grid.tool[at(s)]);
      tool_[at(s)] = {position(tool, 0), position(tool, 1)};
      grid.side[at(s)] = tool_[at(s)][along_x(s) ? 0 : 1];
      for (const Point& p : grid.surface[at(s)]) {
        const double there = tool_[at(s)][along_x(s) ? 0 : 1] + p[along_x(s) ? 0 : 1];
        if (outward(s) * (there - grid.side[at(s)]) > 0) grid.side[at(s)] = there;
      }
    }
    const std::array<double, 4> rough = grid.side;
    far_ = 4 * (std::abs(rough[1] - rough[0]) + std::abs(rough[3] - rough[2]));
    for (int s = 0; s < 4; ++s) {
      if (grid.surface[at(s)].empty()) continue;
      const std::size_t low = along_x(s) ? Side::bottom : Side::left;
      grid.side[at(s)] = farthest(chain(s), s, rough[low], rough[low + 1]);
    }
    cell_ = {(grid.side[Side::right] - grid.side[Side::left]) / grid.columns,
             (grid.side[Side::top] - grid.side[Side::bottom]) / grid.rows};
    over_ = {1 / cell_[0], 1 / cell_[1]};
  }

  double cell_area() const { return cell_[0] * cell_[1]; }

  void add_edge(kernels::CellAreas& areas, const Point& a, const Point& b, double weight) const {
    const double x0 = grid_.side[Side::left], y0 = grid_.side[Side::bottom];
    areas.add_edge((a[0] - x0) * over_[0], (a[1] - y0) * over_[1], (b[0] - x0) * over_[0],
                   (b[1] - y0) * over_[1], weight);
  }

  // The body of a polyline tool, to the right of its chain: closed far outside of the grid.
  void add_tool(kernels::CellAreas& areas, int side) const {
    std::vector<Point> body = chain(side);
    Point begin = body.front(), end = body.back();
    end[along_x(side) ? 0 : 1] += outward(side) * 4 * far_;
    begin[along_x(side) ? 0 : 1] += outward(side) * 4 * far_;
    body.push_back(end);
    body.push_back(begin);
    for (std::size_t i = 0; i < body.size(); ++i)
      add_edge(areas, body[i], body[(i + 1) % body.size()], -1);
  }

 private:
  static std::size_t at(int side) { return static_cast<std::size_t>(side); }
  std::vector<Point> chain(int side) const {
    return chain_of(grid_.surface[at(side)], tool_[at(side)], far_);
  }

  DensityGrid& grid_;
  std::array<Point, 4> tool_{};
  Point cell_{}, over_{};  // m, 1/m
  double far_ = 0;
};

}  // namespace

void local_density(Read<Bodies> bodies, Read<Position> position, Read<ToolPosition> tool_position,
                   Write<DensityGrid> grid) {
  const Grid frame(*grid, tool_position);
  kernels::CellAreas particles(grid->columns, grid->rows), tools(grid->columns, grid->rows);
  for (const int slot : bodies->slot_of_number) {  // one after the other: the same bits always
    const auto x = position.chunk(Chunk{slot / lane_count});
    const int lane = slot % lane_count, shape = bodies->slots[static_cast<std::size_t>(slot)].shape;
    for (const auto& [a, b] : grid->outline[static_cast<std::size_t>(shape)])
      frame.add_edge(particles, {x(a, 0)[lane], x(a, 1)[lane]}, {x(b, 0)[lane], x(b, 1)[lane]}, 1);
  }
  for (int side = 0; side < 4; ++side)
    if (!grid->surface[static_cast<std::size_t>(side)].empty()) frame.add_tool(tools, side);
  grid->filled = particles.areas();
  grid->room = tools.areas();
  for (double& area : grid->filled) area *= frame.cell_area();
  for (double& area : grid->room) area = std::max(0.0, 1 - area) * frame.cell_area();
}

}  // namespace pulvis
