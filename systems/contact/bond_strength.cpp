#include "systems/contact/bond_strength.hpp"

#include <cstdint>

#include "engine/portable_math.hpp"

namespace pulvis {
namespace {

// Identical on every machine (Steele, Lea & Flood 2014: SplitMix64).
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

}  // namespace

double drawn_strength(const BondRules::Law& law, int first, int second) {
  if (law.weibull_modulus == 0) return 1;
  const auto word = [](int number) { return static_cast<std::uint32_t>(number); };
  const std::uint64_t pair =
      std::uint64_t{word(std::min(first, second))} << 32 | word(std::max(first, second));
  const double uniform = static_cast<double>(mixed(mixed(law.seed) ^ pair) >> 11) * 0x1p-53;
  return std::min(portable::pow(-portable::log(1 - uniform), 1 / law.weibull_modulus),
                  law.largest_share);
}

}  // namespace pulvis
