// The stable time step of whole particles against their exact highest frequency: the eigenvalues of the
// assembled stiffness, by differences of the internal force.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "components/run_state.hpp"
#include "scenes/build.hpp"
#include "systems/step.hpp"

namespace pulvis {
namespace {

Scene one_particle(const Outline& outline, const MeshSpec& mesh, double nu) {
  Scene scene;
  scene.materials = {{"elastic", 1000, 1e6, nu, {}, 0, {}, {}}};
  scene.particles = {{"particle", 0, outline, mesh, false, 0, {}}};
  scene.bodies = {BodySpec{}};
  scene.stages.emplace_back().duration = 1;
  return scene;
}

class LoneParticle {
 public:
  explicit LoneParticle(const Scene& scene) : world_(build_world(scene)) {
    std::vector<System> forces = step_list(*world_).forces;
    forces_ = std::make_unique<TaskGraph>(std::move(forces), world_->chunks());
  }
  Eigen::Index unknowns() const {
    return static_cast<Eigen::Index>(2 * world_->column<Position<TwoD>>().table.rows);
  }
  double position(Eigen::Index i) const { return world_->column<Position<TwoD>>().lanes()[i][0]; }
  void put(Eigen::Index i, double x) { world_->column<Position<TwoD>>().lanes()[i][0] = x; }

  void deform(const Eigen::Matrix2d& stretch) {
    for (Eigen::Index n = 0; n < unknowns(); n += 2) {
      const Eigen::Vector2d x = stretch * Eigen::Vector2d(position(n), position(n + 1));
      put(n, x[0]);
      put(n + 1, x[1]);
    }
  }

  Eigen::VectorXd force() {
    forces_->run();
    Eigen::VectorXd f(unknowns());
    for (Eigen::Index i = 0; i < f.size(); ++i)
      f[i] = world_->column<InternalForce<TwoD>>().lanes()[i][0];
    return f;
  }
  double highest_frequency() {
    const auto& shape = world_->resource<Bodies>().shapes[0];
    const double thickness = world_->resource<Bodies>().thickness, rho = 1000, h = 1e-7;
    Eigen::MatrixXd k(unknowns(), unknowns());
    for (Eigen::Index j = 0; j < unknowns(); ++j) {
      const double x = position(j);
      put(j, x + h);
      const Eigen::VectorXd plus = force();
      put(j, x - h);
      k.col(j) = (force() - plus) / (2 * h);
      put(j, x);
    }
    Eigen::VectorXd m(unknowns());
    for (Eigen::Index i = 0; i < m.size(); ++i)
      m[i] = rho * thickness * shape.nodal_area[static_cast<std::size_t>(i / 2)];
    const Eigen::VectorXd over = m.cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd a = over.asDiagonal() * (0.5 * (k + k.transpose())) * over.asDiagonal();
    return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(a).eigenvalues().maxCoeff());
  }
  double stable_step() {
    force();
    TaskGraph(start_list(*world_), world_->chunks()).run();
    return world_->column<StableTimeStep>().values()[0];
  }

