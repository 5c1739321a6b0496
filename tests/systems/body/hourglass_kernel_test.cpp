// Hourglass modes of the one-point quad: bending of its fibres, elastic and at the plastic limit.
#include "systems/body/j2_bending_kernel.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "systems/body/time_step_kernel.hpp"
#include "tests/systems/body/quads.hpp"

namespace pulvis::kernels {
namespace {

struct Reference {
  double natural[2], skew[2];
  std::array<double, 4> inv_determinant;
};

double central_determinant(const QuadMap<double>& m) { return m.ax * m.by - m.ay * m.bx; }

Reference reference_of(const Coordinates& x) {
  const auto m = map_of(x);
  const auto w = natural_hourglass(m, 1 / central_determinant(m));
  const double across = m.ax * m.bx + m.ay * m.by;
  auto over = corner_determinants(w);
  for (double& corner : over) corner = 1 / corner;
  return {{w.one, w.two},
          {across / (m.ax * m.ax + m.ay * m.ay), across / (m.bx * m.bx + m.by * m.by)},
          over};
}

Hourglass<double> strain(const Coordinates& undeformed, const Coordinates& now) {
  const auto m = map_of(now);
  return bending_strain(natural_hourglass(m, 1 / central_determinant(m)), reference_of(undeformed));
}

constexpr double modulus = 2.3, shear_modulus = 0.8;

std::array<double, 4> ratios(const Coordinates& undeformed, const Coordinates& now) {
  const auto m = map_of(now);
  return corner_ratios(natural_hourglass(m, 1 / central_determinant(m)), reference_of(undeformed));
}

double energy(const Coordinates& undeformed, const Coordinates& now) {
  const auto e = strain(undeformed, now);
  return 4 * central_determinant(map_of(undeformed)) *
         (hourglass_energy<double>({modulus * e.one, modulus * e.two}, modulus) +
          inversion_barrier_energy(ratios(undeformed, now), shear_modulus));
}

Coordinates forces(const Coordinates& undeformed, const Coordinates& now) {
  const auto m = map_of(now);
  const double over = 1 / central_determinant(m);
  const auto e = strain(undeformed, now);
  const double area = 4 * central_determinant(map_of(undeformed));
  const auto reference = reference_of(undeformed);
  auto moment =
      bending_moment<double>({modulus * e.one, modulus * e.two}, reference, 1.0 / 3.0 * area);
  const auto folded =
      inversion_barrier_moment(ratios(undeformed, now), reference, area * shear_modulus);
  moment.one += folded.one;
  moment.two += folded.two;
  QuadFlux<double> flux;
  add_hourglass_flux<double>(flux, m, natural_hourglass(m, over), over, moment);
  const auto out = node_forces(flux, 0.25);
  return {out.x[0], out.y[0], out.x[1], out.y[1], out.x[2], out.y[2], out.x[3], out.y[3]};
}

struct Case {
  Coordinates undeformed, now;
};
std::array<Case, 40> random_cases() {
  Random random(5);
  std::array<Case, 40> cases;
  for (Case& c : cases) {
    c.undeformed = distorted_square(random);
    c.now = moved(c.undeformed, {1 + random.in(-0.3, 0.3), random.in(-0.3, 0.3),
                                 random.in(-0.3, 0.3), 1 + random.in(-0.3, 0.3)});
    for (double& v : c.now) v += random.in(-0.1, 0.1);
  }
  return cases;
}

TEST(Hourglass, HomogeneousDeformationIsNotSeen) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Coordinates x = distorted_square(random);
    const auto e = strain(x, moved(x, {1.5, random.in(-1, 1), random.in(-0.3, 0.3), 0.8}));
    ASSERT_NEAR(e.one, 0, 2e-14);  // positions of size 5
    ASSERT_NEAR(e.two, 0, 2e-14);
  }
}

TEST(Hourglass, RotationIsNotSeen) {
  for (const Case& c : random_cases()) {
    const double cosine = std::cos(2.1), sine = std::sin(2.1);
    const auto before = strain(c.undeformed, c.now);
    const auto after = strain(c.undeformed, moved(c.now, {cosine, -sine, sine, cosine}));
    ASSERT_GT(std::abs(before.one) + std::abs(before.two), 1e-3);
    ASSERT_NEAR(after.one, before.one, 2e-14);
    ASSERT_NEAR(after.two, before.two, 2e-14);
  }
}

