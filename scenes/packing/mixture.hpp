// The particles of a random packing: its classes, fractions and sizes as whole numbers. In two and three dimensions:
// "content" is an area or a volume.
#pragma once

#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

#include <functional>
#include <vector>

namespace pulvis {

struct ParticleMeasure {
  double size;     // m, sieve size; 1 if the class has one size
  double content;  // m^2, m^3
};

struct MixtureOrder {
  const std::vector<MixtureClass>& classes;
  std::optional<int> count;
  std::optional<double> density, height;
  bool dense = false;  // a keyword instead of the density
  double base = 0;     // width or area of the floor, m, m^2
  int dimensions = 2;
  std::filesystem::path folder = {};                                 // of sieve curves
  std::function<ParticleMeasure(const MixtureClass&)> measure = {};  // of a class's original particle
};

struct MixtureSize {
  int particle = 0;  // index in the scene's particles
  double scale = 1;  // of the class's shape
  int count = 0;
};

struct Mixture {
  std::vector<MixtureSize> sizes;  // class by class, from small to large
  int count = 0;
  double content = 0;  // m^2, m^3, total
};

// What the classes describe; `path` is that of the packing. The mixture is empty if there are problems.
Mixture mixture_of(const MixtureOrder& order, const std::string& path,
                   const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
