#include "scenes/space/meshes/bezier_patch.hpp"

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

PatchPoint patch_at(const std::array<int, 16>& numbers, const std::vector<Vec3>& points, double u,
                    double v) {
  const Four in_u = bernstein(u), in_v = bernstein(v);
  const Four by_u = bernstein_slope(u), by_v = bernstein_slope(v);
  PatchPoint place{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3& p = entry(points, numbers[4 * j + i]);
      place.at += in_u[i] * in_v[j] * p;
      place.by_u += by_u[i] * in_v[j] * p;
      place.by_v += in_u[i] * by_v[j] * p;
    }
  return place;
}

double volume_under(const std::array<int, 16>& numbers, const std::vector<Vec3>& points) {
  double volume = 0;
  for (int g = 0; g < Shape::gauss_points; ++g) {
    const PatchPlace place = gauss_place(g);
    const PatchPoint on = patch_at(numbers, points, place.u, place.v);
    volume += place.weight * on.at.dot(on.area()) / 3;
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