TEST(Hourglass, ForceIsTheDerivativeOfTheEnergy) {
  constexpr double h = 1e-5;
  for (const Case& c : random_cases()) {
    const Coordinates f = forces(c.undeformed, c.now);
    for (std::size_t i = 0; i < 8; ++i) {
      Coordinates up = c.now, down = c.now;
      up[i] += h;
      down[i] -= h;
      const double slope = (energy(c.undeformed, up) - energy(c.undeformed, down)) / (2 * h);
      ASSERT_NEAR(f[i], -slope, 1e-8);  // h^2 times the third derivative
    }
  }
}

// The ratio of a corner is det F of the bilinear map there, over that of the middle.
TEST(InversionBarrier, RatioIsThatOfTheMap) {
  for (const Case& c : random_cases()) {
    const auto ratio = ratios(c.undeformed, c.now);
    const auto det = [](const Coordinates& x, double xi, double eta) {
      return determinant(map_gradient(map_of(x), xi, eta));
    };
    for (std::size_t k = 0; k < 4; ++k)
      ASSERT_NEAR(ratio[k],
                  det(c.now, gauss_xi[k], gauss_eta[k]) /
                      det(c.undeformed, gauss_xi[k], gauss_eta[k]) /
                      (det(c.now, 0, 0) / det(c.undeformed, 0, 0)),
                  1e-13);
  }
}

// A corner pushed in, until its Gauss point has lost 90% of its share of the area: nothing is felt
// before it has lost 70%, and from there the force is the derivative of an energy without jumps.
TEST(InversionBarrier, CornerThatInvertsIsPushedBack) {
  const Coordinates square{-1, -1, 1, -1, 1, 1, -1, 1};
  constexpr double h = 1e-6;
  double minimum = 1;
  for (int corner = 0; corner < 4; ++corner) {
    const auto n = static_cast<std::size_t>(2 * corner);
    for (double in = 0; in < 1.3; in += 0.01) {
      Coordinates now = square;
      now[n] *= 1 - in;
      now[n + 1] *= 1 - in;
      const auto ratio = ratios(square, now);
      const double r = min_ratio(ratio);
      if (r < 0.05) break;
      minimum = std::min(minimum, r);
      const double stored = inversion_barrier_energy(ratio, shear_modulus);
      if (r >= barrier_ratio)
        ASSERT_EQ(stored, 0);
      else
        ASSERT_GT(stored, 0);
      const Coordinates f = forces(square, now);
      for (std::size_t i = 0; i < 8; ++i) {
        Coordinates up = now, down = now;
        up[i] += h;
        down[i] -= h;
        ASSERT_NEAR(f[i], -(energy(square, up) - energy(square, down)) / (2 * h), 2e-5) << in;
      }
    }
  }
  EXPECT_LT(minimum, 0.1);
}

TEST(Hourglass, ForcesHaveNoResultantAndNoMoment) {
  for (const Case& c : random_cases()) {
    const Coordinates f = forces(c.undeformed, c.now);
    double x = 0, y = 0, moment = 0;
    for (std::size_t i = 0; i < 8; i += 2) {
      x += f[i];
      y += f[i + 1];
      moment += c.now[i] * f[i + 1] - c.now[i + 1] * f[i];
    }
    ASSERT_NEAR(x, 0, 1e-14);
    ASSERT_NEAR(y, 0, 1e-14);
    ASSERT_NEAR(moment, 0, 1e-13);
  }
}

// Energy of a rectangle in pure bending: E' I / 2 * curvature^2 * length.
TEST(Hourglass, RectangleBendsLikeABeam) {
  constexpr double length = 3, height = 0.5, curvature = 1e-3;
  Coordinates x{0, 0, length, 0, length, height, 0, height}, bent = x;
  const double end = curvature * height / 2 * length / 2;  // half the stretch of the outer fibre
  const double shift[4] = {end, -end, end, -end};
  for (std::size_t k = 0; k < 4; ++k) bent[2 * k] += shift[k];
  const double inertia = height * height * height / 12;
  const double exact = 0.5 * modulus * inertia * curvature * curvature * length;
  EXPECT_NEAR(energy(x, bent), exact, 1e-9 * exact);
}

// A rhomboid's fibres bend as those of a rectangle of the same length and area do.
TEST(Hourglass, RhomboidBendsLikeABeamAlongItsFibres) {
  constexpr double length = 3, height = 0.5, lean = 0.7, curvature = 1e-3;
  Coordinates x{0, 0, length, 0, length + lean, height, lean, height}, bent = x;
  const double end = curvature * height / 2 * length / 2;
  const double shift[4] = {end, -end, end, -end};
  for (std::size_t k = 0; k < 4; ++k) bent[2 * k] += shift[k];
  const double kappa = strain(x, bent).one;
  EXPECT_NEAR(kappa, curvature * height / 2, 1e-12);
}

