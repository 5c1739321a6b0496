// A few sizes that stand for a law of sizes.
#pragma once

#include "scenes/spec/scene.hpp"

#include <vector>

namespace pulvis {

struct SievePoint {
  double size;     // m
  double passing;  // -, share of the area, or volume, that is smaller
};
using SieveCurve = std::vector<SievePoint>;

// Throws SceneError, at the file's line, for one that does not rise from 0 to 1.
SieveCurve read_sieve_curve(const std::filesystem::path& file);

struct SizeShare {
  double size;   // m
  double share;  // -, of the number of particles
};

// `count` sizes. The law is cut into as many parts of one share each, of the number of particles or, for a
// sieve curve, of their area (in three dimensions: volume); the size of each is that of its part's mean area, so that number
// and area of the whole are the law's. What is lost is the spread inside the parts.
std::vector<SizeShare> sizes_of(const SizeLaw& law, const SieveCurve& curve, int count,
                                int dimensions = 2);

// Whole numbers in these proportions that add up to `total` (largest remainders).
std::vector<int> apportioned(int total, const std::vector<double>& shares);

}  // namespace pulvis
