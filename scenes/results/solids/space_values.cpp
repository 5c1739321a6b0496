#include "scenes/results/solids/space_values.hpp"

#include <array>
#include <cmath>

#include "components/body.hpp"
#include "components/shape.hpp"
#include "components/space/formulation.hpp"
#include "components/space/shape.hpp"
#include "engine/access.hpp"
#include "scenes/results/parts/mesh_rows.hpp"

namespace pulvis::space {
namespace {

const Shape& shape_in(const World& world, int slot) {
  return entry(world.resource<Shapes>().list, entry(world.resource<Bodies>().slots, slot).shape);
}

struct ElementStresses {
  std::array<double, 6> stress{};  // xx yy zz xy yz zx
  double effective = 0, pressure = 0;
};

// Means over an element's points: deviatoric and mean stress; values are `lane_count` apart.
template <int points>
ElementStresses stresses_of(const double* s, double mean_stress) {
  ElementStresses mean;
  for (int g = 0; g < points; ++g, s += 5 * lane_count) {
    const double xx = s[0], yy = s[lane_count], xy = s[2 * lane_count], yz = s[3 * lane_count],
                 zx = s[4 * lane_count], zz = -(xx + yy);
    const std::array<double, 6> here{xx, yy, zz, xy, yz, zx};
    for (std::size_t k = 0; k < 6; ++k) mean.stress[k] += here[k] / points;
    mean.effective +=
        std::sqrt(1.5 * (xx * xx + yy * yy + zz * zz + 2 * (xy * xy + yz * yz + zx * zx))) / points;
  }
  for (std::size_t k = 0; k < 3; ++k) mean.stress[k] += mean_stress;
  mean.pressure = -mean_stress;
  return mean;
}

template <class F, class Append>
ParticleValues of_stress(const Append& append) {
  return [append](const World& world, int slot, std::vector<double>& out) {
    const double* deviator = first_value<DeviatoricStress<ThreeD, F::points>>(world, slot);
    const double* mean = first_value<MeanStress<1>>(world, slot);
    const std::size_t count = shape_in(world, slot).hexahedra.size();
    for (std::size_t e = 0; e < count; ++e)
      append(
          stresses_of<F::points>(deviator + e * 5 * F::points * lane_count, mean[e * lane_count]),
          out);
  };
}

template <class F>
void plastic_strain(const World& world, int slot, std::vector<double>& out) {
  const double* strain = first_value<PlasticStrain<F::points>>(world, slot);
  const std::size_t count = shape_in(world, slot).hexahedra.size();
  for (std::size_t e = 0; e < count; ++e) {
    double sum = 0;
    for (int g = 0; g < F::points; ++g)
      sum += strain[(e * F::points + static_cast<std::size_t>(g)) * lane_count];
    out.push_back(sum / F::points);
  }
}

template <class F>
std::vector<MeshField> fields_of(const World& world) {
  using Out = std::vector<double>;
  return mesh_rows<ThreeD>(
      {.effective =
           of_stress<F>([](const ElementStresses& s, Out& out) { out.push_back(s.effective); }),
       .pressure =
           of_stress<F>([](const ElementStresses& s, Out& out) { out.push_back(s.pressure); }),
       .stress = of_stress<F>([](const ElementStresses& s, Out& out) {
         out.insert(out.end(), s.stress.begin(), s.stress.end());
       }),
       .plastic_strain = world.has<PlasticStrain<F::points>>() ? ParticleValues(plastic_strain<F>)
                                                               : ParticleValues()});
}

}  // namespace

std::vector<MeshField> mesh_fields(const World& world) {
  return with_hexahedra(world.resource<Bodies>().formulation,
                        [&]<class F>(F) { return fields_of<F>(world); });
}

}  // namespace pulvis::space
