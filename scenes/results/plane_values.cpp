#include "scenes/results/plane_values.hpp"

#include <array>
#include <cmath>

#include "components/body.hpp"
#include "components/shape.hpp"
#include "engine/access.hpp"
#include "scenes/results/parts/mesh_rows.hpp"

namespace pulvis {
namespace {

struct CellStress {
  double xx = 0, yy = 0, zz = 0, xy = 0, effective = 0, pressure = 0;
};

// Values of one particle, in the element columns of formulation F; they are `lane_count` apart.
template <class F>
class Elements {
 public:
  Elements(const World& world, int slot)
      : deviator_(first_value<DeviatoricStress<TwoD, F::points>>(world, slot)),
        mean_stress_(first_value<MeanStress<F::volumes>>(world, slot)) {}

  // Mean over the points of an element; the effective stress is the mean of the pointwise values.
  CellStress stress(std::size_t e) const {
    CellStress c;
    const double* s = deviator_ + e * 3 * F::points * lane_count;
    for (int g = 0; g < F::points; ++g, s += 3 * lane_count) {
      const double xx = s[0], yy = s[lane_count], xy = s[2 * lane_count];
      const double zz = -(xx + yy);
      c.xx += xx / F::points;
      c.yy += yy / F::points;
      c.zz += zz / F::points;
      c.xy += xy / F::points;
      c.effective += std::sqrt(1.5 * (xx * xx + yy * yy + zz * zz + 2 * xy * xy)) / F::points;
    }
    const double mean = mean_of(mean_stress_ + e * F::volumes * lane_count, F::volumes);
    c.xx += mean;
    c.yy += mean;
    c.zz += mean;
    c.pressure = -mean;
    return c;
  }

  static double mean_of(const double* values, int count) {
    double sum = 0;
    for (int i = 0; i < count; ++i) sum += values[i * lane_count];
    return sum / count;
  }

 private:
  const double* deviator_;
  const double* mean_stress_;
};

// Calls `append` with every element's stress.
template <class F, class Append>
ParticleValues of_stress(const Append& append) {
  return [append](const World& world, int slot, std::vector<double>& out) {
    const Elements<F> elements(world, slot);
    const std::size_t count = world.resource<Bodies>().shape_of_slot(slot).quads.size();
    for (std::size_t e = 0; e < count; ++e) append(elements.stress(e), out);
  };
}

template <class F>
void plastic_strain(const World& world, int slot, std::vector<double>& out) {
  const double* strain = first_value<PlasticStrain<F::points>>(world, slot);
  const std::size_t count = world.resource<Bodies>().shape_of_slot(slot).quads.size();
  for (std::size_t e = 0; e < count; ++e)
    out.push_back(Elements<F>::mean_of(strain + e * F::points * lane_count, F::points));
}

template <class F>
std::vector<MeshField> fields_of(const World& world) {
  using Out = std::vector<double>;
  return mesh_rows<TwoD>(
      {.effective = of_stress<F>([](const CellStress& s, Out& out) { out.push_back(s.effective); }),
       .pressure = of_stress<F>([](const CellStress& s, Out& out) { out.push_back(s.pressure); }),
       .stress = of_stress<F>([](const CellStress& s, Out& out) {
         out.insert(out.end(), {s.xx, s.yy, s.zz, s.xy});
       }),
       .plastic_strain = world.has<PlasticStrain<F::points>>() ? ParticleValues(plastic_strain<F>)
                                                               : ParticleValues()});
}

}  // namespace

std::vector<MeshField> plane_mesh_fields(const World& world) {
  return with_formulation(world.resource<Bodies>().formulation,
                          [&]<class F>(F) { return fields_of<F>(world); });
}

}  // namespace pulvis
