// The law of contact points and its books, against closed forms.
#include "systems/contact/contact_law.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/helpers/random_values.hpp"

namespace pulvis {
namespace {

constexpr double kappa = 3e15, weight = 2e-6, length = 1e-4, damping = 1e8, dt = 1e-8, mu = 0.3;

PointLaw law(double c = 0) { return {weight, kappa, kappa, c, 1 / length}; }

// Eight points, some apart, on normals all around.
PointMotion motion_at(double slip) {
  PointMotion m{};
  for (int l = 0; l < lane_count; ++l) {
    const double angle = 0.7 * l;
    m.gap[l] = (l - 2) * 1e-6;
    m.nx[l] = std::cos(angle), m.ny[l] = std::sin(angle);
    m.gap_rate[l] = 0.1 * l;
    m.slip_rate[l] = slip / dt;
  }
  return m;
}

// kappa g (1 + (g/g_s)^2), g_s = L/20
double pressure_at(double gap) {
  const double share = gap / (length / 20);
  return gap > 0 ? kappa * gap * (1 + share * share) : 0;
}
double energy_at(double gap) {
  const double share = gap / (length / 20);
  return gap > 0 ? 0.5 * kappa * gap * gap * (1 + 0.5 * share * share) : 0;
}

TEST(ContactLaw, WithoutFrictionPushesAlongTheNormal) {
  const PointMotion m = motion_at(1e-7);
  const PointForces f = forces_of(law(), m, dt, Frictionless{});
  for (int l = 0; l < lane_count; ++l) {
    const double push = weight * pressure_at(m.gap[l]);
    EXPECT_NEAR(f.x[l], push * m.nx[l], 1e-15 * std::abs(push));
    EXPECT_NEAR(f.y[l], push * m.ny[l], 1e-15 * std::abs(push));
    EXPECT_DOUBLE_EQ(f.energy[l], weight * energy_at(m.gap[l]));
    EXPECT_EQ(f.along[l], 0);
    EXPECT_EQ(f.friction_work[l], 0);
    EXPECT_EQ(f.damping_work[l], 0);
  }
}

TEST(ContactLaw, DampingAddsToThePressureAndSpendsItsPower) {
  const PointMotion m = motion_at(0);
  const PointForces f = forces_of(law(damping), m, dt, Frictionless{});
  for (int l = 3; l < lane_count; ++l) {
    const double rate = m.gap_rate[l], all = pressure_at(m.gap[l]) + damping * rate;
    EXPECT_NEAR(f.x[l] * m.nx[l] + f.y[l] * m.ny[l], weight * all, 4e-15 * weight * all);
    EXPECT_NEAR(f.damping_work[l], weight * damping * rate * rate * dt,
                1e-14 * weight * all * rate * dt);
  }
}

PointForces with_coulomb(const PointMotion& m, double stretch) {
  return forces_of(law(), m, dt, [&](const Lane& slip, const Lane& pressure) {
    kernels::Coulomb<Lane> coulomb{mu};
    return kernels::friction_return<Lane>(stretch, slip, pressure, coulomb, kappa, 1 / kappa);
  });
}

// A slip that the springs of all touching points bear: they store it all.
TEST(ContactLaw, SticksBelowTheCone) {
  constexpr double slip = 1e-7;  // of 0.3e-6 that the shallowest, 1e-6 deep, bears
  const PointMotion m = motion_at(slip);
  const PointForces f = with_coulomb(m, 0);
  for (int l = 3; l < lane_count; ++l) {
    EXPECT_DOUBLE_EQ(f.elastic_slip[l], slip);
    EXPECT_DOUBLE_EQ(f.along[l], -weight * kappa * slip);
    EXPECT_EQ(f.friction_work[l], 0);
    EXPECT_DOUBLE_EQ(f.energy[l], weight * (energy_at(m.gap[l]) + 0.5 * kappa * slip * slip));
    // Along t = (-n_y, n_x).
    EXPECT_NEAR(f.y[l] * m.nx[l] - f.x[l] * m.ny[l], f.along[l], 1e-9 * std::abs(f.along[l]));
  }
}

TEST(ContactLaw, SlidesOnTheConeAndSpendsTheRest) {
  constexpr double slip = 1e-3;
  const PointMotion m = motion_at(slip);
  const PointForces f = with_coulomb(m, 0);
  for (int l = 0; l < lane_count; ++l) {
    const double maximum = mu * pressure_at(m.gap[l]), held = maximum / kappa;
    EXPECT_NEAR(f.along[l], -weight * maximum, 4e-16 * weight * maximum);
    // Half the limit on the mean, from a spring without stretch.
    EXPECT_NEAR(f.friction_work[l], weight * 0.5 * maximum * (slip - held),
                1e-15 * weight * maximum * slip);
  }
}

// ---- books --------------------------------------------------------------------------------------------
PointForces spending(double energy) {
  PointForces f{};
  for (int l = 0; l < lane_count; ++l) {
    f.energy[l] = energy * (l + 1);
    f.friction_work[l] = 10 * f.energy[l];
    f.damping_work[l] = 100 * f.energy[l];
  }
  return f;
}

TEST(ContactSums, AddUpTheCandidatesThatTouch) {
  LaneSums sums;
  sums.add(spending(1), 1);  // 1 2 3 4
  sums.add(spending(1), 2);  // 5 6 7 8
  sums.add(spending(1), 3);
  const BlockSums all = sums.added_up();
  EXPECT_EQ(all.energy, 10 + 26 + 36);
  EXPECT_EQ(all.friction_work, 720);
  EXPECT_EQ(all.damping_work, 7200);
}

TEST(ContactSums, KeepTheDeepestOrTheFirstThatIsNoNumber) {
  LaneSums sums;
  const TwoCandidates<Contact> two{Row<Contact>(4), Row<Contact>(7)};
  Lane depth = 0.1;
  depth[6] = 0.3;
  sums.add_depth(two, 1, depth);
  EXPECT_EQ(sums.block.deepest, 4);
  sums.add_depth(two, 3, depth);
  EXPECT_EQ(sums.block.deepest, 7);
  EXPECT_EQ(sums.block.depth, 0.3);
  EXPECT_EQ(sums.block.touching, 3);
  depth = std::numeric_limits<double>::quiet_NaN();
  sums.add_depth(two, 1, depth);
  depth = 0.9;
  sums.add_depth(two, 2, depth);
  EXPECT_EQ(sums.block.deepest, 4);
  EXPECT_TRUE(std::isnan(sums.block.depth));
}

TEST(ContactSums, CountProjectionsAndThoseThatFailed) {
  BlockSums sums;
  const Row<Contact> a(3), b(8), c(9);
  record_projection<Contact>({a, b}, 0, sums);
  EXPECT_EQ(sums.projections, 8);
  EXPECT_EQ(sums.first_unconverged, -1);
  record_projection<Contact>({b, c}, 0b01100000, sums);
  EXPECT_EQ(sums.first_unconverged, 9);
  EXPECT_EQ(sums.unconverged, 2);
  record_projection<Contact>({a, a}, 0b00010001, sums);  // one that is left over counts once
  EXPECT_EQ(sums.projections, 20);
  EXPECT_EQ(sums.unconverged, 3);
  EXPECT_EQ(sums.first_unconverged, 9);
}

}  // namespace
}  // namespace pulvis
