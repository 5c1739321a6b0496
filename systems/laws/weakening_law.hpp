// The friction law of eight points from the numbers of their pairs, in two and in three dimensions.
#pragma once

#include <array>

#include "components/contact.hpp"
#include "components/run_state.hpp"
#include "engine/lane.hpp"
#include "systems/laws/friction.hpp"

namespace pulvis {

// The numbers of a pair besides the Coulomb coefficient, in the order of FrictionMore::Number.
inline constexpr std::array more_of_friction{
    &ContactRules::Friction::drop, &ContactRules::Friction::inv_decay,
    &ContactRules::Friction::strength, &ContactRules::Friction::rate,
    &ContactRules::Friction::inv_speed};
static_assert(sizeof(ContactRules::Friction) == (1 + more_of_friction.size()) * sizeof(double),
              "more_of_friction lacks a member of ContactRules::Friction");

// `number(n)`: number n of FrictionMore of the pairs. `share` of a stress that this pass bears: one half if the other
// particle samples back. `lost`, `by_speed`: see Weakening.
template <class Number>
[[gnu::always_inline]] inline kernels::Weakening<Lane> weakening_law(const Lane& mu,
                                                                     const Number& number,
                                                                     double share, const Lane& lost,
                                                                     const Lane& by_speed) {
  using More = FrictionMore<Contact>;
  return {.mu = mu,
          .drop = number(More::drop),
          .inv_decay = number(More::inv_decay),
          .maximum = share * number(More::strength),
          .lost = lost,
          .by_speed = by_speed};
}

}  // namespace pulvis
