// Finite-strain J2 plasticity: the laws of the radial return at one material point.
#include "systems/body/j2_kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/helpers/random_values.hpp"

namespace pulvis::kernels {
namespace {

template <class T>
struct Material {
  T mu;
  LinearHardening<T> law;
};

const Material<double> steel{80e9, {400e6, 2e9}};
const Material<double> ideal{80e9, {400e6, 0}};

double metric_determinant(const Symmetric3<double>& c) {
  return ((1 + c.xx) * (1 + c.yy) - c.xy * c.xy) * (1 + c.zz);
}

// As if no plastic flow happened: stress of F with the plastic state of `old`.
template <class T>
J2State<T> trial(const Matrix2<T>& f, const J2State<T>& old, T mu) {
  const T theta = determinant(f), r = inverse_cube_root(theta);
  return {scaled_deviator(left_cauchy_green(f, old.c), mu / theta * (r * r)), old.c, old.eps};
}

template <class T>
J2State<T> step(const Matrix2<T>& f, const J2State<T>& old, const Material<T>& m) {
  const T theta = determinant(f), r = inverse_cube_root(theta);
  return radial_return<T>(trial(f, old, m.mu), f, r * r, m.mu / theta, theta / m.mu, m.law);
}

// A wandering deformation: strains up to some 15%, a step of it up to 1%, twice the elastic limit.
class Wander {
 public:
  explicit Wander(std::uint64_t seed) : random_(seed) {}
  Matrix2<double> next() {
    for (double* v : {&f_.xx, &f_.xy, &f_.yx, &f_.yy}) *v += random_.in(-0.01, 0.01);
    f_ = {1 + 0.99 * (f_.xx - 1), 0.99 * f_.xy, 0.99 * f_.yx, 1 + 0.99 * (f_.yy - 1)};
    return f_;
  }