TEST(Hourglass, ModulusIsThatOfPlaneStrain) {
  for (const double nu : {-0.3, 0.0, 0.3, 0.4999}) {
    const double mu = 1 / (2 * (1 + nu)), bulk = 1 / (3 * (1 - 2 * nu));
    EXPECT_NEAR(plane_strain_modulus(mu, bulk), 1 / (1 - nu * nu), 1e-12);
  }
}

// The time step's bound of an element covers its hourglass modes: lumped mass a quarter a node, W of the
// two modes against the kinetic energy of h.
TEST(Hourglass, FrequencyIsBelowTheElementBound) {
  Random random(9);
  for (int i = 0; i < 2000; ++i) {
    const double nu = random.in(-0.5, 0.49), ax = random.in(0.2, 3), by = random.in(0.2, 3);
    const QuadMap<double> m{ax, random.in(-0.9, 0.9), random.in(-0.2, 0.2), by, 0, 0};
    const double mu = 1 / (2 * (1 + nu)), bulk = 1 / (3 * (1 - 2 * nu));
    const double across = m.ax * m.bx + m.ay * m.by;
    const double s1 = across / (m.ax * m.ax + m.ay * m.ay);
    const double s2 = across / (m.bx * m.bx + m.by * m.by), over = 1 / central_determinant(m);
    // kappa = [1 s1; s2 1] A^-1 h; omega^2 = E'/3 times the greatest squared singular value.
    const Matrix2<double> k{over * (m.by - s1 * m.ay), over * (-m.bx + s1 * m.ax),
                            over * (s2 * m.by - m.ay), over * (-s2 * m.bx + m.ax)};
    const double trace = k.xx * k.xx + k.xy * k.xy + k.yx * k.yx + k.yy * k.yy;
    const double det = determinant(k);
    const double largest = 0.5 * (trace + std::sqrt(std::max(0.0, trace * trace - 4 * det * det)));
    const double omega2 = plane_strain_modulus(mu, bulk) / 3 * largest;
    const auto spread = mode_spread(Matrix2<double>{m.ax, m.bx, m.ay, m.by}, {1, 0, 1});
    ASSERT_LT(omega2, frequency_bound(spread, bulk, mu, 1.0, 0.0));
  }
}

// ---- plastic limit ----------------------------------------------------------------------------------
// Rate of a section: `stretch` and `shear` of all fibres, bending that adds `bend` y, y in [-1, 1], in plane
// strain without volume change. Its exact mean deviator (normal part, shear part) and moment, over theirs
// at yield: perfectly plastic stress follows the rate's direction.
struct Section {
  double normal = 0, shear = 0, moment = 0;
};
Section exact_section(double stretch, double shear, double bend) {
  constexpr int fibres = 20000;
  Section s;
  for (int i = 0; i < fibres; ++i) {
    const double y = 2 * (i + 0.5) / fibres - 1, rate = stretch + bend * y;
    const double size = std::hypot(rate, shear);
    s.normal += rate / size / fibres;
    s.shear += shear / size / fibres;
    s.moment += 2 * y * rate / size / fibres;  // a fully plastic section: 1
  }
  return s;
}

// Where the joint surface sees a section: 1 on it.
double on_surface(const Section& s, double turn) {
  constexpr double yield = 1;
  const double k = yield / std::numbers::sqrt3;
  const double c = std::cos(turn), i = std::sin(turn), c2 = c * c - i * i, i2 = 2 * c * i;
  const Deviator<double> d{k * (s.normal * c2 - s.shear * i2), -k * (s.normal * c2 - s.shear * i2),
                           k * (s.normal * i2 + s.shear * c2)};
  const QuadMap<double> map{2 * c, 2 * i, -i, c, 0, 0};
  const double limit2 = 2.0 / 3.0;
  const CoupledBending<double> coupled{
      {std::numbers::sqrt3 * yield * s.moment, 0}, 1, 1, inverse_width(map, d, limit2), 1};
  return std::sqrt(coupled.joint_norm(squared_norm(d)) / limit2);
}

TEST(BendingLimit, IsThatOfASectionInBendingAndStretching) {
  // The plastic neutral fibre is inside the section; its width, 1 - ratio^2, above the least one.
  for (const double ratio : {0.0, 0.2, 0.5, 0.7})
    EXPECT_NEAR(on_surface(exact_section(ratio, 1e-9, 1), 0.3), 1, 1e-3) << ratio;
  // Below the least width elements bear more bending than sections do, until stretching is all there is.
  for (const double ratio : {0.8, 0.9, 0.99})
    EXPECT_NEAR(on_surface(exact_section(ratio, 1e-9, 1), 0.3), 0.97, 0.035) << ratio;
}

