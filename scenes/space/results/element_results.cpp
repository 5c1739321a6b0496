#include "scenes/space/results/element_results.hpp"

#include <array>
#include <cmath>

#include "components/space/body.hpp"
#include "components/space/formulation.hpp"
#include "engine/access.hpp"
#include "scenes/space/results/visit_particles.hpp"

namespace pulvis::space {
namespace {

// The element columns of whichever formulation the scene has.
struct StressColumns {
  const Lane* deviator;
  const Lane* mean;
  const Lane* plastic_strain;  // null: elastic
  int points;
};
template <class F>
StressColumns stress_columns_of(const World& world) {
  const bool plastic = world.has<PlasticStrain<F::points>>();
  return {world.column<DeviatoricStress<F::points>>().lanes(), world.column<MeanStress>().lanes(),
          plastic ? world.column<PlasticStrain<F::points>>().lanes() : nullptr, F::points};
}
StressColumns stress_columns(const World& world) {
  return with_hexahedra(world.resource<Bodies>().formulation,
                        [&]<class F>(F) { return stress_columns_of<F>(world); });
}

struct ElementStresses {
  std::array<double, 6> stress{};  // xx yy zz xy yz zx
  double effective = 0;
};

// Means over the points of an element.
ElementStresses stresses_of(const StressColumns& columns, std::size_t e, int lane) {
  ElementStresses mean;
  const Lane* s = columns.deviator + e * static_cast<std::size_t>(5 * columns.points);
  const double points = columns.points;
  for (int g = 0; g < columns.points; ++g, s += 5) {
    const double xx = s[0][lane], yy = s[1][lane], xy = s[2][lane], yz = s[3][lane],
                 zx = s[4][lane], zz = -(xx + yy);
    const std::array<double, 6> here{xx, yy, zz, xy, yz, zx};
    for (std::size_t k = 0; k < 6; ++k) mean.stress[k] += here[k] / points;
    mean.effective +=
        std::sqrt(1.5 * (xx * xx + yy * yy + zz * zz + 2 * (xy * xy + yz * yz + zx * zx))) / points;
  }
  for (std::size_t k = 0; k < 3; ++k) mean.stress[k] += columns.mean[e][lane];
  return mean;
}

double mean_strain(const StressColumns& columns, std::size_t e, int lane) {
  double sum = 0;
  for (int g = 0; g < columns.points; ++g)
    sum += columns.plastic_strain[e * static_cast<std::size_t>(columns.points) +
                                  static_cast<std::size_t>(g)][lane];
  return sum / columns.points;
}

}  // namespace

bool is_plastic(const World& world) { return stress_columns(world).plastic_strain != nullptr; }

void append_element_fields(const World& world, std::vector<std::vector<double>>& fields) {
  const StressColumns columns = stress_columns(world);
  std::vector<double> effective, pressure, stress, strain;
  visit_particles<Element>(world, [&](std::size_t first, int lane, const Shape& shape) {
    for (std::size_t e = first; e < first + shape.hexahedra.size(); ++e) {
      const ElementStresses mean = stresses_of(columns, e, lane);
      effective.push_back(mean.effective);
      pressure.push_back(-columns.mean[e][lane]);
      stress.insert(stress.end(), mean.stress.begin(), mean.stress.end());
      if (columns.plastic_strain != nullptr) strain.push_back(mean_strain(columns, e, lane));
    }
  });
  fields.insert(fields.end(), {effective, pressure, stress});
  if (columns.plastic_strain != nullptr) fields.push_back(strain);
}

}  // namespace pulvis::space