 private:
  std::unique_ptr<World> world_;
  std::unique_ptr<TaskGraph> forces_;
};

// Stable step over the exact limit 2 / omega: never above one, and how close.
void expect_bound(const Outline& outline, const MeshSpec& mesh, double nu, double at_least,
                  const Eigen::Matrix2d& stretch = Eigen::Matrix2d::Identity()) {
  LoneParticle p(one_particle(outline, mesh, nu));
  p.deform(stretch);
  const double share = p.stable_step() * p.highest_frequency() / 2;
  EXPECT_LE(share, 1 + 1e-6);
  EXPECT_GE(share, at_least);
}

TEST(StableTimeStep, OfOneElementIsExact) {
  for (const double nu : {0.0, 0.3, 0.4999})
    expect_bound(RectangleOutline{1, 1}, RectangleMesh{1, 1}, nu, 0.999);
}

TEST(StableTimeStep, HoldsForFewElements) {
  for (const double nu : {0.0, 0.3, 0.4999}) {
    expect_bound(RectangleOutline{1, 1}, RectangleMesh{2, 2}, nu, 0.75);
    expect_bound(RectangleOutline{8, 1}, RectangleMesh{8, 1}, nu, 0.8);
    expect_bound(RectangleOutline{1, 3}, RectangleMesh{2, 3}, nu, 0.75);
  }
}

TEST(StableTimeStep, HoldsForDiscs) {
  for (const double nu : {0.0, 0.3}) {
    expect_bound(DiscOutline{1}, DiscMesh{24, 1, 1}, nu, 0.8);
    expect_bound(DiscOutline{1}, DiscMesh{40, 1, 1}, nu, 0.8);
  }
  expect_bound(DiscOutline{1}, DiscMesh{24, 1, 1}, 0.4999, 0.6);
}

TEST(StableTimeStep, HoldsForStrainedParticles) {
  Eigen::Matrix2d squeezed, sheared, swollen;
  squeezed << 1.2, 0, 0, 0.6;
  sheared << 1, 0.5, 0, 0.9;
  swollen << 1.2, 0, 0, 1.2;
  for (const auto& f : {squeezed, sheared, swollen}) {
    expect_bound(DiscOutline{1}, DiscMesh{24, 1, 1}, 0.3, 0.6, f);
    expect_bound(RectangleOutline{1, 1}, RectangleMesh{2, 2}, 0.3, 0.6, f);
  }
}

// The estimate of the whole particle: below the exact limit too, and nearer to it than the elements' bound.
void expect_estimate(const Outline& outline, const MeshSpec& mesh, double nu,
                     Formulation formulation, double at_least,
                     const Eigen::Matrix2d& stretch = Eigen::Matrix2d::Identity()) {
  Scene scene = one_particle(outline, mesh, nu);
  scene.element.formulation = formulation;
  LoneParticle bounded(scene);
  scene.time.estimate = TimeSpec::Estimate::highest_mode;
  LoneParticle p(scene);
  for (LoneParticle* of : {&bounded, &p}) of->deform(stretch);
  const double limit = 2 / p.highest_frequency();
  const double step = p.stable_step();
  EXPECT_LE(step, limit);
  EXPECT_GE(step, at_least * limit);
  EXPECT_GE(step, bounded.stable_step());
}

constexpr auto four_point = Formulation::four_point;
constexpr auto one_point = Formulation::one_point;
constexpr auto standard = Formulation::standard;

TEST(HighestMode, StepOfAWholeParticleIsWithinFourPercent) {
  DiscMesh coarse{48, 0, 1};
  coarse.core = DiscMesh::Core::coarse;
  for (const double nu : {0.0, 0.3})
    for (const auto formulation : {one_point, four_point, standard}) {
      expect_estimate(DiscOutline{1}, DiscMesh{24, 1, 1}, nu, formulation, 0.96);
      expect_estimate(DiscOutline{1}, coarse, nu, formulation, 0.94);
      expect_estimate(RectangleOutline{2, 1}, RectangleMesh{6, 3}, nu, formulation, 0.96);
    }
}

TEST(HighestMode, IsSafeForStrainedParticles) {
  Eigen::Matrix2d squeezed, sheared, swollen;
  squeezed << 1.2, 0, 0, 0.6;
  sheared << 1, 0.5, 0, 0.9;
  swollen << 1.2, 0, 0, 1.2;
  for (const auto& f : {squeezed, sheared, swollen})
    for (const auto formulation : {one_point, four_point, standard}) {
      expect_estimate(DiscOutline{1}, DiscMesh{24, 1, 1}, 0.3, formulation, 0.6, f);
      expect_estimate(RectangleOutline{1, 1}, RectangleMesh{2, 2}, 0.3, formulation, 0.6, f);
    }
}

}  // namespace
}  // namespace pulvis
