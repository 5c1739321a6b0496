// Mean stresses of particles and of the compact: the virial of the forces, from within and from without.
#include <gtest/gtest.h>

#include "components/observed.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

using Tensor = Eigen::Matrix2d;

class Pressed : public Experiment {
 public:
  explicit Pressed(const std::string& formulation)
      : Experiment("compaction/regular-25.toml",
                   {"stage.press.duration=0.7 ms", "output.contacts=true",
                    "element.formulation=" + formulation}) {
    run(3);
  }
  World& world() { return simulation.world(); }
  const Bodies& bodies() { return world().resource<Bodies>(); }

  template <class C>
  double of_particle(int slot, int k = 0) {
    const auto at = static_cast<std::size_t>(slot / lane_count * C::count + k);
    return column<C>().lanes()[at][slot % lane_count];
  }
  Tensor stress(int slot) {
    const double xy = of_particle<ParticleStress<TwoD>>(slot, 3);
    return (Tensor() << of_particle<ParticleStress<TwoD>>(slot, 0), xy, xy,
            of_particle<ParticleStress<TwoD>>(slot, 1))
        .finished();
  }
  // Sum over the nodes of force times position, relative to the centre (Love 1927, Weber 1966).
  template <class Force>
  Tensor virial(int slot, std::size_t nodes) {
    const auto first = [&](const auto& c) {
      return static_cast<std::size_t>(
          c.table.chunk_begin[static_cast<std::size_t>(slot / lane_count)]);
    };
    const auto at = [&](const auto& c, std::size_t n) {
      const Lane* xy = c.lanes() + 2 * (first(c) + n);
      return Vec2(xy[0][slot % lane_count], xy[1][slot % lane_count]);
    };
    const Vec2 centre(of_particle<ParticleCentre<TwoD>>(slot, 0),
                      of_particle<ParticleCentre<TwoD>>(slot, 1));
    Tensor sum = Tensor::Zero();
    for (std::size_t n = 0; n < nodes; ++n)
      sum += at(column<Force>(), n) * (at(column<Position<TwoD>>(), n) - centre).transpose();
    return sum / (of_particle<DeformedSize<TwoD>>(slot) * bodies().thickness);
  }
};

class ParticleStressOf : public ::testing::TestWithParam<const char*> {};

TEST_P(ParticleStressOf, IsTheVirialOfTheInternalForces) {
  Pressed e(GetParam());
  for (const int slot : e.bodies().slot_of_number) {
    const Tensor virial =
        e.virial<InternalForce<TwoD>>(slot, e.bodies().shape_of_slot(slot).nodes.size());
    EXPECT_LT((virial + e.stress(slot)).norm(), 1e-10 * e.stress(slot).norm());
  }
}

// In equilibrium the contacts have the same virial: what differs is the inertia.
TEST_P(ParticleStressOf, IsLoveAndWebersMeanOverTheContacts) {
  Pressed e(GetParam());
  double size = 0;
  for (const int slot : e.bodies().slot_of_number) size += e.stress(slot).norm() / 25;
  for (const int slot : e.bodies().slot_of_number) {
    const Tensor virial = e.virial<ContactForce<TwoD>>(
        slot, static_cast<std::size_t>(e.bodies().shape_of_slot(slot).boundary_nodes));
    EXPECT_LT((virial - e.stress(slot)).norm(), 0.02 * size);
  }
}

INSTANTIATE_TEST_SUITE_P(Formulations, ParticleStressOf,
                         ::testing::Values("one-point", "four-point", "standard"));

// The same from the network: one force and one point a contact.
TEST(ParticleStress, FollowsFromTheNetworkOfContacts) {
  Pressed e("one-point");
  const auto& network = e.world().resource<ContactNetwork<TwoD>>();
  std::vector<Tensor> sum(25, Tensor::Zero());
  const auto add = [&](int number, const ContactLink<TwoD>& l, double side) {
    const int slot = e.bodies().slot_of_number[static_cast<std::size_t>(number)];
    const Vec2 arm(l.point[0] - e.of_particle<ParticleCentre<TwoD>>(slot, 0),
                   l.point[1] - e.of_particle<ParticleCentre<TwoD>>(slot, 1));
    sum[static_cast<std::size_t>(number)] += side * Vec2(l.force[0], l.force[1]) * arm.transpose() /
                                             (e.of_particle<DeformedSize<TwoD>>(slot) * 1e-3);
  };
  for (const ContactLink<TwoD>& l : network.pairs) add(l.first, l, 1), add(l.second, l, -1);
  for (const ContactLink<TwoD>& l : network.tools) add(l.first, l, 1);
  double size = 0;
  for (const int slot : e.bodies().slot_of_number) size += e.stress(slot).norm() / 25;
  for (std::size_t p = 0; p < 25; ++p)
    EXPECT_LT((sum[p] - e.stress(e.bodies().slot_of_number[p])).norm(), 0.05 * size) << p;
}

// Of the compact: balance of the tools' forces, whose mean over both ends is the mean over the height.
TEST(CompactStress, IsWhatTheToolsBear) {
  Experiment e("compaction/regular-25.toml", {"contact.friction=0", "output.particle_stress=true"});
  e.run(20);
  const double axial = 0.5 * (e.value("stress/axial_top") + e.value("stress/axial_bottom"));
  const double radial = 0.5 * (e.value("stress/radial_left") + e.value("stress/radial_right"));
  ASSERT_GT(axial, 100e6);
  EXPECT_NEAR(e.value("stress/yy") / -axial, 1, 0.01);
  EXPECT_NEAR(e.value("stress/xx") / -radial, 1, 0.01);
  EXPECT_NEAR(e.value("stress/xy") / axial, 0, 1e-6);
  EXPECT_NEAR(e.value("stress_ratio/axial"), axial / 240e6, 1e-12);
  EXPECT_NEAR(e.value("stress/transmission"),
              e.value("stress/axial_bottom") / e.value("stress/axial_top"), 1e-15);
  EXPECT_NEAR(e.value("stress/transmission"), 1, 0.01);  // no friction
}

// A block between frictionless platens under a uniform strain has one stress everywhere.
TEST(ParticleStress, OfAPatchTestIsUniform) {
  Experiment e("basic/patch-test.toml", {"output.particle_stress=true"});
  e.run(5);
  const double force = e.value("tool/top/force_y"), area = 10e-3 * e.scene.thickness;
  const Lane* stress = e.column<ParticleStress<TwoD>>().lanes();
  for (const int slot : e.simulation.world().resource<Bodies>().slot_of_number) {
    const Lane* of_slot = stress + slot / lane_count * 4;
    EXPECT_NEAR(of_slot[1][slot % lane_count] / (-force / area), 1, 0.01);
    EXPECT_NEAR(of_slot[0][slot % lane_count] / (force / area), 0, 0.01);
    EXPECT_NEAR(of_slot[3][slot % lane_count] / (force / area), 0, 0.001);
  }
}

}  // namespace
}  // namespace pulvis