 private:
  Random random_;
  Matrix2<double> f_{1, 0, 0, 1};
};

// Eighty paths from the virgin state: elastic strains from 0.2% to 2% as the material hardens.
template <class Look>
void along_random_paths(const Material<double>& m, const Look& look) {
  int flowed = 0;
  for (std::uint64_t seed = 0; seed < 80; ++seed) {
    Wander path(seed);
    J2State<double> state{};
    for (int i = 0; i < 250; ++i) {
      const Matrix2<double> f = path.next();
      const J2State<double> next = step(f, state, m);
      flowed += next.eps > state.eps;
      look(f, state, next);
      if (testing::Test::HasFatalFailure()) return;
      state = next;
    }
  }
  EXPECT_GT(flowed, 10000);  // of 20000: or the paths have tested nothing
  EXPECT_LT(flowed, 19999);
}

using State = J2State<double>;
using Gradient = Matrix2<double>;

TEST(RadialReturn, StressComesBackOntoTheYieldSurface) {
  along_random_paths(steel, [](const Gradient&, const State& old, const State& next) {
    const double ratio = std::sqrt(1.5 * squared_norm(next.s)) / steel.law.flow_stress(next.eps);
    ASSERT_LE(ratio, 1 + 1e-12);
    // Linear hardening makes the consistency condition linear: what is left is round-off.
    if (next.eps > old.eps) {
      ASSERT_NEAR(ratio, 1, 1e-12);
    }
  });
}

TEST(RadialReturn, PerfectlyPlasticStaysAtYield) {
  along_random_paths(ideal, [](const Gradient&, const State& old, const State& next) {
    if (next.eps > old.eps) {
      ASSERT_NEAR(std::sqrt(1.5 * squared_norm(next.s)), 400e6, 1e-12 * 400e6);
    }
  });
}

TEST(RadialReturn, PlasticFlowKeepsVolumeOverManySteps) {
  // The mean of b_e is iterated until det b_e = 1 up to the eighth order of the trial strain (2e-2 with
  // the step on top), and an error left in C_p^-1 is multiplied by beta < 1 in the next return: what
  // stays is round-off, 1e-16 a step, over the few steps that beta commits.
  Wander path(11);
  J2State<double> state{};
  for (int i = 0; i < 20000; ++i) {
    state = step(path.next(), state, ideal);
    ASSERT_NEAR(metric_determinant(state.c), 1, 1e-11) << i;
  }
  along_random_paths(steel, [](const Gradient&, const State&, const State& next) {
    ASSERT_NEAR(metric_determinant(next.c), 1, 1e-11);
  });
}

TEST(RadialReturn, OneGreatStepLosesVolumeByTheEighthPowerOfTheStrain) {
  for (const double gamma : {0.05, 0.1, 0.2, 0.3}) {
    const State next = step(Gradient{1, gamma, 0, 1}, State{}, ideal);
    EXPECT_LT(std::abs(metric_determinant(next.c) - 1), std::pow(gamma, 8) + 1e-14) << gamma;
  }
}

TEST(RadialReturn, StressFollowsFromTheNewStateAlone) {
  along_random_paths(steel, [](const Gradient& f, const State&, const State& next) {
    const auto again = trial(f, next, steel.mu).s;
    const double tolerance = 1e-11 * steel.law.flow_stress(next.eps);  // that of det b_e = 1, above
    ASSERT_NEAR(again.xx, next.s.xx, tolerance);
    ASSERT_NEAR(again.yy, next.s.yy, tolerance);
    ASSERT_NEAR(again.xy, next.s.xy, tolerance);
  });
}

TEST(RadialReturn, PlasticStrainNeverDecreases) {
  along_random_paths(steel, [](const Gradient&, const State& old, const State& next) {
    ASSERT_GE(next.eps, old.eps);
  });
}

TEST(RadialReturn, FlowSpendsStoredEnergy) {
  // At fixed F the return lowers the stored energy, by at least the plastic work of the step: the stress
  // that does it lies between trial and flow stress. 5% for elastic strains of 2%; round-off of W: 1e-16 mu.
  along_random_paths(steel, [](const Gradient& f, const State& old, const State& next) {
    const double spent =
        isochoric_energy(f, old.c, steel.mu) - isochoric_energy(f, next.c, steel.mu);
    const double work = steel.law.plastic_work(next.eps) - steel.law.plastic_work(old.eps);
    ASSERT_GE(spent, 0.95 * determinant(f) * work - 1e-15 * steel.mu);
  });
}

TEST(RadialReturn, BelowYieldNothingChanges) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Gradient f{1 + random.in(-1e-3, 1e-3), random.in(-1e-3, 1e-3), random.in(-1e-3, 1e-3),
                     1 + random.in(-1e-3, 1e-3)};
    const State old{{}, {1e-4, -1e-4, 1e-8, 2e-5}, 0.2};
    const State before = trial(f, old, steel.mu), after = step(f, old, steel);
    ASSERT_FALSE(yields(before.s, before.eps, steel.law));
    ASSERT_EQ(bits(after.s.xx), bits(before.s.xx));
    ASSERT_EQ(bits(after.s.xy), bits(before.s.xy));
    ASSERT_EQ(bits(after.c.xx), bits(old.c.xx));
    ASSERT_EQ(bits(after.c.zz), bits(old.c.zz));
    ASSERT_EQ(bits(after.eps), bits(old.eps));
  }
}

Gradient simple_shear(double gamma) { return {1, gamma, 0, 1}; }

TEST(RadialReturn, SimpleShearHardensByTheClosedForm) {
  // tau = tau_y + G H/(H + 3 G) (gamma - gamma_y), tau_y = sigma_y/sqrt 3, up to the square of the
  // shear (finite strain turns the principal axes by gamma/2).
  const Material<double> m{80e9, {40e6, 20e9}};
  const double tau_y = m.law.sigma_y / std::sqrt(3.0), gamma_y = tau_y / m.mu, h = m.law.H;
  State state{};
  for (int i = 1; i <= 200; ++i) {
    const double gamma = 20 * gamma_y * i / 200;
    state = step(simple_shear(gamma), state, m);
    const double tau =
        gamma < gamma_y ? m.mu * gamma : tau_y + m.mu * h / (h + 3 * m.mu) * (gamma - gamma_y);
    ASSERT_NEAR(state.s.xy, tau, 1e-4 * tau) << gamma;
  }
}

