// Rough profiles from two parameters and a seed: heights with a Gaussian autocorrelation.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

inline constexpr int stations_a_length = 8;  // per correlation length
inline constexpr int lengths_a_period =
    64;  // correlation lengths, doubled as often as needed

// Heights at equal spacing, stations_a_length to a correlation length, over one period of so many
// correlation lengths. The straight segments between them have exactly the roughness `ra`, mean 0.
//
// Law      autocorrelation exp(-(x / correlation_length)^2): white noise under exp(-2 (x / length)^2)
//          (Garcia & Stoll, Phys. Rev. Lett. 52, 1798, 1984), the same with every compiler
std::vector<double> rough_heights(double ra, std::uint64_t seed, int lengths);

// Exact Ra of the straight segments between points: mean distance from the mean line, in height.
double arithmetic_roughness(const std::vector<Vec2>& points);

}  // namespace pulvis
