#include "scenes/meshes/hexahedra/true_volume.hpp"

#include <algorithm>
#include <cmath>

#include "engine/portable_math.hpp"
#include "scenes/meshes/hexahedra/bezier_patch.hpp"

namespace pulvis::space {
namespace {

using Quads = std::vector<std::array<int, 4>>;

constexpr double most_shift =
    1.0 / 6;  // of the edges at a node: more would turn sharp bends into spikes

struct BilinearPlace {
  Vec3 at, area;
};
BilinearPlace bilinear(const std::vector<Vec3>& nodes, const std::array<int, 4>& quad, double u,
                       double v) {
  const Vec3 &a = entry(nodes, quad[0]), &b = entry(nodes, quad[1]), &c = entry(nodes, quad[2]),
             &d = entry(nodes, quad[3]);
  const Vec3 by_u = (1 - v) * (b - a) + v * (c - d), by_v = (1 - u) * (d - a) + u * (c - b);
  return {(1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * d + u * c), by_u.cross(by_v)};
}

// For a quad: its area, and the volume between it and the true surface beyond, within the rays through its sides.
struct Cut {
  double area = 0, volume = 0;
};
Cut cut_of(const std::vector<Vec3>& nodes, const std::array<int, 4>& quad,
           const StarSurface& surface) {
  Cut cut;
  for (int g = 0; g < Shape::gauss_points; ++g) {
    const PatchPlace place = gauss_place(g);
    const BilinearPlace on = bilinear(nodes, quad, place.u, place.v);
    const double far = surface.radius(on.at.normalized()) / on.at.norm();
    cut.area += place.weight * on.area.norm();
    cut.volume += place.weight * (far * far * far - 1) * on.at.dot(on.area) / 3;
  }
  return cut;
}

// Mean distance by which the neighbours of each node lie behind its tangent plane.
std::vector<double> bends(const std::vector<Vec3>& nodes, const Quads& quads,
                          const std::vector<Vec3>& normals) {
  std::vector<double> bend(nodes.size()), sides(nodes.size());
  for (const auto& quad : quads)
    for (std::size_t k = 0; k < 4; ++k)
      for (const std::size_t beside : {k + 1, k + 3}) {
        const int i = quad[k];
        entry(bend, i) += (entry(nodes, i) - entry(nodes, quad[beside % 4])).dot(entry(normals, i));
        entry(sides, i) += 1;
      }
  for (std::size_t i = 0; i < nodes.size(); ++i) bend[i] = std::abs(bend[i]) / sides[i];
  return bend;
}

// The volume that a quad cuts off is restored by its nodes in proportion to the local bend: flats stay flat.
std::vector<double> shifts(const std::vector<Vec3>& nodes, const Quads& quads,
                           const std::vector<Vec3>& normals, const StarSurface& surface) {
  const std::vector<double> bend = bends(nodes, quads, normals);
  std::vector<double> volume(nodes.size()), area(nodes.size());
  for (const auto& quad : quads) {
    const Cut cut = cut_of(nodes, quad, surface);
    double sum = 0;
    for (const int i : quad) sum += entry(bend, i);
    for (const int i : quad) {
      entry(volume, i) += sum > 0 ? cut.volume * entry(bend, i) / sum : cut.volume / 4;
      entry(area, i) += cut.area / 4;
    }
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) volume[i] /= area[i];
  return volume;
}

// The mean length of the edges at each node.
std::vector<double> edge_lengths(const std::vector<Vec3>& nodes, const Quads& quads) {
  std::vector<double> length(nodes.size()), sides(nodes.size());
  for (const auto& quad : quads)
    for (std::size_t k = 0; k < 4; ++k)
      for (const std::size_t beside : {k + 1, k + 3}) {
        entry(length, quad[k]) += (entry(nodes, quad[beside % 4]) - entry(nodes, quad[k])).norm();
        entry(sides, quad[k]) += 1;
      }
  for (std::size_t i = 0; i < nodes.size(); ++i) length[i] /= sides[i];
  return length;
}

}  // namespace

double volume_inside(const std::vector<Vec3>& nodes, const Quads& quads) {
  double volume = 0;
  for (const auto& quad : quads)
    for (int g = 0; g < Shape::gauss_points; ++g) {
      const PatchPlace place = gauss_place(g);
      const BilinearPlace on = bilinear(nodes, quad, place.u, place.v);
      volume += place.weight * on.at.dot(on.area) / 3;
    }
  return volume;
}

void make_volume_true(std::vector<Vec3>& nodes, const Quads& quads, const StarSurface& surface) {
  std::vector<Vec3> normal;
  for (const Vec3& node : nodes) normal.push_back(surface.normal(node.normalized()));
  std::vector<double> shift = shifts(nodes, quads, normal, surface);
  const auto moved = [&](double factor) {
    std::vector<Vec3> to = nodes;
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * shift[i] * normal[i];
    return to;
  };
  const double wanted = surface.volume(), before = volume_inside(nodes, quads);
  double factor = 1, missing = wanted - before, last = 0;
  for (int i = 0; i < 4 && std::abs(missing) > 1e-14 * wanted; ++i) {  // secant
    const double now = wanted - volume_inside(moved(factor), quads);
    if (now == missing) break;
    const double next = factor - now * (factor - last) / (now - missing);
    last = factor;
    missing = now;
    factor = next;
  }
  const std::vector<double> length = edge_lengths(nodes, quads);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    shift[i] = std::clamp(factor * shift[i], -most_shift * length[i], most_shift * length[i]);
  nodes = moved(1);
  const double scale = portable::cbrt(wanted / volume_inside(nodes, quads));
  for (Vec3& node : nodes) node *= scale;
}

}  // namespace pulvis::space
