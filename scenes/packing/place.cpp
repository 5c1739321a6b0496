#include "scenes/packing/place.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/portable_math.hpp"
#include "scenes/outlines/portable.hpp"
#include "scenes/packing/in_file_order.hpp"

namespace pulvis {
namespace {

// Uniform in a circle of radius 1.
Vec2 in_circle(portable::Random& random) {
  const double radius = std::sqrt(random.uniform());
  const double angle = random.between(0, 2 * std::numbers::pi);
  return radius * Vec2(portable::cos(angle), portable::sin(angle));
}

void add_packing(const PackingSpec& packing, std::uint64_t seed, std::vector<BodySpec>& bodies) {
  if (!is_lattice(packing)) {
    bodies.insert(bodies.end(), packing.placed.begin(), packing.placed.end());
    return;
  }
  const bool hexagonal = packing.kind == PackingSpec::Kind::hexagonal;
  const double rise = hexagonal ? std::numbers::sqrt3 / 2 : 1;
  portable::Random random(seed);
  for (int row = 0; row < packing.rows; ++row) {
    const int fewer = packing.columns - particles_in_row(packing, row);
    for (int column = 0; column < packing.columns - fewer; ++column) {
      BodySpec body;
      body.particle = packing.particle;
      Vec2 at =
          packing.corner + packing.spacing * Vec2(column + 0.5 + 0.5 * fewer, rise * row + 0.5);
      if (packing.perturbation > 0)
        at += packing.perturbation * packing.spacing * in_circle(random);
      body.position = in_space(at);
      body.mark = packing.mark;
      bodies.push_back(body);
    }
  }
}

}  // namespace

int particles_in_row(const PackingSpec& packing, int row) {
  const bool shifted = packing.kind == PackingSpec::Kind::hexagonal && row % 2 == 1;
  return packing.columns - (shifted ? 1 : 0);
}

bool is_lattice(const PackingSpec& packing) {
  return packing.kind == PackingSpec::Kind::square || packing.kind == PackingSpec::Kind::hexagonal;
}

double top_of_lattice(const PackingSpec& packing) {
  const bool hexagonal = packing.kind == PackingSpec::Kind::hexagonal;
  const double rise = hexagonal ? std::numbers::sqrt3 / 2 : 1;
  return packing.corner.y() + packing.spacing * (rise * (packing.rows - 1) + 1);
}

double top_of_packings(const Scene& scene) {
  double top = std::numeric_limits<double>::lowest();
  for (const PackingSpec& packing : scene.packings) top = std::max(top, packing.top);
  return top;
}

std::int64_t particle_count(const PackingSpec& packing) {
  if (!is_lattice(packing)) return static_cast<std::int64_t>(packing.placed.size());
  const std::int64_t pairs = packing.rows / 2, odd = packing.rows % 2;
  return pairs * (particles_in_row(packing, 0) + particles_in_row(packing, 1)) +
         odd * particles_in_row(packing, 0);
}

std::vector<BodySpec> place_bodies(const Scene& scene) {
  std::vector<BodySpec> bodies;
  for (const auto& placing : in_file_order(scene.bodies, scene.packings)) {
    if (placing.body != nullptr) bodies.push_back(*placing.body);
    if (placing.packing != nullptr) add_packing(*placing.packing, scene.seed, bodies);
  }
  return bodies;
}

}  // namespace pulvis
