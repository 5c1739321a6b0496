// j2_return_map: returns trial stresses outside the von Mises yield surface to it; in one-point elements
// together with the stress of the hourglass modes.
//
// Source   systems/body/j2_kernel.hpp (Simo & Hughes 1998, box 9.1); systems/body/j2_bending_kernel.hpp; laws:
//          systems/laws
// Runs     after trial_stress, before internal_force
// Active   when a material of the scene declares a yield stress
// Watches  the residual of each return on the yield surface, for return_health
#include "systems/body/element_access.hpp"
#include "systems/body/j2_bending_kernel.hpp"
#include "systems/body/systems.hpp"

namespace pulvis {
namespace {

// Sums over the elements of a packet of particles.
struct PacketSums {
  Packet hourglass_work{};          // J/m
  Packet beyond_hardening{};        // J/m
  Packet residual{}, element = -1;  // of the worst return
};

template <class F, class Law>
struct Views {
  ReadPart<Position<TwoD>> x;
  ReadPart<IsochoricScale<F::points>> scale;
  WritePart<DeviatoricStress<TwoD, F::points>> stress;
  WritePart<CpInverse<TwoD, F::points>> cp_inverse;
  WritePart<PlasticStrain<F::points>> strain;
  Packet mu, inv_mu;
  Law law;
};

// NaN ranks worst.
void keep_worst(Packet residual, Row<Element> e, PacketSums& sums) {
  const Packet::Mask worse =
      ~(abs(residual) <= abs(sums.residual)) & (sums.residual == sums.residual);
  sums.residual = select(worse, residual, sums.residual);
  sums.element = select(worse, e.value, sums.element);
}

struct PointKinematics {
  kernels::Matrix2<Packet> f;
  Packet theta, mu_over_theta;
  double area;  // m^2, undeformed
};

// Returns the work that it counts for bending that flows with the deviator, over the bending's own: as if it were part of the
// deviator, whose modulus is that of the material times mean/theta, and whose work is per deformed volume.
template <class F, class Law, class Coupled>
Packet return_point(const Views<F, Law>& v, Row<Element> e, int g, const PointKinematics& at,
                    PacketSums& sums, Coupled&& coupled) {
  const Packet r = v.scale(e, g), before = v.strain(e, g);
  const auto next = kernels::radial_return<Packet>(
      {deviator(v.stress, e, g), cp_inverse_at(v.cp_inverse, e, g), before}, at.f, r * r,
      at.mu_over_theta, at.theta * v.inv_mu, v.law, coupled);
  store(v.stress, e, g, next.s);
  v.cp_inverse(e, 4 * g) = next.c.xx;
  v.cp_inverse(e, 4 * g + 1) = next.c.yy;
  v.cp_inverse(e, 4 * g + 2) = next.c.zz;
  v.cp_inverse(e, 4 * g + 3) = next.c.xy;
  v.strain(e, g) = next.eps;
  const Packet of_volume = at.theta * next.work;
  sums.beyond_hardening +=
      at.area * kernels::work_beyond_hardening(v.law, before, next.eps - before, of_volume);
  if constexpr (!kernels::is_closed_form<Law>) keep_worst(next.residual, e, sums);
  return of_volume * (at.theta / next.mean);
}

template <class F, class Law>
void return_element(const Views<F, Law>& v, const Shape& shape, Row<Element> e, PacketSums& sums) {
  Packet::Mask flows[F::points], some = Packet::Mask::of(0);
  for (int g = 0; g < F::points; ++g) {
    flows[g] = kernels::yields(deviator(v.stress, e, g), v.strain(e, g), v.law);
    some = some | flows[g];
  }
  if (!any(some)) return;

  const auto map = quad_map<F::points>(v.x, shape.quads[static_cast<std::size_t>(e.value)]);
  const auto& points = points_of<F::points>(shape, e.value);
  Packet theta = mean_dilatation(map, points);
  Packet mu_over_theta = v.mu / theta;
  for (int g = 0; g < F::points; ++g) {
    if (!any(flows[g])) continue;
    const auto& point = points[static_cast<std::size_t>(g)];
    const auto f =
        kernels::deformation_gradient(map_gradient<F::points>(map, g), point.inverse_jacobian);
    if constexpr (F::volumes == F::points) {
      theta = determinant(f);
      mu_over_theta = v.mu / theta;
    }
    return_point(v, e, g, {f, theta, mu_over_theta, point.determinant}, sums, kernels::Uncoupled{});
  }
}

// ---- one point: the hourglass stress is returned with the deviator ---------------------------------
struct Bending {
  WritePart<HourglassStress> stress;
  WritePart<PlasticHourglass<TwoD>> plastic;
  Packet softness, stiffness, inv_modulus;
};

// Keeps the share `retained` of the bending stress; the rest has become plastic. Returns the work dissipated
// in the hourglass modes, J/m.
Packet keep_bending(const Bending& bending, Row<Element> e,
                    const kernels::Hourglass<Packet>& stress, Packet retained, double area) {
  const Packet plastic_share = fma(-retained, bending.inv_modulus, bending.inv_modulus);
  bending.plastic(e, 0) = fma(plastic_share, stress.one, bending.plastic(e, 0));
  bending.plastic(e, 1) = fma(plastic_share, stress.two, bending.plastic(e, 1));
  bending.stress(e, 0) = retained * stress.one;
  bending.stress(e, 1) = retained * stress.two;
  return ((1.0 / 3.0) * area) * (retained * plastic_share) *
         fma(stress.one, stress.one, stress.two * stress.two);
}

template <class Law>
void return_element(const Views<OnePoint, Law>& v, const Bending& bending, const Shape& shape,
                    Row<Element> e, PacketSums& sums) {
  const auto s = deviator(v.stress, e, 0);
  const kernels::Hourglass<Packet> m{bending.stress(e, 0), bending.stress(e, 1)};
  const Packet yield = v.law.flow_stress(v.strain(e)), limit2 = (2.0 / 3.0) * yield * yield;
  if (!any(kernels::may_yield(s, m, limit2))) return;

  const auto map = quad_map<1>(v.x, shape.quads[static_cast<std::size_t>(e.value)]);
  kernels::CoupledBending<Packet> coupled{m, bending.softness, bending.stiffness,
                                          kernels::inverse_width(map, s, limit2), 1.0};
  if (!any(kernels::yields(s, v.strain(e), v.law, coupled))) return;
  const auto& point = shape.centre[static_cast<std::size_t>(e.value)][0];
  const auto f = kernels::deformation_gradient(map_gradient<1>(map, 0), point.inverse_jacobian);
  const Packet r = v.scale(e);  // theta = det F: 1/theta is its cube
  const Packet counted = return_point(
      v, e, 0, {f, determinant(f), v.mu * (r * r * r), point.determinant}, sums, coupled);
  const Packet spent = keep_bending(bending, e, m, coupled.retained, point.determinant);
  sums.hourglass_work += spent;
  sums.beyond_hardening = fma(1.0 - counted, spent, sums.beyond_hardening);
}

}  // namespace

template <class F>
[[gnu::flatten]] void j2_return_map<F>::operator()(BusyChunk chunk) const {
  const Row<Particle> particle;
  const Shape& shape = bodies->shape_of_chunk(chunk);
  const auto constant = [&](const auto& column, int part) {
    return part_of(column.chunk(chunk), part)(particle);
  };
  for (int part = 0; part < parts_of_a_lane; ++part) {
    const Packet mu = constant(elastic.shear, part);
    PacketSums sums;
    const auto return_part = [&]<class Law>(const Law& law) {
      const Views<F, Law> v{part_of(position.chunk(chunk), part),
                            part_of(points.isochoric.chunk(chunk), part),
                            part_of(points.deviator.chunk(chunk), part),
                            part_of(points.cp_inverse.chunk(chunk), part),
                            part_of(points.strain.chunk(chunk), part),
                            mu,
                            1.0 / mu,
                            law};
      if constexpr (F::stabilised) {
        const Packet modulus = kernels::plane_strain_modulus(mu, constant(elastic.bulk, part));
        const Bending bending{part_of(hourglass->stress.chunk(chunk), part),
                              part_of(hourglass->plastic.chunk(chunk), part),
                              (1.0 / 3.0) * modulus / mu, 3.0 * mu / modulus, 1.0 / modulus};
        chunk.for_elements(shape.elements(), [&](int i) {
          return_element(v, bending, shape, Row<Element>(i), sums);
        });
      } else {
        chunk.for_elements(shape.elements(),
                           [&](int i) { return_element(v, shape, Row<Element>(i), sums); });
      }
    };
    const kernels::LinearHardening<Packet> linear{constant(flow.yield_stress, part),
                                                  constant(flow.hardening, part)};
    if (flow.laws)
      with_law((*flow.laws)->of_chunk(*bodies, chunk), linear, 1 / clock->dt_before, return_part);
    else
      return_part(linear);
    if constexpr (F::stabilised)
      part_of(hourglass->work.chunk(chunk), part)(particle) +=
          sums.hourglass_work * bodies->thickness;
    part_of(work.beyond.chunk(chunk), part)(particle) += sums.beyond_hardening * bodies->thickness;
    if (const auto& residual = work.residual) {
      const auto worst = part_of(residual->chunk(chunk), part);
      worst(particle, 0) = sums.residual;
      worst(particle, 1) = sums.element;
    }
  }
}
template struct j2_return_map<FourPoint>;
template struct j2_return_map<Standard>;
template struct j2_return_map<OnePoint>;

}  // namespace pulvis
