// output.particle_stress: mean stresses of the particles, and of the compact.
#include <array>
#include <cmath>

#include "components/observed.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "scenes/results/observables/enclosure.hpp"
#include "scenes/results/observables/result_rows.hpp"

namespace pulvis {
namespace {

// Value k of a particle, in a column of particles.
template <class C>
double value_in_slot(const World& world, int slot, int k) {
  const Lane* row = world.column<C>().lanes() + std::ptrdiff_t{slot / lane_count} * C::count;
  return row[k][slot % lane_count];
}

template <class C>
std::vector<double> by_number(const Observation& now) {
  std::vector<double> all;
  for (const int slot : now.world.resource<Bodies>().slot_of_number)
    for (int k = 0; k < C::count; ++k) all.push_back(value_in_slot<C>(now.world, slot, k));
  return all;
}

struct StressFigures {
  std::array<double, 6> stress{};  // Pa, xx yy zz xy yz zx
  double mean = 0, deviatoric = 0;
};

// `size`: of the enclosure.
template <class D>
StressFigures mean_stress(const World& world, double size) {
  StressFigures f;
  std::array<double, 6>& s = f.stress;
  for (const int slot : world.resource<Bodies>().slot_of_number)
    for (int k = 0; k < ParticleStress<D>::count; ++k)
      entry(s, k) += value_in_slot<DeformedSize<D>>(world, slot, 0) / size *
                     value_in_slot<ParticleStress<D>>(world, slot, k);
  f.mean = (s[0] + s[1] + s[2]) / 3;
  const double xx = s[0] - f.mean, yy = s[1] - f.mean, zz = s[2] - f.mean;
  const double shear = s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
  f.deviatoric = std::sqrt(1.5 * (xx * xx + yy * yy + zz * zz + 2 * shear));
  return f;
}

}  // namespace

void add_stress_series(const Scene& scene, Observables& all) {
  const auto enclosure = enclosure_of(scene);
  if (!scene.observes_stress() || !enclosure) return;
  const bool space = scene.in_space();
  const auto figures = [enclosure, space](const Observation& now) {
    const double size = enclosure(now.world);
    return space ? mean_stress<ThreeD>(now.world, size) : mean_stress<TwoD>(now.world, size);
  };
  const auto part = [](std::size_t k) {
    return [k](const StressFigures& f) { return f.stress[k]; };
  };
  const char* as_xx = "as stress/xx";
  all.add(figures,
          {{"stress/xx", "Pa", "mean stress $\\sigma_{xx}$",
            space ? "Cauchy, mean over the volume between the tools, or of the cell; tension > 0"
                  : "Cauchy, mean over the area between the tools, or of the cell; tension > 0",
            part(0)},
           {"stress/yy", "Pa", "mean stress $\\sigma_{yy}$", as_xx, part(1)},
           {"stress/zz", "Pa", "mean stress $\\sigma_{zz}$", as_xx, part(2), space},
           {"stress/xy", "Pa", "mean stress $\\sigma_{xy}$", as_xx, part(3)},
           {"stress/yz", "Pa", "mean stress $\\sigma_{yz}$", as_xx, part(4), space},
           {"stress/zx", "Pa", "mean stress $\\sigma_{zx}$", as_xx, part(5), space},
           {"stress/mean", "Pa", "mean stress $\\sigma_m$",
            space ? "(xx + yy + zz) / 3: minus the pressure p"
                  : "(xx + yy + zz) / 3 over the same area: minus the pressure p",
            &StressFigures::mean},
           {"stress/zz", "Pa", "mean stress $\\sigma_{zz}$",
            "the same, normal to the plane of strain", part(2), !space},
           {"stress/deviatoric", "Pa", "deviatoric stress $q$",
            "von Mises' stress q of these means", &StressFigures::deviatoric}});
}

void add_stress_fields(const Scene& scene, FrameFields& all) {
  if (!scene.observes_stress()) return;
  const auto add = [&]<class D>(D) {
    using Stress = ParticleStress<D>;
    using Centre = ParticleCentre<D>;
    all.add({{{"particle_stress", "Pa", "stress of the particle $\\sigma$", Stress::info.meaning,
               FieldPlace::particle, Stress::count},
              by_number<Stress>},
             {{"particle_centre", "m", "centre of the particle $x$", Centre::info.meaning,
               FieldPlace::particle, Centre::count},
              by_number<Centre>}});
  };
  if (scene.in_space())
    add(ThreeD());
  else
    add(TwoD());
}

}  // namespace pulvis