TEST(BendingLimit, IsThatOfASectionInBendingAndShear) {
  for (const double ratio : {0.01, 0.1, 0.3, 1.0, 3.0, 10.0})
    EXPECT_NEAR(on_surface(exact_section(0, ratio, 1), -0.8), 1, 0.01) << ratio;
}

TEST(BendingLimit, IsNearThatOfASectionInAnyFlow) {
  for (double angle = 0; angle <= std::numbers::pi; angle += 0.1)
    for (const double size : {0.1, 0.5, 1.0, 2.0, 5.0})
      EXPECT_NEAR(
          on_surface(exact_section(size * std::cos(angle), size * std::sin(angle) + 1e-9, 1), 0.5),
          1, 0.05)
          << angle << " " << size;
}

// Pure bending of a beam in plane strain, `elements` through its thickness, curvature in small steps to
// `far` times first yield: moment over 2/sqrt 3 sigma_y height^2/4.
double limit_moment(int elements, double far) {
  constexpr double mu = 80e9, bulk = 170e9, yield = 240e6, height = 1;
  const LinearHardening<double> law{yield, 0};
  const double modulus_of_fibre = plane_strain_modulus(mu, bulk);
  const double step = 0.02, first = yield / modulus_of_fibre;  // strain of the outer fibre
  double moment = 0;
  for (int e = 0; e < elements; ++e) {
    const double part = height / elements, centre = (e + 0.5) * part - height / 2;
    J2State<double> state{};
    double m = 0;
    for (double grown = 0; grown < far; grown += step) {
      const double curvature = step * first / (height / 2);
      const double stretch = 1 + (grown + step) / step * curvature * centre;
      const Matrix2<double> f{stretch, 0, 0, 1 / stretch};
      state.s = scaled_deviator(left_cauchy_green(f, state.c), mu);
      m += modulus_of_fibre * curvature * part / 2;
      const QuadMap<double> map{1, 0, 0, part / 2, 0, 0};
      const double limit2 = 2.0 / 3.0 * yield * yield;
      CoupledBending<double> coupled{{m, 0},
                                     modulus_of_fibre / (3 * mu),
                                     3 * mu / modulus_of_fibre,
                                     inverse_width(map, state.s, limit2),
                                     1};
      state = radial_return(state, f, 1.0, mu, 1 / mu, law, coupled);
      m *= coupled.retained;
    }
    moment += part * centre * (state.s.xx - state.s.yy) + part * part / 6 * m;
  }
  return moment / (2 / std::numbers::sqrt3 * yield * height * height / 4);
}

TEST(BendingLimit, BeamReachesItsLimitMoment) {
  EXPECT_NEAR(limit_moment(1, 30), 1, 0.01);
  EXPECT_NEAR(limit_moment(2, 30), 1, 0.07);  // the outer halves are stretched: their least width
  EXPECT_NEAR(limit_moment(3, 30), 1, 0.05);
  EXPECT_NEAR(limit_moment(4, 30), 1, 0.05);
}

TEST(BendingLimit, ReturnEndsOnTheSurfaceAndSpendsEnergy) {
  constexpr double mu = 80e9, bulk = 170e9, yield = 240e6;
  const double fibre = plane_strain_modulus(mu, bulk);
  Random random(4);
  for (int i = 0; i < 500; ++i) {
    const Matrix2<double> f{1, random.in(-4e-3, 4e-3), 0, 1};
    J2State<double> trial{};
    trial.s = scaled_deviator(left_cauchy_green(f), mu);
    const Hourglass<double> m{random.in(-8e8, 8e8), random.in(-8e8, 8e8)};
    CoupledBending<double> coupled{m, fibre / (3 * mu), 3 * mu / fibre, 1.0, 1.0};
    const auto next =
        radial_return(trial, f, 1.0, mu, 1 / mu, LinearHardening<double>{yield, 440e6}, coupled);
    ASSERT_LE(coupled.retained, 1);
    ASSERT_GE(coupled.retained, 0);
    coupled.stress = {coupled.retained * m.one, coupled.retained * m.two};
    const double limit = yield + 440e6 * next.eps;
    const double norm = std::sqrt(1.5 * coupled.joint_norm(squared_norm(next.s)));
    // First order in the step where the moduli of s and t differ: softness 0.99.
    if (next.eps > 0) {
      ASSERT_NEAR(norm / limit, 1, 0.01);
    } else {
      ASSERT_LE(norm / limit, 1 + 1e-12);
    }
  }
}

}  // namespace
}  // namespace pulvis::kernels
