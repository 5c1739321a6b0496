// Contact between two deformable particles: forces from an energy, momentum, patch test.
#include <gtest/gtest.h>

#include <random>

#include "scenes/build.hpp"
#include "systems/step.hpp"
#include "systems/systems.hpp"

namespace pulvis {
namespace {

MaterialSpec steel() { return {"steel", 7850, 200e9, 0.3, {}, 0, {}}; }

Scene two_discs(double distance, double angle, double friction = 0) {
  Scene scene;
  scene.materials = {steel()};
  scene.particles = {{"disc", 0, DiscOutline{10e-3}, DiscMesh{40, 1, 1}, false, 0, {}}};
  BodySpec left, right;
  right.position = distance * Vec2(std::cos(angle), std::sin(angle));
  scene.bodies = {left, right};
  scene.stages = {{"stage", StageSpec::Kind::settle, 1e-3, {}, {}}};
  scene.contact.friction = friction;
  return scene;
}

// Contact forces and energy of a world at its present positions, without moving it.
struct Contacts {
  explicit Contacts(World& w) : world(w) {}
  void update() {
    TaskGraph(start_list(world), world.chunks()).run();
    world.resource<ContactIndex>().travel_at_bin = -1;  // positions were set by hand: bin anew
    std::vector<System> forces;
    for (System& system : step_list(world).forces)
      if (system.name == "bin_edges" || system.name == "note_binning" ||
          system.name == "edge_contact" || system.name == "contact_totals" ||
          system.name == "contact_force")
        forces.push_back(std::move(system));
    TaskGraph(std::move(forces), world.chunks()).run();
  }
  double energy() const { return world.resource<Totals>().contact_energy; }
  World& world;
};

TEST(Contact, ForceIsMinusTheGradientOfTheEnergy) {
  const auto world = build_world(two_discs(10e-3, 0.7));
  auto& x = world->column<Position>();
  const std::size_t nodes = x.table.rows;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> noise(-2e-6, 2e-6);
  for (std::size_t i = 0; i < 2 * nodes; ++i)
    for (int l = 0; l < 2; ++l) x.lanes()[i][l] += noise(random) + (l == 1 ? -12e-6 : 0);
  Contacts contacts(*world);
  contacts.update();
  ASSERT_GT(contacts.energy(), 0);
  const auto& f = world->column<ContactForce>();
  std::vector<Lane> force(f.lanes(), f.lanes() + 2 * f.table.rows);
  double largest = 0;
  for (const Lane& v : force) largest = std::max({largest, std::abs(v[0]), std::abs(v[1])});
  const double h = 1e-9;
  for (std::size_t i = 0; i < force.size(); ++i)
    for (int l = 0; l < 2; ++l) {
      const double was = x.lanes()[i][l];
      x.lanes()[i][l] = was + h;
      contacts.update();
      const double up = contacts.energy();
      x.lanes()[i][l] = was - h;
      contacts.update();
      const double down = contacts.energy();
      x.lanes()[i][l] = was;
      // Central differences of a quadratic energy with a kink where points touch: h / penetration.
      EXPECT_NEAR(-(up - down) / (2 * h), force[i][l], 2e-4 * largest)
          << "node " << i / 2 << " lane " << l;
    }
}

}  // namespace
}  // namespace pulvis
