// A few discrete sizes that represent a size distribution.
#pragma once

#include "scenes/spec/scene.hpp"

#include <vector>

namespace pulvis {

struct SievePoint {
  double size;     // m
  double passing;  // -, fraction of the area, or volume, that is smaller
};
using SieveCurve = std::vector<SievePoint>;

// Throws SceneError, with the line of the file, for a curve that does not rise from 0 to 1.
SieveCurve read_sieve_curve(const std::filesystem::path& file);

struct SizeShare {
  double size;   // m
  double share;  // -, fraction of the number of particles
};

// `count` sizes. The law is divided into that many parts of equal share, by number of particles or, for a
// sieve curve, by area (in three dimensions: volume); each size is that of its part's mean area, so the total number
// and area match the law. Only the spread within the parts is lost.
std::vector<SizeShare> sizes_of(const SizeLaw& law, const SieveCurve& curve, int count,
                                int dimensions = 2);

// Integers in these proportions that add up to `total` (largest remainders).
std::vector<int> apportioned(int total, const std::vector<double>& shares);

}  // namespace pulvis
