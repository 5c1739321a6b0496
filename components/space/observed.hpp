// What a scene in three dimensions can output about its particles. Written in sampled steps only; nothing in a
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
// Resultant of one particle on another, or of a tool on a particle: the sum over their contact points.
struct ContactLink {
  std::int32_t first = 0;   // number of the particle that `force` acts on
  std::int32_t second = 0;  // number of the other particle, > first; or the tool
  Point point{};            // m, mean of the contact points, weighted by force
  Point normal{};           // unit vector into the first particle, weighted by normal force
  Point force{};            // N
  double area = 0;          // m^2, area of the contact

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
  std::vector<ContactLink> pairs;  // each pair once, sorted by numbers
  std::vector<ContactLink> tools;

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(pairs, tools);
  }
};

// ---- output.density_cells ---------------------------------------------------------------------------
struct DensityGrid {
  static constexpr const char* resource_name = "density_grid";
  // The face of a punch: distances from its axis, and heights above its centre, along its normal, m.
  using Profile = std::vector<std::array<double, 2>>;

  std::array<int, 3> cells{};           // along x, y, z
  DieRoom between;                      // the tools
  std::array<Profile, 2> bottom_top{};  // of a round room; empty if flat

  // As last observed.
  std::array<double, 3> low{}, high{};  // m
  std::vector<double> filled;           // m^3, [z * y * x]: particle volume in a cell
  std::vector<double> room;             // m^3, volume of the cell between the tools

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(low, high, filled, room);
  }
};

}  // namespace pulvis::space
