// local_density: particle area and tool area in every cell of a grid between the tools.
//
// Source   systems/observe/cell_area_kernel.hpp. The outlines are the polygons of the boundary nodes, whose area
//          equals that of the particle. The grid spans the actual tool surfaces at that time; on a polyline
//          side it reaches to the deepest point of its face, and the area filled by the tool is removed. Beyond
//          the end of a face (the mouth of a die) there is no grid, and no area in it once the punches are there
// Runs     on sampled steps
// Active   when the scene requests density cells
#include <algorithm>
#include <limits>

#include "engine/entry.hpp"
#include "engine/portable_math.hpp"
#include "systems/observe/cell_area_kernel.hpp"
#include "systems/observe/systems.hpp"

namespace pulvis {
namespace {

using Side = DensityGrid::Side;

bool along_x(int side) { return side == Side::left || side == Side::right; }
double outward(int side) { return side == Side::left || side == Side::bottom ? -1 : 1; }
constexpr double endless = std::numeric_limits<double>::infinity();

std::size_t across(int side) { return along_x(side) ? 1 : 0; }

Point beyond(const Point& end, const Point& inner, double far) {
  const double dx = end[0] - inner[0], dy = end[1] - inner[1], length = portable::hypot(dx, dy);
  return {end[0] + far * dx / length, end[1] + far * dy / length};
}

// The chain of a polyline tool at its current position, with straight ends extended by `far`.
std::vector<Point> chain_of(const std::vector<Point>& surface, Point tool, double far) {
  std::vector<Point> chain{{}};
  for (const Point& p : surface) chain.push_back({tool[0] + p[0], tool[1] + p[1]});
  chain.front() = beyond(chain[1], chain[2], far);
  chain.push_back(beyond(chain[chain.size() - 1], chain[chain.size() - 2], far));
  return chain;
}

// The part of a polyline tool that faces the powder: without the ends of its chain that turn aside, like the
// land around the mouth of a die. An end that faces the powder extends without end.
struct Face {
  std::vector<Point> chain;
  double farthest = 0;                    // m: outermost of the points of the tool's own surface
  double low = -endless, high = endless;  // m: its extent along its side
};

struct FaceRange {
  std::size_t first, last;     // points of the surface
  bool open_first, open_last;  // extends beyond them
};

FaceRange face_range(const std::vector<Point>& surface, int side) {
  const std::size_t along = across(side), out = 1 - along;
  const auto looks_in = [&](std::size_t i) {
    const Point &a = surface[i], &b = surface[i + 1];
    return std::abs(b[along] - a[along]) >= std::abs(b[out] - a[out]);
  };
  std::size_t first = 0, last = surface.size() - 1;
  while (first + 1 < last && !looks_in(first)) ++first;
  while (last > first + 1 && !looks_in(last - 1)) --last;
  return {first, last, first == 0 && looks_in(first),
          last + 1 == surface.size() && looks_in(last - 1)};
}

Face face_of(const std::vector<Point>& surface, int side, Point tool, double far) {
  const std::size_t along = across(side), out = 1 - along;
  const FaceRange range = face_range(surface, side);
  std::vector<Point> chain = chain_of(surface, tool, far);  // one more point at both ends
  chain.erase(chain.begin() + static_cast<std::ptrdiff_t>(range.last + (range.open_last ? 3 : 2)),
              chain.end());
  chain.erase(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(
                                                 range.first + (range.open_first ? 0 : 1)));
  Face face{std::move(chain), tool[out] + surface[range.first][out]};
  double low = endless, high = -endless;
  for (std::size_t i = range.first; i <= range.last; ++i) {
    const Point p{tool[0] + surface[i][0], tool[1] + surface[i][1]};
    if (outward(side) * (p[out] - face.farthest) > 0) face.farthest = p[out];
    low = std::min(low, p[along]);
    high = std::max(high, p[along]);
  }
  const bool rising = surface[range.last][along] > surface[range.first][along];
  if (!(rising ? range.open_first : range.open_last)) face.low = low;
  if (!(rising ? range.open_last : range.open_first)) face.high = high;
  return face;
}

// Outermost position that the chain of `side` reaches between `low` and `high` of the other axis.
double farthest(const std::vector<Point>& chain, int side, double low, double high) {
  const std::size_t along = across(side), out = 1 - along;
  double maximum = -endless;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const Point &a = chain[i], &b = chain[i + 1];
    const double from = std::min(a[along], b[along]), to = std::max(a[along], b[along]);
    if (to < low || from > high) continue;
    for (const double at : {std::max(from, low), std::min(to, high)}) {
      const double share = to > from ? (at - a[along]) / (b[along] - a[along]) : 0;
      maximum = std::max(maximum, outward(side) * (a[out] + share * (b[out] - a[out])));
    }
  }
  return outward(side) * maximum;
}

class Grid {
 public:
  Grid(DensityGrid& grid, const Read<ToolPosition>& position) : grid_(grid) {
    Point low{endless, endless}, high{-endless, -endless};
    for (int s = 0; s < 4; ++s) {
      const Row<Tool> tool(entry(grid.tool, s));
      entry(tool_, s) = {position(tool, 0), position(tool, 1)};
      const auto reach = [&](double x, double y) {
        low = {std::min(low[0], x), std::min(low[1], y)};
        high = {std::max(high[0], x), std::max(high[1], y)};
      };
      reach(entry(tool_, s)[0], entry(tool_, s)[1]);
      for (const Point& p : entry(grid.surface, s))
        reach(entry(tool_, s)[0] + p[0], entry(tool_, s)[1] + p[1]);
    }
    far_ = 4 * (high[0] - low[0] + high[1] - low[1]);
    set_sides();
    cell_ = {(grid.side[Side::right] - grid.side[Side::left]) / grid.columns,
             (grid.side[Side::top] - grid.side[Side::bottom]) / grid.rows};
    over_ = {1 / cell_[0], 1 / cell_[1]};
  }

