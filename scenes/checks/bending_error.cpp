#include "scenes/checks/bending_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pulvis {
namespace {

constexpr double min_slenderness = 3;  // squat bodies hardly bend
constexpr double max_error = 0.1;      // larger errors are reported
constexpr double good_error = 0.02;

struct Rows {
  int across = 0;
  double aspect = 0;  // -, element length along the body over its height
};

std::optional<Rows> rows_of(const ParticleSpec& particle) {
  if (particle.grains) return std::nullopt;
  if (const auto* bar = std::get_if<RectangleOutline>(&particle.outline)) {
    const auto& mesh = std::get<RectangleMesh>(particle.mesh);
    const double length = std::max(bar->width, bar->height);
    const double height = std::min(bar->width, bar->height);
    if (length < min_slenderness * height) return std::nullopt;
    const bool upright = bar->height > bar->width;
    const int along = upright ? mesh.rows : mesh.columns;
    const int across = upright ? mesh.columns : mesh.rows;
    return Rows{across, length / along / (height / across)};
  }
  if (const auto* ring = std::get_if<RingOutline>(&particle.outline)) {
    const auto& mesh = std::get<RingMesh>(particle.mesh);
    const double along = std::numbers::pi * (ring->diameter + ring->hole) / 2 / mesh.boundary_edges;
    return Rows{mesh.rings, along / ((ring->diameter - ring->hole) / 2 / mesh.rings)};
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> bending_error(const Scene& scene, const ParticleSpec& particle) {
  const auto rows = rows_of(particle);
  if (!rows) return std::nullopt;
  const double nu = scene.materials[static_cast<std::size_t>(particle.material)].poissons_ratio;
  return with_formulation(scene.element.formulation, [&]<class F>(F) {
    if (F::stabilised) return 0.0;
    const double shear = rows->aspect * rows->aspect * (1 - nu) / 2;
    const double stretch =
        F::volumes == 1 ? 2.0 / 3 * (1 - nu) : (1 - nu) * (1 - nu) / (1 - 2 * nu);
    return (stretch - 1 + shear) / (rows->across * rows->across);
  });
}

std::vector<std::string> bending_warnings(const Scene& scene) {
  std::vector<std::string> lines;
  for (const ParticleSpec& particle : scene.particles) {
    const double error = bending_error(scene, particle).value_or(0);
    if (std::abs(error) <= max_error) continue;
    lines.push_back(fmt::format(
        "the bending stiffness of the elements of particle '{}' is wrong by {:+.0f}%: use "
        "element.formulation = \"one-point\", which is accurate with any number of rows, or {:.0f} "
        "times as many elements in both directions",
        particle.name, 100 * error, std::ceil(std::sqrt(std::abs(error) / good_error))));
  }
  return lines;
}

}  // namespace pulvis
