// The stable time step of bodies in three dimensions against their exact highest frequency: the eigenvalues of the
// assembled stiffness, by differences of the internal force.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "components/highest_mode.hpp"
#include "scenes/checks/solids/class_shape.hpp"
#include "scenes/highest_mode.hpp"
#include "tests/systems/space/body/blocks.hpp"

namespace pulvis::space {
namespace {

template <class F>
Eigen::VectorXd all_forces(Body<F>& body) {
  body.find_forces();
  Eigen::VectorXd f(3 * body.nodes());
  for (int n = 0; n < body.nodes(); ++n) f.segment<3>(3 * n) = body.force(n);
  return f;
}

// Central differences: round-off over the step and the third derivative leave 1e-8.
template <class F>
double highest_frequency(Body<F>& body) {
  const double h = 1e-6;
  const int unknowns = 3 * body.nodes();
  Eigen::MatrixXd k(unknowns, unknowns);
  for (int j = 0; j < unknowns; ++j) {
    const Vector at = body.position(j / 3), step = h * Vector::Unit(j % 3);
    body.put(j / 3, at + step);
    const Eigen::VectorXd plus = all_forces(body);
    body.put(j / 3, at - step);
    k.col(j) = (all_forces(body) - plus) / (2 * h);
    body.put(j / 3, at);
  }
  Eigen::VectorXd weight(unknowns);
  for (int i = 0; i < unknowns; ++i)
    weight[i] = 1 / std::sqrt(1000 * body.shape().nodal_volume[std::size_t(i / 3)]);
  const Eigen::MatrixXd m = weight.asDiagonal() * k * weight.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes((m + m.transpose()) / 2,
                                                             Eigen::EigenvaluesOnly);
  return std::sqrt(modes.eigenvalues().maxCoeff());
}

// Bound over what is exact: above 1 the run would be unstable.
template <class F>
double step_ratio(Body<F>& body) {
  body.find_forces();
  body.template run<stable_time_step<F>>();
  return body.template number<StableTimeStep>(0) * highest_frequency(body) / 2;
}

Matrix random_stretch(Random& random, double by) {
  Matrix f = Matrix::Identity();
  for (int i = 0; i < 9; ++i) f(i / 3, i % 3) += by * random.in(-1, 1);
  return f;
}

template <class F>
class TimeSteps : public testing::Test {};
TYPED_TEST_SUITE(TimeSteps, Formulations);

Vector random_vector(Random& random) {
  const double x = random.in(-1, 1), y = random.in(-1, 1);
  return {x, y, random.in(-1, 1)};
}

struct Range {
  double least = 1e9, largest = 0;
  void add(double ratio) {
    least = std::min(least, ratio);
    largest = std::max(largest, ratio);
  }
};

// Elements of any form and any Poisson's ratio, deformed by up to `by`, then each node by `shaken`.
template <class F>
Range range_of_ratios(double distortion, double by, double shaken) {
  Range range;
  Random random(1);
  for (int i = 0; i < 40; ++i) {
    const Matrix box =
        (Vector::Constant(0.65) + 0.35 * random_vector(random)).asDiagonal().toDenseMatrix();
    const Matrix lean = random_stretch(random, distortion);
    const Shape shape = block({1, 1, 1}, [&](const Vector& x) {
      return Vector(lean * box * (x + 0.5 * distortion * random_vector(random)));
    });
    const double nu[4] = {0, 0.3, 0.45, 0.499};
    Body<F> body(shape, material(1e6, nu[i % 4]));
    const Matrix f = random_stretch(random, by);
    body.place([&](const Vector& x) { return Vector(f * x + shaken * random_vector(random)); });
    range.add(step_ratio(body));
  }
  return range;
}

// Never above what is exact; the reference formulation pays for its Gauss points.
template <class F>
constexpr double least_ratio = F::stabilised ? 0.65 : 0.45;

TYPED_TEST(TimeSteps, OfAnElementIsStableAndNotFarBelow) {
  for (const double distortion : {0.0, 0.2, 0.35})
    for (const double by : {0.0, 0.1, 0.3})
      for (const double shaken : {0.0, 0.03}) {
        const Range range = range_of_ratios<TypeParam>(distortion, by, shaken);
        EXPECT_LT(range.largest, 1 + 1e-6) << distortion << " " << by << " " << shaken;
        EXPECT_GT(range.least, least_ratio<TypeParam>) << distortion << " " << by << " " << shaken;
      }
}

// Undeformed boxes are met exactly where one stretch or all three are the fastest: cubes.
TEST(TimeStep, OfACubeIsExact) {
  for (const double nu : {0.0, 0.3, 0.499}) {
    Body<OnePoint> body(block({1, 1, 1}, [](const Vector& x) { return x; }), material(1e6, nu));
    EXPECT_NEAR(step_ratio(body), 1, 1e-6) << nu;
  }
}

// Bent until the map at a Gauss point is `r` of what it is in the middle.
template <class F>
Range range_of_closing(double r) {
  Range range;
  Random random(5);
  for (int i = 0; i < 40; ++i) {
    const double nu[4] = {0, 0.3, 0.45, 0.499};
    Body<F> body(distorted_block({1, 1, 1}, 0.05, std::uint64_t(i)), material(1e6, nu[i % 4]));
    const Matrix f = random_stretch(random, 0.2);
    const double by = (1 - r) * std::sqrt(3.0) / 2;
    const int along = i % 3, across = (i + 1 + i / 3 % 2) % 3;
    body.place([&](const Vector& x) {
      Vector bent = x;
      bent[along] += by * (x[along] < 0.5 ? 1 : -1) * (x[across] < 0.5 ? 1 : -1);
      return Vector(f * bent);
    });
    range.add(step_ratio(body));
  }
  return range;
}

// As corners close, and far into what the barrier bears. The factor is wide where the closing mode is not the fastest: a
// step of a seventh at worst.
TYPED_TEST(TimeSteps, OfAClosingElementIsStable) {
  for (const double r : {0.7, 0.5, 0.4, 0.3, 0.25, 0.2}) {
    const Range range = range_of_closing<TypeParam>(r);
    EXPECT_LT(range.largest, 1) << r;
    EXPECT_GT(range.least, 0.15) << r;
  }
}

TYPED_TEST(TimeSteps, OfAMeshIsStable) {
  for (const double nu : {0.0, 0.3, 0.499}) {
    Body<TypeParam> body(distorted_block({3, 2, 2}, 0.25, 3), material(1e6, nu));
    Random random(4);
    body.place([&](const Vector& x) {
      return Vector(Vector(1, 0.8, 1.1).cwiseProduct(x) + 0.02 * random_vector(random));
    });
    const double ratio = step_ratio(body);
    EXPECT_LT(ratio, 1) << nu;
    EXPECT_GT(ratio, TypeParam::stabilised ? 0.55 : 0.4) << nu;
  }
}

// ---- the highest mode of a whole body ---------------------------------------------------------------
struct Estimate {
  double of_elements, of_body;  // steps over what is exact
};
template <class F>
Estimate estimate(Body<F>& body) {
  if (!body.world.template has<ModeGain>())
    add_highest_mode(body.world, body.world.template resource<Bodies>(),
                     body.world.template resource<Shapes>(), false);
  body.world.template column<ModeGain>().values()[lane_count] =
      0;  // not yet estimated, in the first lane
  const double exact = 2 / highest_frequency(body);
  body.find_forces();
  body.template run<stable_time_step<F>>();
  const double bound = body.template number<StableTimeStep>(0);
  body.template run<highest_mode<F>>();
  return {bound / exact, body.template number<StableTimeStep>(0) / exact};
}

// Safe (the bound of a cube is exact), not below the bound, and `near` to what is exact unless that is beyond the largest gain.
template <class F>
void expect_estimate(Body<F>& body, double near, const std::string& what) {
  const Estimate found = estimate(body);
  EXPECT_LT(found.of_body, 1 + 1e-6) << what;
  EXPECT_GE(found.of_body, found.of_elements) << what;
  EXPECT_GT(found.of_body, std::min(near, 1.299 * found.of_elements)) << what;
}

TYPED_TEST(TimeSteps, OfTheHighestModeAreSafeForAnyElement) {
  Random random(7);
  for (const double distortion : {0.0, 0.2, 0.35})
    for (const double by : {0.0, 0.1, 0.3})
      for (const double shaken : {0.0, 0.03})
        for (int i = 0; i < 12; ++i) {
          const double nu[4] = {0, 0.3, 0.45, 0.499};
          Body<TypeParam> body(distorted_block({1, 1, 1}, distortion, std::uint64_t(i)),
                               material(1e6, nu[i % 4]));
          const Matrix f = random_stretch(random, by);
          body.place(
              [&](const Vector& x) { return Vector(f * x + shaken * random_vector(random)); });
          expect_estimate(body, by + shaken > 0 ? 0.5 : 0.96,
                          fmt::format("{} {} {} {}", distortion, by, shaken, i));
        }
}

TYPED_TEST(TimeSteps, OfTheHighestModeAreSafeForClosingElements) {
  Random random(8);
  for (const double r : {0.7, 0.5, 0.4, 0.3, 0.25, 0.2})
    for (int i = 0; i < 12; ++i) {
      const double nu[4] = {0, 0.3, 0.45, 0.499};
      Body<TypeParam> body(distorted_block({1, 1, 1}, 0.05, std::uint64_t(i)),
                           material(1e6, nu[i % 4]));
      const double by = (1 - r) * std::sqrt(3.0) / 2;
      const int along = i % 3, across = (i + 1 + i / 3 % 2) % 3;
      const Matrix f = random_stretch(random, 0.2);
      body.place([&](const Vector& x) {
        Vector bent = x;
        bent[along] += by * (x[along] < 0.5 ? 1 : -1) * (x[across] < 0.5 ? 1 : -1);
        return Vector(f * bent);
      });
      expect_estimate(body, 0.15, fmt::format("{} {}", r, i));
    }
}

TYPED_TEST(TimeSteps, OfTheHighestModeOfAMeshAreNearlyExact) {
  for (const double nu : {0.0, 0.3, 0.499})
    for (const double by : {0.0, 0.25}) {
      Body<TypeParam> body(distorted_block({4, 3, 3}, by, 3), material(1e6, nu));
      expect_estimate(body, 0.95, fmt::format("{} {}", nu, by));
      Random random(4);
      body.place([&](const Vector& x) {
        return Vector(Vector(1, 0.8, 1.1).cwiseProduct(x) + 0.02 * random_vector(random));
      });
      expect_estimate(body, 0.6, fmt::format("{} {}, deformed", nu, by));
    }
}

Shape ball_of(int divisions, int rings) {
  Scene scene;
  scene.dimension = 3;
  scene.materials = {material(1e6, 0.3)};
  ParticleSpec& ball = scene.particles.emplace_back();
  ball.shape = SphereShape{1};
  ball.hex_mesh.divisions = divisions;
  ball.hex_mesh.rings = rings;
  return class_shape(scene, 0);
}

// The elements of a ball cannot all oscillate at once: its step is longer than theirs by the largest gain, or nearly.
TYPED_TEST(TimeSteps, OfTheHighestModeOfABallGainAThird) {
  for (const double nu : {0.0, 0.3}) {
    Body<TypeParam> body(ball_of(2, 2), material(1e6, nu));
    const Estimate found = estimate(body);
    EXPECT_GT(found.of_body / found.of_elements, 1.29) << nu;
    EXPECT_LT(found.of_body, 0.981) << nu;
  }
}

}  // namespace
}  // namespace pulvis::space
