// plastic_force: Cauchy stress at every integration point, returned to the von Mises yield surface if it is
// outside; in one-point elements together with the hourglass stress; and the nodal forces.
//
// Source   systems/space/body/element_kernel.hpp, j2_kernel.hpp (Simo & Hughes 1998, box 9.1), j2_hourglass_kernel.hpp; laws:
//          systems/laws
// Runs     after integrate of the previous step
// Active   if a material of the scene has a yield stress
// Watches  minimum det F of every particle, for element_health; residual of each return to the yield surface, for
//          return_health
#include <optional>

#include "systems/space/body/element_force.hpp"
#include "systems/space/body/j2_hourglass_kernel.hpp"

namespace pulvis::space {
namespace {

template <class F>
using CoupledOf =
    std::conditional_t<F::stabilised, kernels::CoupledHourglass<Packet>, kernels::Uncoupled>;

// ---- laws: the element loop is compiled for linear hardening, and for any other law -----------------------------
template <class F>
struct LinearRule {
  static constexpr bool iterated = false;
  pulvis::kernels::LinearHardening<Packet> law;

  Packet flow_stress(Packet eps) const { return law.flow_stress(eps); }
  kernels::Return<Packet> map(const kernels::TrialPoint<Packet>& at, Packet norm2,
                              CoupledOf<F>& coupled) const {
    return kernels::radial_return(at, norm2, law, coupled);
  }
  Packet work_beyond(Packet eps, Packet grown, Packet theta) const {
    return pulvis::kernels::work_beyond_hardening(law, eps, grown, theta);
  }
};

template <class F>
struct AnyRule {
  static constexpr bool iterated = true;
  const void* law;
  Packet (*flow_stress_of)(const void*, Packet);
  kernels::Return<Packet> (*map_of)(const void*, const kernels::TrialPoint<Packet>&, Packet,
                                    CoupledOf<F>&);
  Packet (*work_beyond_of)(const void*, Packet, Packet, Packet);

  Packet flow_stress(Packet eps) const { return flow_stress_of(law, eps); }
  kernels::Return<Packet> map(const kernels::TrialPoint<Packet>& at, Packet norm2,
                              CoupledOf<F>& coupled) const {
    return map_of(law, at, norm2, coupled);
  }
  Packet work_beyond(Packet eps, Packet grown, Packet theta) const {
    return work_beyond_of(law, eps, grown, theta);
  }
};

template <class F, class Law>
AnyRule<F> any_rule(const Law& law) {
  return {&law,
          [](const void* p, Packet eps) { return static_cast<const Law*>(p)->flow_stress(eps); },
          [](const void* p, const kernels::TrialPoint<Packet>& at, Packet norm2,
             CoupledOf<F>& coupled) {
            return kernels::radial_return(at, norm2, *static_cast<const Law*>(p), coupled);
          },
          [](const void* p, Packet eps, Packet grown, Packet theta) {
            return pulvis::kernels::work_beyond_hardening(*static_cast<const Law*>(p), eps, grown,
                                                          theta);
          }};
}

// ---- the material -------------------------------------------------------------------------------------------
// Sums over the elements of a packet of particles.
struct PacketSums {
  Packet hourglass_work{}, beyond_hardening{};  // J
  Packet residual{}, element = -1;              // of the worst return
};

// NaN counts as worse than any number.
void keep_worst_return(Packet residual, Row<Element> e, PacketSums& sums) {
  const Packet::Mask worse =
      ~(abs(residual) <= abs(sums.residual)) & (sums.residual == sums.residual);
  sums.residual = select(worse, residual, sums.residual);
  sums.element = select(worse, e.value, sums.element);
}

template <class F, class Rule>
struct PlasticMaterial {
  WritePart<CpInverse<ThreeD, F::points>> cp_inverse;
  WritePart<PlasticStrain<F::points>> strain;
  std::optional<WritePart<PlasticHourglass<ThreeD>>> hourglass;
  Packet mu, inv_mu;
  Rule rule;
  PacketSums sums;

  kernels::Symmetric3<Packet> left(const kernels::Matrix3<Packet>& f, Row<Element> e, int g) const {
    return kernels::left_cauchy_green(f, cp_inverse_at(cp_inverse, e, g));
  }
  void remove_plastic(Row<Element> e, kernels::Hourglass<Packet>& of) const {
    of = kernels::each_number(of, hourglass_at(*hourglass, e),
                              [](Packet a, Packet b) { return a - b; });
  }

  void flow(const PointAt& at, kernels::Deviator<Packet>& s) {
    const Packet limit = rule.flow_stress(strain(at.element, at.g)), norm2 = squared_norm(s);
    if (!any(norm2 > (2.0 / 3.0) * limit * limit)) return;
    kernels::Uncoupled alone;
    if constexpr (!F::stabilised) return_point(at, s, norm2, alone);
  }

