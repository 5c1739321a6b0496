// What a scene in three dimensions can ask to be observed of its particles. Written on sampled steps only; nothing in a
// step reads it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "components/die_room.hpp"
#include "components/entities.hpp"
#include "components/space/shape.hpp"

namespace pulvis::space {

// ---- output.particle_stress -----------------------------------------------------------------------
struct ParticleStress : Component<Particle, double, 6> {
  static constexpr ComponentInfo info{
      "stress", "Pa", "Cauchy, mean over the particle: xx yy zz xy yz zx; tension > 0"};
};
struct DeformedVolume : Component<Particle, double, 1> {
  static constexpr ComponentInfo info{"deformed_volume", "m^3", "of its elements now"};
};
struct ParticleCentre : Component<Particle, double, 3> {
  static constexpr ComponentInfo info{"centre", "m",
                                      "middles of its elements, weighted with their volumes"};
};

// ---- output.contacts --------------------------------------------------------------------------------
// All that one particle does to another, or a tool to a particle: the sum of their contact points.
struct ContactLink {
  std::int32_t first = 0;   // number of the particle that `force` acts on
  std::int32_t second = 0;  // number of the other particle, > first; or the tool
  Point point{};            // m, mean of the contact points, weighted with their forces
  Point normal{};           // unit vector into the first particle, weighted with the normal forces
  Point force{};            // N
  double area = 0;          // m^2, of the surface that touches

  double normal_force() const {
    return force[0] * normal[0] + force[1] * normal[1] + force[2] * normal[2];
  }
  double tangential_force() const {
    const double square = force[0] * force[0] + force[1] * force[1] + force[2] * force[2];
    const double push = normal_force();
    return std::sqrt(std::max(0.0, square - push * push));
  }
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(first, second, point, normal, force, area);
  }
};

struct ContactNetwork {
  static constexpr const char* resource_name = "contact_network";
  std::vector<ContactLink> pairs;  // each once, sorted by numbers
  std::vector<ContactLink> tools;

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(pairs, tools);
  }
};

// ---- output.density_cells ---------------------------------------------------------------------------
struct DensityGrid {
  static constexpr const char* resource_name = "density_grid";
  // The face of a punch: distances from its axis, and heights over its middle, along its normal, m.
  using Profile = std::vector<std::array<double, 2>>;

  std::array<int, 3> cells{};           // along x, y, z
  DieRoom between;                      // the tools
  std::array<Profile, 2> bottom_top{};  // of a round room; flat: empty

  // As last observed.
  std::array<double, 3> low{}, high{};  // m
  std::vector<double> filled;           // m^3, [z * y * x]: of the particles in a cell
  std::vector<double> room;             // m^3, of the cell between the tools

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(low, high, filled, room);
  }
};

}  // namespace pulvis::space
