// What a packing needs to know of its particles in two dimensions. Solids have the same functions
// (scenes/packing/packed_solids.hpp).
#pragma once

#include "scenes/outlines/outline_reach.hpp"
#include "scenes/packing/mixture.hpp"
#include "scenes/packing/outlines/container.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

struct PackedOutlines {
  static constexpr int up = 1;  // axis

  static void resize(ParticleSpec& particle, double factor);
  // Its sieve size is the minimum width, and is not needed for classes of one size.
  static ParticleMeasure measure(const ParticleSpec& particle, bool one_size);
  static double mean_diameter(double content, int count);  // m
  static RigidShape shape(const ParticleSpec& particle, double unit);
  static double least_width(const ParticleSpec& particle);  // m
  static Container container(const Scene& scene, const ContainerSpec& given, double unit);
  // A particle where a die, or the cell, has it.
  static BodySpec placed(const Scene& scene, const ContainerSpec& given, const RigidShape& shape,
                         RigidPose pose, double height, double unit);
  static void put_on(ToolSpec& tool, double top);  // a tool that rests on the packing

  class Reach {  // of a class
   public:
    explicit Reach(const ParticleSpec& particle) : reach_(particle.outline) {}
    double upwards(const BodySpec& body) const { return reach_.along(body.angle, Vec2::UnitY()); }

   private:
    OutlineReach reach_;
  };
};

}  // namespace pulvis