TEST(RadialReturn, PlaneStrainTensionReachesTheClosedFormOfIdealPlasticity) {
  // Isochoric stretch, zz held: |s| = sqrt(2) s_xx, so s_xx -> sigma_y/sqrt 3 and s_zz -> 0.
  State state{};
  for (int i = 1; i <= 1000; ++i) {
    const double stretch = 1 + 1e-4 * i;
    state = step(Gradient{stretch, 0, 0, 1 / stretch}, state, ideal);
  }
  EXPECT_NEAR(state.s.xx, 400e6 / std::sqrt(3.0),
              1e-3 * 400e6);  // the elastic part is 0.3% of strain
  EXPECT_NEAR(state.s.yy, -400e6 / std::sqrt(3.0), 1e-3 * 400e6);
  // eps = 2/sqrt 3 ln(stretch), less its elastic share sigma_y/(3 mu).
  EXPECT_NEAR(state.eps, 2 / std::sqrt(3.0) * std::log(1.1) - 400e6 / (3 * 80e9), 1e-5);
}

// Work of the stresses in simple shear to `gamma`, less what is stored and what plastic flow spent.
double energy_gap(double gamma, int steps) {
  State state{};
  double work = 0;
  for (int i = 1; i <= steps; ++i) {
    const double before = state.s.xy;
    state = step(simple_shear(gamma * i / steps), state, steel);
    work += 0.5 * (before + state.s.xy) * gamma / steps;  // P : dF = tau_xy dgamma
  }
  const double stored = isochoric_energy(simple_shear(gamma), state.c, steel.mu);
  return work - stored - steel.law.plastic_work(state.eps);
}

TEST(RadialReturn, EnergyBalanceClosesWithTheStep) {
  // sigma_y deps is the dissipation up to the square of the elastic strain, |s|/mu = 1e-2 at the end.
  const double work = steel.law.sigma_y * 0.5 / std::sqrt(3.0);
  EXPECT_LT(std::abs(energy_gap(0.5, 2000)), 1e-4 * work);
  // Backward Euler is of first order: half the step, half the change.
  const double first = energy_gap(0.5, 500) - energy_gap(0.5, 1000);
  EXPECT_NEAR((energy_gap(0.5, 1000) - energy_gap(0.5, 2000)) / first, 0.5, 0.1);
}

TEST(RadialReturn, RotationOfTheSpaceTurnsTheStressOnly) {
  Wander path(5);
  Random random(6);
  State state{};
  for (int i = 0; i < 2000; ++i) {
    const Gradient f = path.next(), q = rotation(random.in(-3, 3));
    const State next = step(f, state, steel), turned = step(product(q, f), state, steel);
    const auto& s = next.s;
    const double gxx = q.xx * s.xx + q.xy * s.xy, gxy = q.xx * s.xy + q.xy * s.yy;
    const double gyx = q.yx * s.xx + q.yy * s.xy, gyy = q.yx * s.xy + q.yy * s.yy;
    // Stress is mu times a difference from one: 1e-16 of mu, with b computed by a dozen operations.
    const double tolerance =
        1e-13 * std::sqrt(squared_norm(trial(f, state, steel.mu).s)) + 1e-15 * steel.mu;
    ASSERT_NEAR(turned.s.xx, gxx * q.xx + gxy * q.xy, tolerance);
    ASSERT_NEAR(turned.s.yy, gyx * q.yx + gyy * q.yy, tolerance);
    ASSERT_NEAR(turned.s.xy, gxx * q.yx + gxy * q.yy, tolerance);
    ASSERT_NEAR(turned.c.xx, next.c.xx, 1e-13);
    ASSERT_NEAR(turned.c.xy, next.c.xy, 1e-13);
    ASSERT_NEAR(turned.eps, next.eps, 1e-13);
    state = next;
  }
}

TEST(RadialReturn, InfiniteYieldStressNeverYields) {
  const Material<double> elastic{80e9, {std::numeric_limits<double>::infinity(), 0}};
  for (const Gradient& f :
       {Gradient{1, 0, 0, 1}, Gradient{1.5, 0.7, -0.2, 0.8}, Gradient{0.1, 0, 0, 9}}) {
    const State before = trial(f, State{}, elastic.mu), after = step(f, State{}, elastic);
    EXPECT_EQ(bits(after.s.xx), bits(before.s.xx));
    EXPECT_EQ(bits(after.s.xy), bits(before.s.xy));
    EXPECT_EQ(after.eps, 0);
    for (const double v : {after.c.xx, after.c.yy, after.c.zz, after.c.xy}) EXPECT_EQ(v, 0);
    EXPECT_TRUE(std::isfinite(after.s.yy));
  }
}

