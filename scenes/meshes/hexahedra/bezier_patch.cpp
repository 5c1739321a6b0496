#include "scenes/meshes/hexahedra/bezier_patch.hpp"

#include "systems/contact/contact_kernel.hpp"

namespace pulvis::space {
namespace {

using Four = std::array<double, 4>;

Four bernstein(double u) {
  const double w = 1 - u;
  return {w * w * w, 3 * u * w * w, 3 * u * u * w, u * u * u};
}
Four bernstein_slope(double u) {
  const double w = 1 - u;
  return {-3 * w * w, 3 * w * (w - 2 * u), 3 * u * (2 * w - u), 3 * u * u};
}

}  // namespace

PatchPlace gauss_place(int point) {
  const int i = point % 4, j = point / 4;
  return {entry(kernels::edge_u, i), entry(kernels::edge_u, j),
          entry(kernels::edge_w, i) * entry(kernels::edge_w, j)};
}

PatchWeights patch_weights(double u, double v) {
  const Four in_u = bernstein(u), in_v = bernstein(v);
  const Four by_u = bernstein_slope(u), by_v = bernstein_slope(v);
  PatchWeights weights;
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i)
      weights[4 * j + i] = {in_u[i] * in_v[j], by_u[i] * in_v[j], in_u[i] * by_v[j]};
  return weights;
}

PatchPoint patch_at(const std::array<int, 16>& numbers, const std::vector<Vec3>& points,
                    const PatchWeights& weights) {
  PatchPoint place{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const Vec3& p = entry(points, numbers[k]);
    place.at += weights[k].at * p;
    place.by_u += weights[k].by_u * p;
    place.by_v += weights[k].by_v * p;
  }
  return place;
}

PatchPoint patch_at(const std::array<int, 16>& numbers, const std::vector<Vec3>& points, double u,
                    double v) {
  return patch_at(numbers, points, patch_weights(u, v));
}

double volume_under(const std::array<int, 16>& numbers, const std::vector<Vec3>& points) {
  static const auto at_gauss_points = [] {
    std::array<PatchWeights, Shape::gauss_points> all;
    for (int g = 0; g < Shape::gauss_points; ++g)
      entry(all, g) = patch_weights(gauss_place(g).u, gauss_place(g).v);
    return all;
  }();
  double volume = 0;
  for (int g = 0; g < Shape::gauss_points; ++g) {
    const PatchPoint on = patch_at(numbers, points, entry(at_gauss_points, g));
    volume += gauss_place(g).weight * on.at.dot(on.area()) / 3;
  }
  return volume;
}

std::vector<Vec3> surface_points_of(const Shape& shape, const std::vector<Point>& nodes) {
  std::vector<Vec3> at;
  for (const Point& x : nodes) at.push_back({x[0], x[1], x[2]});
  for (const Shape::Terms* terms : {&shape.net, &shape.points}) {
    std::vector<Vec3> points;
    for (int i = 0; i < terms->points(); ++i) {
      Vec3& sum = points.emplace_back(Vec3::Zero());
      for (const Shape::Term& term : terms->of(i)) sum += term.weight * entry(at, term.row.value);
    }
    at = std::move(points);
  }
  return at;
}

}  // namespace pulvis::space
