// What a pair says of its friction reaches the law of three dimensions: all of it, also what is added later.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "systems/space/contact/contact_law.hpp"

namespace pulvis::space {
namespace {

// Traction on a surface that slides at 1 m/s over another, and what it has lost of its static friction.
std::pair<double, double> slid(const FrictionParameters& friction) {
  const PointLaw law{.kappa = Lane(3e15),
                     .friction = Lane(friction.coefficient),
                     .damping = Lane{},
                     .inv_size = Lane{},
                     .weight = Lane(1.0),
                     .tangential = Lane(3e15)};
  const PointMotion motion{.gap = Lane(1e-6),
                           .normal = {Lane{}, Lane{}, Lane(1.0)},
                           .slip = {Lane(1.0), Lane{}, Lane{}}};
  PointForces forces{};
  const Lane lost = add_weakening_friction({friction, 0.5, Lane(0.25)}, law, motion, 1e-6,
                                           Lane(1e8), {Lane{}, Lane{}, Lane{}}, forces);
  return {forces.friction.x[0], lost[0]};
}

const FrictionParameters all_numbers{.coefficient = 0.2,
                                     .static_coefficient = 0.3,
                                     .decay_length = 1e-6,
                                     .rate = 0.02,
                                     .reference_speed = 0.1};

TEST(FrictionOfAPairInSpace, EveryNumberHasAnEffect) {
  using Change = void (*)(FrictionParameters&);
  const std::array<Change, 6> changes{[](FrictionParameters& f) { f.coefficient *= 1.1; },
                                      [](FrictionParameters& f) { *f.static_coefficient *= 1.1; },
                                      [](FrictionParameters& f) { f.decay_length *= 1.1; },
                                      [](FrictionParameters& f) { f.shear_strength = 1e6; },
                                      [](FrictionParameters& f) { f.rate *= 1.1; },
                                      [](FrictionParameters& f) { f.reference_speed *= 1.1; }};
  static_assert(sizeof(FrictionParameters) == (changes.size() + 1) * sizeof(double),
                "changes lacks a member of FrictionParameters (the optional one counts twice)");
  const auto before = slid(all_numbers);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    FrictionParameters changed = all_numbers;
    changes[i](changed);
    EXPECT_NE(slid(changed), before) << "change " << i;
  }
}

TEST(FrictionOfAPairInSpace, IsThatOfTheFormula) {
  EXPECT_NEAR(slid(all_numbers).first / -(1e8 * (0.2 + 0.75 * 0.1 + 0.02 * std::log(11.0))), 1,
              1e-12);
  FrictionParameters soft = all_numbers;
  soft.shear_strength = 3e7;
  EXPECT_NEAR(slid(soft).first / -1.5e7, 1, 1e-12);  // half of it in each of the two passes
}

}  // namespace
}  // namespace pulvis::space
