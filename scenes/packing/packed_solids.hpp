// What a packing needs to know of its particles in three dimensions. Outlines have the same functions
// (scenes/packing/packed_outlines.hpp).
#pragma once

#include "scenes/packing/mixture.hpp"
#include "scenes/packing/solids/container.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {

struct PackedSolids {
  static constexpr int up = 2;  // axis

  static void resize(ParticleSpec& particle, double factor);
  // Its sieve size is the middle width, and is not needed for classes of one size.
  static ParticleMeasure measure(const ParticleSpec& particle, bool one_size);
  static double mean_diameter(double content, int count);  // m
  static RigidShape shape(const ParticleSpec& particle, double unit);
  static double least_width(const ParticleSpec& particle);  // m
  static Container container(const Scene& scene, const ContainerSpec& given, double unit);
  // A particle where a die has it.
  static BodySpec placed(const Scene& scene, const ContainerSpec& given, const RigidShape& shape,
                         const RigidPose& pose, double height, double unit);
  static void put_on(ToolSpec& tool, double top);  // a tool that rests on the packing

  class Reach {  // of a class
   public:
    explicit Reach(const ParticleSpec& particle) : shape_(rigid_shape(particle.shape, 1)) {}
    double upwards(const BodySpec& body) const;

   private:
    RigidShape shape_;
  };
};

}  // namespace pulvis::space