  void flow(const PointAt& at, kernels::Deviator<Packet>& s, kernels::Hourglass<Packet>& stress,
            const kernels::Hourglass<Packet>& elastic) {
    const Packet limit = rule.flow_stress(strain(at.element, 0)), norm2 = squared_norm(s);
    const Packet limit2 = (2.0 / 3.0) * limit * limit, t2 = kernels::hourglass_norm2(stress);
    if (!any(norm2 + t2 > limit2)) return;
    const Packet energy2 = kernels::hourglass_product(stress, elastic);
    auto coupled = kernels::coupled_hourglass(t2, energy2, mu, limit2);
    if constexpr (F::stabilised) {
      const Packet counted = return_point(at, s, norm2, coupled);
      keep_hourglass(at, stress, elastic, coupled.retained, energy2, counted);
    }
  }

 private:
  // Returns the work that it counts for the hourglass modes, over theirs: as if they were part of the deviator, whose modulus
  // is m mu/J, and whose work is per deformed volume.
  template <class Coupled>
  Packet return_point(const PointAt& at, kernels::Deviator<Packet>& s, Packet norm2,
                      Coupled& coupled) {
    const Packet before = strain(at.element, at.g);
    const auto r = rule.map({s, before, mu * at.inv_j, at.j * inv_mu}, norm2, coupled);
    s = scaled(s, r.beta);
    store(cp_inverse, at.element, at.g,
          kernels::returned_cp_inverse(cp_inverse_at(cp_inverse, at.element, at.g), r, at.adj,
                                       at.r2));
    strain(at.element, at.g) = r.eps;
    const Packet of_volume = at.j * r.work;
    sums.beyond_hardening += at.volume * rule.work_beyond(before, r.eps - before, of_volume);
    if constexpr (Rule::iterated) keep_worst_return(r.residual, at.element, sums);
    return of_volume * (at.j / r.mean);
  }

  // Keeps the fraction `retained` of the hourglass stress; the rest of its strain has become plastic.
  void keep_hourglass(const PointAt& at, kernels::Hourglass<Packet>& stress,
                      const kernels::Hourglass<Packet>& elastic, Packet retained, Packet energy2,
                      Packet counted) {
    const Packet lost = 1.0 - retained;
    store(*hourglass, at.element,
          kernels::each_number(hourglass_at(*hourglass, at.element), elastic,
                               [&](Packet p, Packet e) { return fma(lost, e, p); }));
    stress = kernels::each_number(stress, stress, [&](Packet m, Packet) { return retained * m; });
    const Packet spent = (at.volume * energy2) * (retained * lost);
    sums.hourglass_work += spent;
    sums.beyond_hardening = fma(1.0 - counted, spent, sums.beyond_hardening);
  }
};

// What the parts of a chunk need in addition to their law.
template <class F>
struct ChunkAt {
  const plastic_force<F>& system;
  BusyChunk chunk;
  const Shape& shape;
};

void add_sums(const PacketSums& sums, const auto& work, Chunk chunk, int part) {
  const Row<Particle> particle;
  if (const auto& hourglass = work.hourglass)
    part_of(hourglass->chunk(chunk), part)(particle) += sums.hourglass_work;
  part_of(work.beyond.chunk(chunk), part)(particle) += sums.beyond_hardening;
  if (const auto& residual = work.residual) {
    const auto worst = part_of(residual->chunk(chunk), part);
    worst(particle, 0) = sums.residual;
    worst(particle, 1) = sums.element;
  }
}

template <class F, class Rule>
void flow_part(const ChunkAt<F>& at, int part, const Rule& rule) {
  const plastic_force<F>& system = at.system;
  const auto views =
      force_views<F>(system.position, system.elastic, system.results, at.chunk, part);
  PlasticMaterial<F, Rule> material{part_of(system.state.cp_inverse.chunk(at.chunk), part),
                                    part_of(system.state.strain.chunk(at.chunk), part),
                                    std::nullopt,
                                    views.mu,
                                    views.inv_mu,
                                    rule,
                                    {}};
  if constexpr (F::stabilised)
    material.hourglass = part_of(system.state.hourglass->chunk(at.chunk), part);
  part_force(at.chunk, part, at.shape, views, system.results.worst, material);
  add_sums(material.sums, system.work, at.chunk, part);
}

template <class F>
[[gnu::flatten]] void flow_by_line(const ChunkAt<F>& at, int part,
                                   const pulvis::kernels::LinearHardening<Packet>& line) {
  flow_part(at, part, LinearRule<F>{line});
}
template <class F>
[[gnu::flatten, gnu::noinline]] void flow_by_any(const ChunkAt<F>& at, int part,
                                                 const AnyRule<F>& rule) {
  flow_part(at, part, rule);
}

}  // namespace

template <class F>
void plastic_force<F>::operator()(BusyChunk chunk) const {
  const Row<Particle> particle;
  const ChunkAt<F> at{*this, chunk, bodies.shape_of(chunk)};
  for (int part = 0; part < parts_of_a_lane; ++part) {
    const pulvis::kernels::LinearHardening<Packet> line{
        part_of(flow.yield_stress.chunk(chunk), part)(particle),
        part_of(flow.hardening.chunk(chunk), part)(particle)};
    if (!flow.laws) {
      flow_by_line(at, part, line);
      continue;
    }
    with_law((*flow.laws)->of_chunk(*bodies.bodies, chunk), line, 1 / clock->dt_before,
             [&](const auto& law) { flow_by_any(at, part, any_rule<F>(law)); });
  }
}
template struct plastic_force<OnePoint>;
template struct plastic_force<EightPoint>;

}  // namespace pulvis::space
