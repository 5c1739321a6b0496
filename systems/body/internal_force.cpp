// internal_force: nodal forces from the stresses.
//
// Source   systems/body/element_kernel.hpp. Mean dilatation: the deviator acts pointwise, scaled by theta/J to
//          the Kirchhoff stress of the point, the mean stress on the element's area. Otherwise Cauchy stress
//          acts at every point; with one point also the bending of systems/body/hourglass_kernel.hpp. All are
//          the exact derivative of the element's stored energy
// Runs     after the stresses are final, before integrate
#include "engine/entry.hpp"
#include "systems/body/element_access.hpp"
#include "systems/body/hourglass_kernel.hpp"
#include "systems/body/systems.hpp"

namespace pulvis {
namespace {

using Map = kernels::QuadMap<Packet>;
using Flux = kernels::QuadFlux<Packet>;

struct Bending {
  ReadPart<HourglassStress> stress;
  Packet mu;
  bool near_inversion;  // some corner of the elements is about to fold over
};

template <class F>
struct Views {
  ReadPart<DeviatoricStress<TwoD, F::points>> s;
  ReadPart<MeanStress<F::volumes>> p;
  const Bending* bending;  // null: not stabilised
};

Flux stress_flux(const Views<FourPoint>& v, const Map& map, const Shape& shape, Row<Element> e) {
  const auto& points = points_of<4>(shape, e.value);
  const Packet theta = mean_dilatation(map, points), mean = v.p(e);
  kernels::Matrix2<Packet> gradient[4];
  Packet now[4];
  for (int g = 0; g < 4; ++g) {
    gradient[g] = map_gradient<4>(map, g);
    now[g] = determinant(gradient[g]);
  }
  // One division for two points: it is the most expensive operation of the loop.
  const Packet over[2] = {theta / (now[0] * now[1]), theta / (now[2] * now[3])};
  Flux flux;
  for (int g = 0; g < 4; ++g) {
    const auto& a = gradient[g];
    const Packet kirchhoff = over[g / 2] * now[g ^ 1] * entry(points, g).determinant;
    const auto d = deviator(v.s, e, g);
    kernels::add_flux(flux, a, kirchhoff * d.xx + mean, kirchhoff * d.yy + mean, kirchhoff * d.xy,
                      kernels::gauss_xi[g], kernels::gauss_eta[g]);
  }
  return flux;
}

Flux stress_flux(const Views<Standard>& v, const Map& map, const Shape&, Row<Element> e) {
  Flux flux;
  for (int g = 0; g < 4; ++g) {
    const auto d = deviator(v.s, e, g);
    kernels::add_flux(flux, map_gradient<4>(map, g), d.xx + v.p(e, g), d.yy + v.p(e, g), d.xy,
                      kernels::gauss_xi[g], kernels::gauss_eta[g]);
  }
  return flux;
}

Flux stress_flux(const Views<OnePoint>& v, const kernels::FourfoldMap<Packet>& map,
                 const Shape& shape, Row<Element> e) {
  const auto a = map_gradient<1>(map, 0);
  const auto d = deviator(v.s, e, 0);
  const Packet mean = v.p(e);
  // The fourfold map represents the four quarters of (xi, eta).
  auto flux = kernels::central_flux(a, d.xx + mean, d.yy + mean, d.xy);
  const Packet inv_det = 1.0 / determinant(a);
  const auto& reference = entry(shape.hourglass, e.value);
  const double area = 4 * points_of<1>(shape, e.value)[0].determinant;  // times scale / inv_det
  const auto w = kernels::natural_hourglass(map, inv_det);
  auto moment = kernels::bending_moment<Packet>({v.bending->stress(e, 0), v.bending->stress(e, 1)},
                                                reference, (1.0 / 3.0) * area);
  if (v.bending->near_inversion) {
    const auto more = kernels::inversion_barrier_moment(kernels::corner_ratios(w, reference),
                                                        reference, area * v.bending->mu);
    moment.one += more.one;
    moment.two += more.two;
  }
  kernels::add_hourglass_flux(flux, map, w, inv_det, moment);
  return flux;
}

template <class F>
void part_force(BusyChunk chunk, const Views<F>& views, const ReadPart<Position<TwoD>>& x,
                const WritePart<InternalForce<TwoD>>& f, const Shape& shape, double thickness) {
  for (int n = 0; n < static_cast<int>(shape.nodes.size()); ++n)
    f(Row<Node>(n), 0) = f(Row<Node>(n), 1) = Packet{};

  chunk.for_elements(shape.elements(), [&](int i) {
    const Quad& quad = entry(shape.quads, i);
    const auto flux = stress_flux(views, quad_map<F::points>(x, quad), shape, Row<Element>(i));
    const auto out = kernels::node_forces(flux, 0.25 * thickness);
    for (std::size_t k = 0; k < 4; ++k) {
      f(quad[k], 0) += out.x[k];
      f(quad[k], 1) += out.y[k];
    }
  });
}

}  // namespace

template <class F>
[[gnu::flatten]] void internal_force<F>::operator()(BusyChunk chunk) const {
  const Shape& shape = bodies->shape_of_chunk(chunk);
  for (int part = 0; part < parts_of_a_lane; ++part) {
    Views<F> views{part_of(stress.deviator.chunk(chunk), part),
                   part_of(stress.mean.chunk(chunk), part), nullptr};
    const auto x = part_of(position.chunk(chunk), part);
    const auto f = part_of(force.chunk(chunk), part);
    if constexpr (F::stabilised) {
      const Row<Particle> particle;
      const Packet corner = part_of(bending->min_corner.chunk(chunk), part)(particle);
      const Bending modes{part_of(bending->stress.chunk(chunk), part),
                          part_of(shear.chunk(chunk), part)(particle),
                          any(corner < kernels::barrier_ratio)};
      views.bending = &modes;
      part_force(chunk, views, x, f, shape, bodies->thickness);
    } else {
      part_force(chunk, views, x, f, shape, bodies->thickness);
    }
  }
}
template struct internal_force<FourPoint>;
template struct internal_force<Standard>;
template struct internal_force<OnePoint>;

}  // namespace pulvis
