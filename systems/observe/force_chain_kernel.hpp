// Force chains: which particles pass the load on from one to the next.
//
// Source   Peters, Muthuswamy, Wibowo & Tordesillas, "Characterization of force chains in granular
//          material", Phys. Rev. E 72, 041307 (2005)
// Law      A particle can be part of a chain if its major principal compression is above the mean of all
//          particles. It leads on to a touching particle that can be part of one too and lies within 45
//          degrees of the direction of that compression, if the same holds from there. Chains have at least
//          three particles; branches belong to the chain
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <span>
#include <vector>

#include "components/shape.hpp"
#include "engine/portable_math.hpp"

namespace pulvis::kernels {

struct PlaneStress {  // Pa, in the plane of the slice; tension > 0
  double xx = 0, yy = 0, xy = 0;
};

template <std::size_t N>  // number of dimensions
struct TouchingPair {
  std::int32_t first, second;
  std::array<double, N> period{};  // m, from the second to its image that touches the first
};

template <std::size_t N>
struct MajorCompression {
  double size = 0;                    // Pa, > 0 in compression
  std::array<double, N> direction{};  // unit vector
};

inline MajorCompression<2> major_compression(const PlaneStress& s) {
  const double middle = 0.5 * (s.xx + s.yy), half = 0.5 * (s.xx - s.yy);
  const double angle = 0.5 * portable::atan2(-s.xy, -half);  // of the smallest normal stress
  return {portable::hypot(half, s.xy) - middle, {portable::cos(angle), portable::sin(angle)}};
}

// Of a mean stress in the plane, xx yy zz xy.
inline MajorCompression<2> major_compression(const std::array<double, 4>& stress) {
  return major_compression(PlaneStress{stress[0], stress[1], stress[3]});
}
// Of a mean stress of particles, Pa, xx yy zz xy yz zx; tension > 0.
inline MajorCompression<3> major_compression(const std::array<double, 6>& stress) {
  Eigen::Matrix3d s;
  s << stress[0], stress[3], stress[5],  //
      stress[3], stress[1], stress[4],   //
      stress[5], stress[4], stress[2];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(s);  // smallest first
  const Eigen::Vector3d way = principal.eigenvectors().col(0);
  return {-principal.eigenvalues()[0], {way.x(), way.y(), way.z()}};
}

inline constexpr int min_of_a_chain = 3;

// Per particle: its chain, numbered from 1 in the order of their first particles; 0 if it is in none.
template <std::size_t N>
std::vector<std::int32_t> chains_of(const std::vector<MajorCompression<N>>& load,
                                    std::span<const std::array<double, N>> centre,
                                    std::span<const TouchingPair<N>> touching) {
  const std::size_t count = load.size();
  const double mean = std::accumulate(load.begin(), load.end(), 0.0,
                                      [](double sum, const auto& l) { return sum + l.size; }) /
                      static_cast<double>(count);
  std::vector<std::size_t> leader(count);  // union-find, the lowest number leads
  std::iota(leader.begin(), leader.end(), std::size_t{0});
  const auto leader_of = [&](std::size_t p) {
    while (leader[p] != p) p = leader[p] = leader[leader[p]];
    return p;
  };
  const auto leads_on = [&](std::size_t from, const std::array<double, N>& way) {
    if (!(load[from].size > mean) || !(load[from].size > 0)) return false;
    double along = 0, square = 0;
    for (std::size_t k = 0; k < N; ++k) {
      along += way[k] * load[from].direction[k];
      square += way[k] * way[k];
    }
    return std::abs(along) >= std::sqrt(0.5 * square);
  };
  for (const auto& [a, b, period] : touching) {
    const auto p = static_cast<std::size_t>(a), q = static_cast<std::size_t>(b);
    std::array<double, N> way;
    for (std::size_t k = 0; k < N; ++k) way[k] = centre[q][k] + period[k] - centre[p][k];
    if (!leads_on(p, way) || !leads_on(q, way)) continue;
    const std::size_t one = leader_of(p), other = leader_of(q);
    leader[std::max(one, other)] = std::min(one, other);
  }
  std::vector<int> members(count, 0);
  for (std::size_t p = 0; p < count; ++p) ++members[leader_of(p)];
  std::map<std::size_t, std::int32_t> number;
  std::vector<std::int32_t> chain(count, 0);
  for (std::size_t p = 0; p < count; ++p) {
    const std::size_t first = leader_of(p);
    if (members[first] < min_of_a_chain) continue;
    chain[p] = number.emplace(first, static_cast<std::int32_t>(number.size()) + 1).first->second;
  }
  return chain;
}

}  // namespace pulvis::kernels
