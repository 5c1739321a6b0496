#include "scenes/space/results/observed_stress.hpp"

#include <array>
#include <cmath>

#include "components/shape.hpp"
#include "components/observed.hpp"
#include "engine/access.hpp"
#include "scenes/space/tools/die_room.hpp"

namespace pulvis::space {
namespace {

// Component k of a particle column.
template <class C>
double in_slot_of(const World& world, int slot, int k) {
  const Lane* row = world.column<C>().lanes() + std::ptrdiff_t{slot / lane_count} * C::count;
  return row[k][slot % lane_count];
}

template <class C>
std::vector<double> of_particles(const World& world) {
  std::vector<double> all;
  for (const int slot : world.resource<Bodies>().slot_of_number)
    for (int k = 0; k < C::count; ++k) all.push_back(in_slot_of<C>(world, slot, k));
  return all;
}

}  // namespace

void add_observed_stress(World& world, const Scene& scene) {
  if (!scene.observes_stress()) return;
  world.add<ParticleStress<ThreeD>>();
  world.add<DeformedSize<ThreeD>>();
  world.add<ParticleCentre<ThreeD>>();
}

std::vector<SeriesInfo> stress_series(const Scene& scene) {
  if (!scene.observes_stress() || !die_room(scene)) return {};
  return {{"stress/xx", "Pa", "Cauchy, mean over the volume between the tools; tension > 0"},
          {"stress/yy", "Pa", "as stress/xx"},
          {"stress/zz", "Pa", "as stress/xx"},
          {"stress/xy", "Pa", "as stress/xx"},
          {"stress/yz", "Pa", "as stress/xx"},
          {"stress/zx", "Pa", "as stress/xx"},
          {"stress/mean", "Pa", "(xx + yy + zz) / 3: minus the pressure p"},
          {"stress/deviatoric", "Pa", "von Mises' stress q of these means"}};
}

std::vector<FieldInfo> stress_fields(const World& world) {
  if (!world.has<ParticleStress<ThreeD>>()) return {};
  return {{"particle_stress", "Pa", ParticleStress<ThreeD>::info.meaning, FieldPlace::particle, 6},
          {"particle_centre", "m", ParticleCentre<ThreeD>::info.meaning, FieldPlace::particle, 3}};
}

void append_stress_sample(const World& world, double room, std::vector<double>& row) {
  if (!world.has<ParticleStress<ThreeD>>()) return;
  std::array<double, 6> s{};
  for (const int slot : world.resource<Bodies>().slot_of_number)
    for (int k = 0; k < 6; ++k)
      entry(s, k) += in_slot_of<DeformedSize<ThreeD>>(world, slot, 0) / room *
                     in_slot_of<ParticleStress<ThreeD>>(world, slot, k);
  const double mean = (s[0] + s[1] + s[2]) / 3;
  const double xx = s[0] - mean, yy = s[1] - mean, zz = s[2] - mean;
  const double shear = s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
  row.insert(row.end(), s.begin(), s.end());
  row.insert(row.end(), {mean, std::sqrt(1.5 * (xx * xx + yy * yy + zz * zz + 2 * shear))});
}

void append_stress_frame(const World& world, std::vector<std::vector<double>>& fields) {
  if (!world.has<ParticleStress<ThreeD>>()) return;
  fields.push_back(of_particles<ParticleStress<ThreeD>>(world));
  fields.push_back(of_particles<ParticleCentre<ThreeD>>(world));
}

}  // namespace pulvis::space
