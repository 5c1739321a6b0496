#include "scenes/meshes/hexahedra/directions.hpp"

#include <cmath>
#include <numbers>

#include "engine/portable_math.hpp"

namespace pulvis::space {
namespace {

struct AngleStation {
  double tangent, weight;
};
std::vector<AngleStation> angle_stations(int cells) {
  std::vector<AngleStation> stations;
  const double cell = std::numbers::pi / 2 / cells;
  for (int i = 0; i < cells; ++i)
    for (const double side : {-1.0, 1.0}) {
      const double angle = cell * (i + 0.5 + side * 0.5 / std::sqrt(3.0)) - std::numbers::pi / 4;
      stations.push_back({portable::tan(angle), cell / 2});
    }
  return stations;
}

}  // namespace

std::vector<Direction> directions(int cells) {
  std::vector<Direction> all;
  const std::vector<AngleStation> stations = angle_stations(cells);
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0})
      for (const AngleStation& a : stations)
        for (const AngleStation& b : stations) {
          Vec3 d;
          d[axis] = sign;
          d[(axis + 1) % 3] = a.tangent;
          d[(axis + 2) % 3] = b.tangent;
          const double square = d.squaredNorm();
          // For a plane at distance 1: dx dy / r^3, and dx = (1 + x^2) d(angle).
          const double solid = (1 + a.tangent * a.tangent) * (1 + b.tangent * b.tangent) /
                               (square * std::sqrt(square));
          all.push_back({d / std::sqrt(square), solid * a.weight * b.weight});
        }
  return all;
}

double volume_about(const StarSurface& surface, int cells) {
  double volume = 0;
  for (const Direction& d : directions(cells)) {
    const double r = surface.radius(d.unit);
    volume += d.weight * r * r * r / 3;
  }
  return volume;
}

Vec3 centre_of_volume(const StarSurface& surface, int cells) {
  Vec3 moment = Vec3::Zero();
  double volume = 0;
  for (const Direction& d : directions(cells)) {
    const double r = surface.radius(d.unit), cube = d.weight * r * r * r;
    moment += cube * r / 4 * d.unit;
    volume += cube / 3;
  }
  return moment / volume;
}

}  // namespace pulvis::space
