// local_density: volume of particles in every cell of a grid between the tools, in three dimensions.
//
// Source   systems/space/observe/cell_volume_kernel.hpp, room_kernel.hpp. The surface of a particle is that of its elements:
//          four triangles between the corners of a face and its centre, which give the volume of the bilinear face exactly.
//          The grid spans the current room, up to the mouth of a die; at a punch with a profile it reaches to the
//          deepest point. What has penetrated a round wall or such a punch is counted in its cell
// Runs     in sampled steps
// Active   if the scene asks for density cells
#include <limits>

#include "systems/contact/by_slot.hpp"
#include "systems/space/observe/room_kernel.hpp"
#include "systems/space/observe/systems.hpp"

namespace pulvis::space {
namespace {

using kernels::Grid;

struct VolumeInCell {
  std::size_t cell;
  double volume;
};

// How far a face protrudes into the room, and how far it recedes: 0 if it is flat.
std::array<double, 2> reach_of(const DensityGrid::Profile& face) {
  std::array<double, 2> ends{0, 0};
  for (const auto& [radius, height] : face) {
    ends[0] = std::min(ends[0], height);
    ends[1] = std::max(ends[1], height);
  }
  return ends;
}

struct DensityLook {
  const local_density& s;

  double at(int tool, std::size_t k) const {
    return s.tool_position(Row<Tool>(tool), static_cast<int>(k));
  }
  std::size_t axis() const {
    const DieRoom::Vector& along = s.grid->between.axis;
    return along[2] != 0 ? 2 : along[1] != 0 ? 1 : 0;
  }
  // Ends of the room along its axis, from low to high, as indices of their faces.
  std::array<int, 2> ends() const {
    const DieRoom& room = s.grid->between;
    const bool up = room.axis[axis()] > 0;
    return {room.tool[up ? DieRoom::bottom : DieRoom::top],
            room.tool[up ? DieRoom::top : DieRoom::bottom]};
  }
  const DensityGrid::Profile& face(int end) const {
    const bool up = s.grid->between.axis[axis()] > 0;
    return entry(s.grid->bottom_top, up ? end : 1 - end);
  }

  void find_ends() const {
    DensityGrid& grid = *s.grid;
    const DieRoom& room = grid.between;
    if (room.kind == DieRoom::Kind::box) {
      for (std::size_t k = 0; k < 3; ++k) {
        grid.low[k] = at(room.tool[2 * k], k);
        grid.high[k] = at(room.tool[2 * k + 1], k);
      }
      return;
    }
    const std::size_t along = axis();
    for (std::size_t k = 0; k < 3; ++k) {
      grid.low[k] = at(room.die, k) - room.diameter / 2;
      grid.high[k] = at(room.die, k) + room.diameter / 2;
    }
    grid.low[along] = at(ends()[0], along) + reach_of(face(0))[0];
    grid.high[along] = at(ends()[1], along) - reach_of(face(1))[0];
    if (room.mouth) cut_at_mouth(along);
  }
  void cut_at_mouth(std::size_t along) const {
    DensityGrid& grid = *s.grid;
    const DieRoom& room = grid.between;
    const double mouth = at(room.die, along) + room.axis[along] * *room.mouth;
    if (room.axis[along] > 0)
      grid.high[along] = std::clamp(mouth, grid.low[along], grid.high[along]);
    else
      grid.low[along] = std::clamp(mouth, grid.low[along], grid.high[along]);
  }
  // Beyond the mouth of the die there is no room.
  bool is_empty() const {
    const DensityGrid& grid = *s.grid;
    for (std::size_t k = 0; k < 3; ++k)
      if (!(grid.low[k] < grid.high[k])) return true;
    return false;
  }

  Grid lines() const {
    Grid lines;
    for (std::size_t k = 0; k < 3; ++k)
      lines[k] = {s.grid->low[k], (s.grid->high[k] - s.grid->low[k]) / s.grid->cells[k],
                  s.grid->cells[k]};
    return lines;
  }

  kernels::RoundRoom round_room() const {
    const DieRoom& room = s.grid->between;
    const std::size_t a = axis();
    return {room.diameter / 2,
            a,
            {at(room.die, (a + 1) % 3), at(room.die, (a + 2) % 3)},
            at(ends()[0], a),
            at(ends()[1], a),
            face(0),
            face(1)};
  }
  void find_room(const Grid& lines) const {
    std::vector<double>& room = s.grid->room;
    const bool box = s.grid->between.kind == DieRoom::Kind::box;
    const double whole = lines[0].cell * lines[1].cell * lines[2].cell;
    room.assign(s.grid->filled.size(), whole);
    if (box) return;
    const kernels::RoundRoom round = round_room();
    std::size_t cell = 0;
    for (int k = 0; k < lines[2].count; ++k)
      for (int j = 0; j < lines[1].count; ++j)
        for (int i = 0; i < lines[0].count; ++i)
          room[cell++] = round.in_cell({{{lines[0].line(i), lines[0].line(i + 1)},
                                         {lines[1].line(j), lines[1].line(j + 1)},
                                         {lines[2].line(k), lines[2].line(k + 1)}}});
  }

  void find_volumes(const Grid& lines, int slot, std::vector<VolumeInCell>& found) const {
    const Shape& shape = s.bodies.shape_of(slot);
    const auto x = s.position.chunk(Chunk{slot / lane_count});
    const auto node = [&](int n) {
      const Row<Node> row(n);
      const int lane = slot % lane_count;
      return Point{x(row, 0)[lane], x(row, 1)[lane], x(row, 2)[lane]};
    };
    Point low, high;
    low.fill(std::numeric_limits<double>::max());
    high.fill(std::numeric_limits<double>::lowest());
    for (int n = 0; n < shape.boundary_nodes; ++n)
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], node(n)[k]);
        high[k] = std::max(high[k], node(n)[k]);
      }
    kernels::CellVolumes volumes(lines, low, high);
    for (const Shape::Face& face : shape.faces) {
      std::array<Point, 4> corner;
      Point middle{};
      for (std::size_t c = 0; c < 4; ++c) {
        corner[c] = node(face.corner[c].value);
        for (std::size_t k = 0; k < 3; ++k) middle[k] += 0.25 * corner[c][k];
      }
      for (std::size_t c = 0; c < 4; ++c) volumes.add(corner[c], corner[(c + 1) % 4], middle);
    }
    volumes.finish([&](std::size_t cell, double volume) { found.push_back({cell, volume}); });
  }
};

}  // namespace

void local_density::operator()() const {
  const DensityLook look{*this};
  look.find_ends();
  grid->filled.assign(static_cast<std::size_t>(grid->cells[0]) *
                          static_cast<std::size_t>(grid->cells[1]) *
                          static_cast<std::size_t>(grid->cells[2]),
                      0);
  grid->room.assign(grid->filled.size(), 0);
  if (look.is_empty()) return;
  const Grid lines = look.lines();
  look.find_room(lines);
  const auto found =
      list_by_slot<VolumeInCell>(bodies.slots(), [&](int slot, std::vector<VolumeInCell>& of_slot) {
        if (bodies.bodies->owns(slot)) look.find_volumes(lines, slot, of_slot);
      });
  for (const int slot : bodies.bodies->slot_of_number)
    for (const VolumeInCell& part : found.of(slot)) grid->filled[part.cell] += part.volume;
}

}  // namespace pulvis::space
