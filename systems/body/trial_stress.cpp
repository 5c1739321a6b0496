// trial_stress: Cauchy stress at every point of an element as if there were no plastic flow in this step.
// elastic_stress: the same for scenes without plasticity, where it is the final stress.
//
// Source   systems/body/element_kernel.hpp, systems/body/j2_kernel.hpp; hourglass stress of one-point elements:
//          systems/body/hourglass_kernel.hpp
// Runs     after integrate of the previous step; before j2_return_map and internal_force
// Watches  minimum det F of every particle, for the health system
#include <optional>

#include "engine/entry.hpp"
#include "systems/body/element_access.hpp"
#include "systems/body/hourglass_kernel.hpp"
#include "systems/body/systems.hpp"

namespace pulvis {
namespace {

template <class F>
struct Views {
  ReadPart<Position<TwoD>> x;
  WritePart<DeviatoricStress<TwoD, F::points>> s;
  WritePart<MeanStress<F::volumes>> p;
  Packet mu, bulk;
};

template <class F>
Views<F> views_of(const Read<Position<TwoD>>& position, const ElementStress<Write, F>& stress,
                  const Elasticity& elastic, Chunk chunk, int part) {
  const Row<Particle> particle;
  return {part_of(position.chunk(chunk), part), part_of(stress.deviator.chunk(chunk), part),
          part_of(stress.mean.chunk(chunk), part),
          part_of(elastic.shear.chunk(chunk)(particle), part),
          part_of(elastic.bulk.chunk(chunk)(particle), part)};
}

// One-point elements: the trial stress of their hourglass modes, with the plastic part `plastic_bending`.
struct HourglassViews {
  WritePart<HourglassStress> stress;
  const ReadPart<PlasticHourglass<TwoD>>* plastic_bending;  // null: elastic
  Packet modulus;
  Packet min_corner;  // over the elements so far
};

// Returns the minimum det F at the Gauss points that a four-point element would have, over theta: it detects
// a folded element.
Packet hourglass_stress(HourglassViews& v, const kernels::FourfoldMap<Packet>& map, Packet inv_det,
                        const Shape::Hourglass& reference, Row<Element> e) {
  const auto w = kernels::natural_hourglass(map, inv_det);
  auto strain = kernels::bending_strain(w, reference);
  if (v.plastic_bending != nullptr) {
    strain.one -= (*v.plastic_bending)(e, 0);
    strain.two -= (*v.plastic_bending)(e, 1);
  }
  v.stress(e, 0) = v.modulus * strain.one;
  v.stress(e, 1) = v.modulus * strain.two;
  const Packet corner = kernels::min_ratio(kernels::corner_ratios(w, reference));
  v.min_corner = min(corner, v.min_corner);
  return corner;
}

// `left(F, r, e, g)` gives F C_p^-1 F^T, with r = J^(-1/3). Returns the minimum det F over the element's points.
template <class F, class LeftCauchyGreen>
Packet element_stress(const Views<F>& v, HourglassViews* hourglass, const Shape& shape,
                      Row<Element> e, const LeftCauchyGreen& left) {
  const auto map = quad_map<F::points>(v.x, entry(shape.quads, e.value));
  const auto& points = points_of<F::points>(shape, e.value);
  Packet theta{}, inv_theta{}, minimum = 1e300;
  if constexpr (F::volumes < F::points) {
    theta = minimum = mean_dilatation(map, points);
    inv_theta = 1.0 / theta;
    v.p(e) = 0.5 * v.bulk * (theta - inv_theta);
  }
  for (int g = 0; g < F::points; ++g) {
    const auto& point = entry(points, g);
    const auto f =
        kernels::deformation_gradient(map_gradient<F::points>(map, g), point.inverse_jacobian);
    const Packet j = determinant(f);
    const Packet r = kernels::inverse_cube_root(j);
    const Packet r2 = r * r;
    if constexpr (F::volumes == F::points) {
      inv_theta = r2 * r;
      v.p(e, g) = 0.5 * v.bulk * (j - inv_theta);
    }
    store(v.s, e, g, kernels::scaled_deviator(left(f, r, e, g), v.mu * inv_theta * r2));
    minimum = min(j, minimum);
  }
  if constexpr (F::stabilised)
    minimum *= hourglass_stress(*hourglass, map, inv_theta * (0.25 / points[0].determinant),
                                entry(shape.hourglass, e.value), e);
  return minimum;
}

// A NaN wins every comparison and is not replaced by a later number, so that it is detected.
void keep_worst(Packet minimum, Row<Element> e, Packet& worst, Packet& worst_element) {
  const Packet::Mask lower = ~(minimum >= worst) & (worst == worst);
  worst_element = select(lower, e.value, worst_element);
  worst = select(lower, minimum, worst);
}

// `plastic_bending`: null for elastic material.
template <class F, class LeftCauchyGreen>
void part_stress(Chunk chunk, int part, const Bodies& bodies, const Views<F>& v,
                 const Optional<BendingModes<Write>>& bending,
                 const Optional<Read<PlasticHourglass<TwoD>>>* plastic_bending,
                 const WorstJacobian<Write>& worst_jacobian, const LeftCauchyGreen& left) {
  std::optional<ReadPart<PlasticHourglass<TwoD>>> plastic;
  std::optional<HourglassViews> hourglass;
  if constexpr (F::stabilised) {
    if (plastic_bending != nullptr) plastic = part_of((*plastic_bending)->chunk(chunk), part);
    hourglass = {part_of(bending->stress.chunk(chunk), part), plastic ? &*plastic : nullptr,
                 kernels::plane_strain_modulus(v.mu, v.bulk), 1e300};
  }
  const Shape& shape = bodies.shape_of_chunk(chunk);
  Packet worst = 1e300, which{};
  for (int i = 0; i < shape.elements(); ++i)
    keep_worst(
        element_stress<F>(v, hourglass ? &*hourglass : nullptr, shape, Row<Element>(i), left),
        Row<Element>(i), worst, which);
  const Row<Particle> particle;
  if constexpr (F::stabilised)
    part_of(bending->min_corner.chunk(chunk), part)(particle) = hourglass->min_corner;
  part_of(worst_jacobian.value.chunk(chunk), part)(particle) = worst;
  part_of(worst_jacobian.element.chunk(chunk), part)(particle) = which;
}

}  // namespace

template <class F>
[[gnu::flatten]] void trial_stress<F>::operator()(Chunk chunk) const {
  for (int part = 0; part < parts_of_a_lane; ++part) {
    const auto c = part_of(plastic.cp_inverse.chunk(chunk), part);
    const auto scale = part_of(plastic.isochoric.chunk(chunk), part);
    const auto left = [&](const kernels::Matrix2<Packet>& f, Packet r, Row<Element> e, int g) {
      scale(e, g) = r;
      return kernels::left_cauchy_green(f, cp_inverse_at(c, e, g));
    };
    part_stress<F>(chunk, part, *bodies, views_of<F>(position, stress, elastic, chunk, part),
                   bending, &plastic.hourglass, worst, left);
  }
}
template struct trial_stress<FourPoint>;
template struct trial_stress<Standard>;
template struct trial_stress<OnePoint>;

template <class F>
[[gnu::flatten]] void elastic_stress<F>::operator()(Chunk chunk) const {
  const auto left = [](const kernels::Matrix2<Packet>& f, Packet, Row<Element>, int) {
    return kernels::left_cauchy_green(f);
  };
  for (int part = 0; part < parts_of_a_lane; ++part)
    part_stress<F>(chunk, part, *bodies, views_of<F>(position, stress, elastic, chunk, part),
                   bending, nullptr, worst, left);
}
template struct elastic_stress<FourPoint>;
template struct elastic_stress<Standard>;
template struct elastic_stress<OnePoint>;

}  // namespace pulvis
