#include "scenes/space/packing/place.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scenes/packing/in_file_order.hpp"
namespace pulvis::space {
namespace {

using Kind = PackingSpec::Kind;

const double root_2_3 = std::sqrt(2.0 / 3.0);

// In a cubic cell, in units of its edges.
std::vector<Vec3> particles_of_cell(Kind kind) {
  if (kind == Kind::body_centred) return {{0, 0, 0}, {0.5, 0.5, 0.5}};
  if (kind == Kind::face_centred) return {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  return {Vec3::Zero()};
}

double neighbour_distance(const PackingSpec& packing) {
  if (packing.kind == Kind::body_centred) return std::numbers::sqrt3 / 2 * packing.spacing;
  if (packing.kind == Kind::face_centred) return packing.spacing / std::numbers::sqrt2;
  return packing.spacing;
}

// In units of the spacing.
std::vector<Vec3> places_in(const PackingSpec& packing, int i, int k, int layer) {
  std::vector<Vec3> places = particles_of_cell(packing.kind);
  const bool hexagonal = packing.kind == Kind::hexagonal;
  const double root_3 = std::numbers::sqrt3;
  const double shift = layer % 2 == 1 ? 1 : 0;
  const Vec3 cell = hexagonal ? Vec3(i + 0.5 * ((k + layer) % 2),
                                     root_3 / 2 * k + shift * root_3 / 6, root_2_3 * layer)
                              : Vec3(i, k, layer);
  for (Vec3& place : places) place += cell;
  return places;
}

void add_lattice(const PackingSpec& packing, std::vector<BodySpec>& bodies) {
  const Vec3 first = packing.container.corner + Vec3::Constant(neighbour_distance(packing) / 2);
  const auto [columns, rows, layers] = packing.cells;
  for (int layer = 0; layer < layers; ++layer)
    for (int k = 0; k < rows; ++k)
      for (int i = 0; i < columns; ++i)
        for (const Vec3& place : places_in(packing, i, k, layer)) {
          BodySpec body;
          body.particle = packing.particle;
          body.position = first + packing.spacing * place;
          body.mark = packing.mark;
          bodies.push_back(body);
        }
}

}  // namespace

bool is_lattice(const PackingSpec& packing) {
  return packing.kind != Kind::random && packing.kind != Kind::csv;
}

std::int64_t particle_count(const PackingSpec& packing) {
  if (!is_lattice(packing)) return static_cast<std::int64_t>(packing.placed.size());
  return static_cast<std::int64_t>(particles_of_cell(packing.kind).size()) * packing.cells[0] *
         packing.cells[1] * packing.cells[2];
}

double top_of_lattice(const PackingSpec& packing) {
  const int layers = packing.cells[2];
  const bool centred = packing.kind == Kind::body_centred || packing.kind == Kind::face_centred;
  const double last =
      packing.kind == Kind::hexagonal ? root_2_3 * (layers - 1) : layers - (centred ? 0.5 : 1);
  return packing.container.corner.z() + packing.spacing * last + neighbour_distance(packing);
}

double top_of_packings(const SpaceScene& scene) {
  double top = std::numeric_limits<double>::lowest();
  for (const PackingSpec& packing : scene.packings) top = std::max(top, packing.top);
  return top;
}

std::vector<BodySpec> place_bodies(const Scene& scene) {
  std::vector<BodySpec> bodies;
  for (const auto& placing : in_file_order(scene.bodies, scene.space->packings)) {
    if (placing.body != nullptr) bodies.push_back(*placing.body);
    if (placing.packing == nullptr) continue;
    const PackingSpec& packing = *placing.packing;
    if (is_lattice(packing))
      add_lattice(packing, bodies);
    else
      bodies.insert(bodies.end(), packing.placed.begin(), packing.placed.end());
  }
  return bodies;
}

}  // namespace pulvis::space
