// What a scene can output beyond forces and energies ([output]): stresses of the particles, their contact network, local
// densities (in three dimensions: components/space/observed.hpp). Written in sampled steps only; nothing in a step reads it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "components/dimension.hpp"
#include "components/shape.hpp"

namespace pulvis {

// ---- output.particle_stress -----------------------------------------------------------------------
template <class D>
struct ParticleStress : Component<Particle, double, D::axes == 2 ? 4 : 6> {
  static constexpr ComponentInfo info{
      "stress", "Pa",
      D::axes == 2 ? "Cauchy, mean over the particle: xx yy zz xy; tension > 0"
                   : "Cauchy, mean over the particle: xx yy zz xy yz zx; tension > 0"};
};
template <class D>
struct DeformedSize : Component<Particle, double, 1> {  // area or volume
  static constexpr ComponentInfo info{D::axes == 2 ? "deformed_area" : "deformed_volume",
                                      D::axes == 2 ? "m^2" : "m^3", "of its elements now"};
};
template <class D>
struct ParticleCentre : Component<Particle, double, D::axes> {
  static constexpr ComponentInfo info{"centre", "m",
                                      D::axes == 2
                                          ? "middles of its elements, weighted with their areas"
                                          : "middles of its elements, weighted with their volumes"};
};

// ---- output.contacts --------------------------------------------------------------------------------
// Resultant of one particle on another, or of a tool on a particle: the sum over their contact points.
template <class D>
struct ContactLink {
  using Point = typename D::Point;
  std::int32_t first = 0;   // number of the particle that `force` acts on
  std::int32_t second = 0;  // number of the other particle, > first; or the tool
  Point point{};            // m, mean of the contact points, weighted by force
  Point normal{};           // unit vector into the first particle, weighted by normal force
  Point force{};            // N
  double size = 0;          // m, length of the contact; in three dimensions m^2, its area
  Point period{};           // m, from the other particle to its image that the first touches

  // N, > 0 in compression.
  double normal_force() const {
    const double in_plane = force[0] * normal[0] + force[1] * normal[1];
    if constexpr (D::axes == 2)
      return in_plane;
    else
      return in_plane + force[2] * normal[2];
  }
  // N, in the plane the component along (-n_y, n_x); in three dimensions its size.
  double tangential_force() const {
    if constexpr (D::axes == 2) return force[1] * normal[0] - force[0] * normal[1];
    double square = 0;
    for (const double along : force) square += along * along;
    const double push = normal_force();
    return std::sqrt(std::max(0.0, square - push * push));
  }

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(first, second, point, normal, force, size, period);
  }
};

template <class D>
struct ContactNetwork {
  static constexpr const char* resource_name = "contact_network";
  std::vector<ContactLink<D>> pairs;  // each pair once, sorted by numbers; no self-contact
  std::vector<ContactLink<D>> tools;

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(pairs, tools);
  }
};

// ---- in every scene with contact --------------------------------------------------------------------
// How well the meshes resolve the contacts, as last observed. A contact is everything between an outline, or surface,
// and one other, or one tool; in a pair of particles each side counts separately. In three dimensions edges are faces.
struct ContactQuality {
  static constexpr const char* resource_name = "contact_quality";
  static constexpr double min_edges = 2;  // narrower contacts are not resolved
  double overlap = 0;           // m^2, of outlines with each other and with tools; m^3 of surfaces
  double penetration_work = 0;  // J, normal force times penetration, summed; 0 in 3D
  double force = 0;             // N, sum over the contacts
  double narrow_force = 0;      // N, of contacts narrower than two boundary edges
  double narrow_width = 0;      // N m, their widths times their forces
  double narrow_edges = 0;      // N, their widths in edges times their forces

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(overlap, penetration_work, force, narrow_force, narrow_width, narrow_edges);
  }
};

struct ForceChains {
  static constexpr const char* resource_name = "force_chains";
  std::vector<std::int32_t> chain;  // [particles], by number: its force chain, from 1; 0: none

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(chain);
  }
};

// ---- output.density_cells ---------------------------------------------------------------------------
struct DensityGrid {
  static constexpr const char* resource_name = "density_grid";
  enum Side { left, right, bottom, top };
  using OutlineEdge = std::array<Row<Node>, 2>;

  int columns = 0, rows = 0;
  std::array<int, 4> tool{};                      // one per side
  std::array<std::vector<Point>, 4> surface{};    // m, relative to the tool; empty for a plane
  std::vector<std::vector<OutlineEdge>> outline;  // [shapes]: material on the left, holes included

  // As last observed.
  std::array<double, 4> side{};  // m: x of left and right, y of bottom and top
  std::vector<double> filled;    // m^2, [rows * columns] from the bottom: particle area in a cell
  std::vector<double> room;      // m^2, area of the cell outside the tools

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(side, filled, room);
  }
};

}  // namespace pulvis
