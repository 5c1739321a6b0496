// The flow laws of the materials. The resource exists only if one hardens nonlinearly or is rate-dependent.
#pragma once

#include <string>
#include <vector>

#include "components/shape.hpp"
#include "systems/laws/hardening.hpp"
#include "systems/laws/rate.hpp"

namespace pulvis {

struct FlowLaw {
  kernels::HardeningLaw hardening;
  kernels::RateLaw rate;
  std::string file = {};  // of a table, as named in the scene

  bool is_linear() const { return hardening.index() == 0 && rate.index() == 0; }
};

// "voce", "linear, cowper-symonds"
inline std::string name_of(const FlowLaw& law) {
  std::string name =
      std::visit([](const auto& own) { return std::string(own.name); }, law.hardening);
  std::visit(
      [&]<class Rate>(const Rate& own) {
        if constexpr (!std::is_same_v<Rate, kernels::NoRate>) name += std::string(", ") + own.name;
      },
      law.rate);
  return name;
}

struct FlowLaws {
  static constexpr const char* resource_name = "flow_laws";
  static constexpr bool fixed = true;
  std::vector<FlowLaw> of_material;  // of a solid: one per part

  // All particles of a chunk are of one class, hence of one material.
  const FlowLaw& of_chunk(const Bodies& bodies, Chunk chunk) const {
    return entry(of_material, entry(bodies.slots, chunk.index * lane_count).material);
  }
};

// Calls use(law) with the concrete type of the law: once per chunk, not per point. Linear hardening keeps its columns,
// where elastic particles have an infinite yield stress.
template <class T, class Use>
void with_hardening(const FlowLaw& law, const kernels::LinearHardening<T>& linear, const Use& use) {
  std::visit(
      [&]<class Law>(const Law& own) {
        if constexpr (std::is_same_v<Law, kernels::LinearHardening<double>>)
          use(linear);
        else
          use(own);
      },
      law.hardening);
}

// The same including the rate law, over a step of 1/over_dt. Kept out of its caller, which is fully inlined for linear
// hardening.
template <class T, class Use>
[[gnu::noinline]] void with_law(const FlowLaw& law, const kernels::LinearHardening<T>& linear,
                                double over_dt, const Use& use) {
  with_hardening(law, linear, [&](const auto& hardening) {
    std::visit(
        [&]<class Rate>(const Rate& rate) {
          if constexpr (std::is_same_v<Rate, kernels::NoRate>)
            use(hardening);
          else
            use(kernels::RatedHardening{hardening, rate, over_dt});
        },
        law.rate);
  });
}

}  // namespace pulvis