  // Nothing is left of the die between its punches: they are beyond its mouth.
  bool empty() const { return !(cell_[0] > 0 && cell_[1] > 0); }
  double cell_area() const { return cell_[0] * cell_[1]; }

  void add_edge(kernels::CellAreas& areas, const Point& a, const Point& b, double weight) const {
    const double x0 = grid_.side[Side::left], y0 = grid_.side[Side::bottom];
    areas.add_edge((a[0] - x0) * over_[0], (a[1] - y0) * over_[1], (b[0] - x0) * over_[0],
                   (b[1] - y0) * over_[1], weight);
  }

  // The body of a polyline tool, to the right of its chain: closed far outside the grid.
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
  bool is_plane(int side) const { return entry(grid_.surface, side).empty(); }

  // Limited to the planes and faces: the grid has no side where the tools beside it have ended.
  void set_sides() {
    std::array<Face, 4> face;
    for (int s = 0; s < 4; ++s) {
      const std::size_t out = 1 - across(s);
      entry(grid_.side, s) = entry(tool_, s)[out];
      if (is_plane(s)) continue;
      entry(face, s) = face_of(entry(grid_.surface, s), s, entry(tool_, s), far_);
      entry(grid_.side, s) = entry(face, s).farthest;
    }
    stay_beside(face);
    const std::array<double, 4> rough = grid_.side;
    for (int s = 0; s < 4; ++s) {
      if (is_plane(s)) continue;
      const std::size_t low = along_x(s) ? Side::bottom : Side::left;
      entry(grid_.side, s) = farthest(entry(face, s).chain, s, rough[low], rough[low + 1]);
    }
    stay_beside(face);
  }
  void stay_beside(const std::array<Face, 4>& face) {
    for (int s = 0; s < 4; ++s) {
      const std::size_t beside = along_x(s) ? Side::bottom : Side::left;
      for (const std::size_t b : {beside, beside + 1})
        entry(grid_.side, s) = std::clamp(entry(grid_.side, s), face[b].low, face[b].high);
    }
    for (const Side low : {Side::left, Side::bottom})
      grid_.side[low + 1] = std::max(grid_.side[low], grid_.side[low + 1]);
  }
  std::vector<Point> chain(int side) const {
    return chain_of(entry(grid_.surface, side), entry(tool_, side), far_);
  }

  DensityGrid& grid_;
  std::array<Point, 4> tool_{};
  Point cell_{}, over_{};  // m, 1/m
  double far_ = 0;
};

}  // namespace

void local_density::operator()() const {
  const Grid frame(*grid, tool_position);
  if (frame.empty()) {
    for (auto* areas : {&grid->filled, &grid->room})
      areas->assign(static_cast<std::size_t>(grid->columns * grid->rows), 0);
    return;
  }
  kernels::CellAreas particles(grid->columns, grid->rows), tools(grid->columns, grid->rows);
  for (const int slot : bodies->slot_of_number) {  // sequential: always bitwise identical
    const auto x = position.chunk(Chunk{slot / lane_count});
    const int lane = slot % lane_count, shape = entry(bodies->slots, slot).shape;
    for (const auto& [a, b] : entry(grid->outline, shape))
      frame.add_edge(particles, {x(a, 0)[lane], x(a, 1)[lane]}, {x(b, 0)[lane], x(b, 1)[lane]}, 1);
  }
  for (int side = 0; side < 4; ++side)
    if (!entry(grid->surface, side).empty()) frame.add_tool(tools, side);
  grid->filled = particles.areas();
  grid->room = tools.areas();
  for (double& area : grid->filled) area = std::max(0.0, area) * frame.cell_area();  // round-off
  for (double& area : grid->room) area = std::max(0.0, 1 - area) * frame.cell_area();
}

}  // namespace pulvis
