// Rough profiles from two numbers and a seed: heights with a Gaussian autocorrelation.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

inline constexpr int stations_a_length = 8;  // of a correlation length
inline constexpr int lengths_a_period =
    64;  // correlation lengths, or that doubled as often as wanted

// Heights at equal distances, stations_a_length to a correlation length, over one period of so many
// correlation lengths. Straight pieces between them have just the roughness `ra`, and the mean 0.
//
// Law      autocorrelation exp(-(x / correlation_length)^2): white noise under exp(-2 (x / length)^2)
//          (Garcia & Stoll, Phys. Rev. Lett. 52, 1798, 1984), the same with every compiler
std::vector<double> rough_heights(double ra, std::uint64_t seed, int lengths);

// Ra of straight pieces from point to point, exactly: mean distance from the mean line, in height.
double arithmetic_roughness(const std::vector<Vec2>& points);

}  // namespace pulvis
