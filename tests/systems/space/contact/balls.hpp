// Balls that touch each other or a floor, which contact tests of three dimensions share.
#pragma once

#include <cstdint>
#include <functional>
#include <random>

#include "tests/systems/space/contact/touching_bodies.hpp"

namespace pulvis::space {

inline constexpr double diameter = 10e-3;

inline const Shape& ball() {
  static const Shape shape = space::make_shape(sphere_of(diameter));
  return shape;
}

inline Vec3 any_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}
inline Rotation any_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Rotation(normal(random), normal(random), normal(random), normal(random)).normalized();
}

inline FrictionSpec coulomb(double mu) {
  FrictionSpec friction;
  friction.coefficient = mu;
  return friction;
}
// Of the balls' steel against `other`.
inline void add_friction(Scene& scene, const char* other, FrictionSpec friction) {
  friction.first = "steel";
  friction.second = other;
  scene.frictions = {friction};
}

// Of the balls' steel to itself. (J/m^2, m)
inline BondSpec adhesion(double work, double range) {
  BondSpec bond;
  bond.origin = BondSpec::Origin::adhesion;
  bond.first = bond.second = "steel";
  bond.work = work;
  bond.range = range;
  return bond;
}

// Two balls that overlap by `depth`, turned at random, nodes of both displaced a little.
struct TwoBalls : TouchingBodies {
  explicit TwoBalls(double depth, std::uint64_t seed, const FrictionSpec& friction = {},
                    const std::vector<BondSpec>& bonds = {})
      : TwoBalls(depth, std::mt19937_64(seed), friction, bonds) {}

 private:
  TwoBalls(double depth, std::mt19937_64 random, const FrictionSpec& friction,
           const std::vector<BondSpec>& bonds)
      : TouchingBodies({ball()},
                       {body_at(Vec3::Zero(), any_rotation(random)),
                        body_at((diameter - depth) * any_direction(random), any_rotation(random))},
                       [&](Scene& s) {
                         add_friction(s, "steel", friction);
                         s.bonds = bonds;
                       }) {
    std::uniform_real_distribution<double> noise(-2e-5, 2e-5);
    for (int body = 0; body < 2; ++body)
      move(body, [&](const Vec3& x) {
        return Vec3(x + Vec3(noise(random), noise(random), noise(random)));
      });
  }
};

inline ToolSpec floor_plane() {
  ToolSpec tool;
  tool.normal = Vec3::UnitZ();
  tool.name = "floor";
  tool.shape = ToolSpec::Shape::plane;
  return tool;
}

struct BallOnFloor : TouchingBodies {
  BallOnFloor(double depth, const FrictionSpec& friction, const Rotation& rotation,
              const std::vector<BondSpec>& bonds = {})
      : TouchingBodies({ball()}, {body_at(Vec3(0, 0, diameter / 2 - depth), rotation)},
                       [&](Scene& s) {
                         s.tools = {floor_plane()};
                         add_friction(s, "floor", friction);
                         s.bonds = bonds;
                       }) {
    world.resource<Clock>().dt_before = 1e-8;
  }
  void slide(const Vec3& velocity) {
    const double dt = world.resource<Clock>().dt_before;
    set_velocity(0, [&](const Vec3&) { return velocity; });
    move(0, [&](const Vec3& x) { return Vec3(x + dt * velocity); });
    update(false);
  }
};

}  // namespace pulvis::space
