#include "cli/campaigns/probe/probe_directions.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "engine/portable_math.hpp"

namespace pulvis {
namespace {

using Set = ProbeDirection::Set;

double share_of_turn(int k, int count) { return 2 * std::numbers::pi * k / count; }

// Degrees with at most one decimal.
std::string named(const char* what, double angle) {
  constexpr double half = 0.5;
  return fmt::format("{}={:g}", what, std::floor(1800 / std::numbers::pi * angle + half) / 10);
}

}  // namespace

std::vector<ProbeDirection> directions_of(const ProbeSpec& spec, bool in_space) {
  std::vector<ProbeDirection> all;
  const AxialPlane plane = axial_plane(axis_of(in_space));
  for (int k = 0; k < spec.directions; ++k) {
    const double angle = share_of_turn(k, spec.directions);
    all.push_back({named("direction", angle), Set::axial, angle,
                   portable::cos(angle) * plane.across + portable::sin(angle) * plane.along});
  }
  for (int k = 0; in_space && k < spec.deviatoric; ++k) {
    const double lode = share_of_turn(k, spec.deviatoric);
    all.push_back({named("lode", lode), Set::deviatoric, lode, unit_deviator(lode)});
  }
  for (int k = 3; k < (in_space ? 6 : 4); ++k) {
    const char* part = tensor_part_names[static_cast<std::size_t>(k)];
    all.push_back(
        {in_space ? fmt::format("shear_{}", part) : "shear", Set::shear, 0, Mandel::Unit(k)});
  }
  for (const GivenDirection& given : spec.given)
    all.push_back({given.name, Set::given, 0, mandel_of(given.parts).normalized()});
  return all;
}

const char* name_of(Set set) {
  switch (set) {
    case Set::axial:
      return "axial";
    case Set::deviatoric:
      return "deviatoric";
    case Set::shear:
      return "shear";
    case Set::given:
      return "given";
  }
  return "";
}

}  // namespace pulvis
