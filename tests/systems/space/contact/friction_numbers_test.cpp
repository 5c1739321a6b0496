// What a pair says of its friction reaches the law of three dimensions: all of it, also what is added later.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "systems/space/contact/contact_law.hpp"

namespace pulvis::space {
namespace {

// Traction on a surface that slides at 1 m/s over another, and what it has lost of its static friction.
std::pair<double, double> slid(const ContactRules::Friction& friction) {
  const PointLaw law{.kappa = Lane(3e15),
                     .friction = Lane(friction.coefficient),
                     .damping = Lane{},
                     .inv_size = Lane{},
                     .weight = Lane(1.0)};
  const PointMotion motion{.gap = Lane(1e-6),
                           .normal = {Lane{}, Lane{}, Lane(1.0)},
                           .slip = {Lane(1.0), Lane{}, Lane{}}};
  PointForces forces{};
  const Lane lost = add_weakening_friction({friction, 0.5, Lane(0.25)}, law, motion, 1e-6,
                                           Lane(1e8), {Lane{}, Lane{}, Lane{}}, forces);
  return {forces.friction.x[0], lost[0]};
}

TEST(FrictionOfAPairInSpace, EveryNumberHasAnEffect) {
  const ContactRules::Friction friction{
      .coefficient = 0.2, .drop = 0.1, .inv_decay = 1e6, .rate = 0.02, .inv_speed = 10};
  const auto before = slid(friction);
  for (std::size_t i = 0; i < more_of_friction.size(); ++i) {
    ContactRules::Friction changed = friction;
    double& number = changed.*more_of_friction[i];
    number = std::isinf(number) ? 1e6 : number == 0 ? 1 : 1.1 * number;
    EXPECT_NE(slid(changed), before) << "number " << i << " of more_of_friction";
  }
}

TEST(FrictionOfAPairInSpace, IsThatOfTheFormula) {
  const ContactRules::Friction friction{
      .coefficient = 0.2, .drop = 0.1, .inv_decay = 1e6, .rate = 0.02, .inv_speed = 10};
  EXPECT_NEAR(slid(friction).first / -(1e8 * (0.2 + 0.75 * 0.1 + 0.02 * std::log(11.0))), 1, 1e-12);
  ContactRules::Friction soft = friction;
  soft.strength = 3e7;
  EXPECT_NEAR(slid(soft).first / -1.5e7, 1, 1e-12);  // half of it in each of the two passes
}

}  // namespace
}  // namespace pulvis::space
