#include "scenes/packing/place.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/portable_math.hpp"
#include "scenes/outlines/portable.hpp"

namespace pulvis {
namespace {

using Kind = PackingSpec::Kind;

const double root_2_3 = std::sqrt(2.0 / 3.0);
constexpr double root_3 = std::numbers::sqrt3;

bool is_in_plane(const PackingSpec& packing) { return packing.cells[2] == 0; }

// ---- rows in the plane -------------------------------------------------------------------------------
// In units of the spacing.
double rise_of_rows(const PackingSpec& packing) {
  return packing.kind == Kind::hexagonal ? root_3 / 2 : 1;
}

// Uniform in a circle of radius 1.
Vec2 in_circle(portable::Random& random) {
  const double radius = std::sqrt(random.uniform());
  const double angle = random.between(0, 2 * std::numbers::pi);
  return radius * Vec2(portable::cos(angle), portable::sin(angle));
}

void add_rows(const PackingSpec& packing, std::uint64_t seed, std::vector<BodySpec>& bodies) {
  const double rise = rise_of_rows(packing);
  portable::Random random(seed);
  for (int row = 0; row < packing.cells[1]; ++row) {
    const int particles = particles_in_row(packing, row), fewer = packing.cells[0] - particles;
    for (int column = 0; column < particles; ++column) {
      BodySpec body;
      body.particle = packing.particle;
      Vec2 at = in_plane(packing.container.corner) +
                packing.spacing * Vec2(column + 0.5 + 0.5 * fewer, rise * row + 0.5);
      if (packing.perturbation > 0)
        at += packing.perturbation * packing.spacing * in_circle(random);
      body.position = in_space(at);
      body.mark = packing.mark;
      bodies.push_back(body);
    }
  }
}

// ---- cells in space ----------------------------------------------------------------------------------
// In a cubic cell, in units of its edges.
std::vector<Vec3> particles_of_cell(Kind kind) {
  if (kind == Kind::body_centred) return {{0, 0, 0}, {0.5, 0.5, 0.5}};
  if (kind == Kind::face_centred) return {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  return {Vec3::Zero()};
}

double neighbour_distance(const PackingSpec& packing) {
  if (packing.kind == Kind::body_centred) return root_3 / 2 * packing.spacing;
  if (packing.kind == Kind::face_centred) return packing.spacing / std::numbers::sqrt2;
  return packing.spacing;
}

// In units of the spacing.
std::vector<Vec3> places_in(const PackingSpec& packing, int i, int k, int layer) {
  std::vector<Vec3> places = particles_of_cell(packing.kind);
  const bool hexagonal = packing.kind == Kind::hexagonal;
  const double shift = layer % 2 == 1 ? 1 : 0;
  const Vec3 cell = hexagonal ? Vec3(i + 0.5 * ((k + layer) % 2),
                                     root_3 / 2 * k + shift * root_3 / 6, root_2_3 * layer)
                              : Vec3(i, k, layer);
  for (Vec3& place : places) place += cell;
  return places;
}

// Uniform in a ball of radius 1.
Vec3 in_ball(portable::Random& random) {
  const double radius = portable::cbrt(random.uniform()), height = random.between(-1, 1);
  const double angle = random.between(0, 2 * std::numbers::pi);
  const double across = std::sqrt(1 - height * height);
  return radius * Vec3(across * portable::cos(angle), across * portable::sin(angle), height);
}

void add_layers(const PackingSpec& packing, std::uint64_t seed, std::vector<BodySpec>& bodies) {
  portable::Random random(seed);
  const Vec3 first = packing.container.corner + Vec3::Constant(neighbour_distance(packing) / 2);
  const auto [columns, rows, layers] = packing.cells;
  for (int layer = 0; layer < layers; ++layer)
    for (int k = 0; k < rows; ++k)
      for (int i = 0; i < columns; ++i)
        for (const Vec3& place : places_in(packing, i, k, layer)) {
          BodySpec body;
          body.particle = packing.particle;
          body.position = first + packing.spacing * place;
          if (packing.perturbation > 0)
            body.position += packing.perturbation * packing.spacing * in_ball(random);
          body.mark = packing.mark;
          bodies.push_back(body);
        }
}

// Between the centres of the first and the last particle along each axis, in units of the spacing.
Vec3 reach_of_cells(const PackingSpec& packing) {
  const auto [columns, rows, layers] = packing.cells;
  if (packing.kind == Kind::hexagonal)
    return {columns - 1 + (rows > 1 || layers > 1 ? 0.5 : 0),
            root_3 / 2 * (rows - 1) + (layers > 1 ? root_3 / 6 : 0), root_2_3 * (layers - 1)};
  const bool centred = packing.kind == Kind::body_centred || packing.kind == Kind::face_centred;
  return Vec3(columns, rows, layers) - Vec3::Constant(centred ? 0.5 : 1);
}

// ---- numbering ---------------------------------------------------------------------------------------
struct Placing {  // one [[body]] or [[packing]]; the other is null
  SourceMark mark;
  const BodySpec* body;
  const PackingSpec* packing;
};

std::vector<Placing> in_file_order(const std::vector<BodySpec>& bodies,
                                   const std::vector<PackingSpec>& packings) {
  std::vector<Placing> placings;
  for (const BodySpec& body : bodies) placings.push_back({body.mark, &body, nullptr});
  for (const PackingSpec& packing : packings) placings.push_back({packing.mark, nullptr, &packing});
  std::ranges::stable_sort(placings, written_before, &Placing::mark);
  return placings;
}

}  // namespace

int particles_in_row(const PackingSpec& packing, int row) {
  const bool shifted = packing.kind == Kind::hexagonal && row % 2 == 1;
  return packing.cells[0] - (shifted ? 1 : 0);
}

bool is_lattice(const PackingSpec& packing) {
  return packing.kind != Kind::random && packing.kind != Kind::csv;
}

double touching_spacing(Kind kind) {
  if (kind == Kind::body_centred) return 2 / std::sqrt(3.0);
  return kind == Kind::face_centred ? std::sqrt(2.0) : 1;
}

Vec3 size_of_lattice(const PackingSpec& packing) {
  if (!is_in_plane(packing))
    return packing.spacing * reach_of_cells(packing) + Vec3::Constant(neighbour_distance(packing));
  const double rise = rise_of_rows(packing);
  return packing.spacing * Vec3(packing.cells[0], rise * (packing.cells[1] - 1) + 1, 0);
}

double top_of_lattice(const PackingSpec& packing) {
  const Vec3& corner = packing.container.corner;
  if (is_in_plane(packing)) return corner.y() + size_of_lattice(packing).y();
  return corner.z() + packing.spacing * reach_of_cells(packing).z() + neighbour_distance(packing);
}

double top_of_packings(const Scene& scene) {
  double top = std::numeric_limits<double>::lowest();
  for (const PackingSpec& packing : scene.packings) top = std::max(top, packing.top);
  return top;
}

std::int64_t particle_count(const PackingSpec& packing) {
  if (!is_lattice(packing)) return static_cast<std::int64_t>(packing.placed.size());
  const auto [columns, rows, layers] = packing.cells;
  if (!is_in_plane(packing))
    return static_cast<std::int64_t>(particles_of_cell(packing.kind).size()) * columns * rows *
           layers;
  const std::int64_t pairs = rows / 2, odd = rows % 2;
  return pairs * (particles_in_row(packing, 0) + particles_in_row(packing, 1)) +
         odd * particles_in_row(packing, 0);
}

std::vector<BodySpec> place_bodies(const Scene& scene) {
  std::vector<BodySpec> bodies;
  for (const auto& placing : in_file_order(scene.bodies, scene.packings)) {
    if (placing.body != nullptr) bodies.push_back(*placing.body);
    if (placing.packing == nullptr) continue;
    const PackingSpec& packing = *placing.packing;
    if (!is_lattice(packing))
      bodies.insert(bodies.end(), packing.placed.begin(), packing.placed.end());
    else if (is_in_plane(packing))
      add_rows(packing, scene.seed, bodies);
    else
      add_layers(packing, scene.seed, bodies);
  }
  return bodies;
}

}  // namespace pulvis