struct PointsOfLanes {
  Matrix2<Lane> f{};
  J2State<Lane> state{};
  void set(int lane, const Gradient& one, const State& old) {
    f.xx[lane] = one.xx, f.xy[lane] = one.xy, f.yx[lane] = one.yx, f.yy[lane] = one.yy;
    state.c.xx[lane] = old.c.xx, state.c.yy[lane] = old.c.yy, state.c.zz[lane] = old.c.zz;
    state.c.xy[lane] = old.c.xy, state.eps[lane] = old.eps;
  }
};

State lane_of(const J2State<Lane>& a, int l) {
  return {
      {a.s.xx[l], a.s.yy[l], a.s.xy[l]}, {a.c.xx[l], a.c.yy[l], a.c.zz[l], a.c.xy[l]}, a.eps[l]};
}

bool same_bits(const State& a, const State& b) {
  return bits(a.s.xx) == bits(b.s.xx) && bits(a.s.yy) == bits(b.s.yy) &&
         bits(a.s.xy) == bits(b.s.xy) && bits(a.c.xx) == bits(b.c.xx) &&
         bits(a.c.yy) == bits(b.c.yy) && bits(a.c.zz) == bits(b.c.zz) &&
         bits(a.c.xy) == bits(b.c.xy) && bits(a.eps) == bits(b.eps);
}

// Lane materials: the fourth lane never yields.
const Material<Lane> materials{
    80e9,
    {Lane::from([](int l) { return l == 3 ? std::numeric_limits<double>::infinity() : 400e6; }),
     2e9}};

TEST(RadialReturn, LanesGiveTheBitsOfTheScalar) {
  std::vector<Wander> paths;
  for (unsigned l = 0; l < lane_count; ++l) paths.emplace_back(l + 1);
  std::vector<State> states(lane_count);
  for (int i = 0; i < 2000; ++i) {
    PointsOfLanes points;
    Gradient f[lane_count];
    for (int l = 0; l < lane_count; ++l) {
      const auto at = static_cast<std::size_t>(l);
      points.set(l, f[l] = paths[at].next(), states[at]);
    }
    const auto lanes = step(points.f, points.state, materials);
    for (int l = 0; l < lane_count; ++l) {
      State& state = states[static_cast<std::size_t>(l)];
      const Material<double> m{80e9, {materials.law.sigma_y[l], 2e9}};
      state = step(f[l], state, m);
      ASSERT_TRUE(same_bits(lane_of(lanes, l), state)) << "step " << i << ", lane " << l;
    }
  }
}

TEST(RadialReturn, LanesThatDoNotYieldIgnoreANeighbourThatDoes) {
  PointsOfLanes points;
  const State old{{}, {1e-4, -1e-4, 1e-8, 2e-5}, 0.2};
  points.set(0, simple_shear(0.1), State{});     // yields
  points.set(1, Gradient{1, 0, 0, 1}, State{});  // at rest: |s| = 0
  points.set(2, simple_shear(1e-3), old);        // below yield
  points.set(3, simple_shear(0.5), old);         // elastic material
  const auto before = trial(points.f, points.state, materials.mu);
  const auto after = step(points.f, points.state, materials);
  EXPECT_GT(after.eps[0], 0);
  for (int l = 1; l < 4; ++l) EXPECT_TRUE(same_bits(lane_of(after, l), lane_of(before, l))) << l;
}

TEST(MeanStress, IsTheDerivativeOfTheVolumetricEnergy) {
  const double h = 1e-5;  // truncation h^2 theta^-3, at most 1e-8
  for (const double theta : {0.3, 0.9, 1.0, 1.1, 2.0})
    EXPECT_NEAR((volumetric_energy(3.0, theta + h) - volumetric_energy(3.0, theta - h)) / (2 * h),
                mean_stress(3.0, theta), 1e-8)
        << theta;
  EXPECT_EQ(mean_stress(3.0, 1.0), 0);
  EXPECT_EQ(volumetric_energy(3.0, 1.0), 0);
}

TEST(MeanStress, GrowsWithoutBoundUnderCompression) { EXPECT_LT(mean_stress(1.0, 1e-6), -4e5); }

}  // namespace
}  // namespace pulvis::kernels
