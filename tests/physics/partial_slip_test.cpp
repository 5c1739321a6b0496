// Cattaneo (1938), Mindlin (1949): a pressed contact under a tangential force sticks in the middle.
#include <gtest/gtest.h>

#include "systems/contact/contact_kernel.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

// Half-width of a strip from the second moment of what acts on it: 1/4 a^2 for an ellipse.
struct Moments {
  double sum = 0, first = 0, second = 0;
  void add(double weight, double x) {
    sum += weight;
    first += weight * x;
    second += weight * x * x;
  }
  double half_width() const {
    const double mean = first / sum;
    return 2 * std::sqrt(second / sum - mean * mean);
  }
};

struct Strip {
  Moments pressure;  // mu p
  Moments deficit;   // mu p - q: what friction could still carry, an ellipse over the stick zone
};

// The contact as the lower disc samples it (half of every force: the other half is the upper one's).
Strip contact_of(const Experiment& e, double mu) {
  const auto& pair = e.column<ContactPair<Contact>>();
  const auto& touches = e.column<ContactTouches<Contact>>();
  const auto& force = e.column<PointForce<Contact>>();
  const auto& curve = e.column<CurvePosition>();
  const Bodies& bodies = const_cast<Experiment&>(e).simulation.world().resource<Bodies>();
  Strip strip;
  for (std::size_t r = 0; r < pair.table.rows; ++r) {
    const std::int32_t* key = pair.values() + 3 * r;
    if (key[0] != bodies.slot_of_number[0] || touches.values()[r] == 0) continue;
    const auto& slot = bodies.slots[static_cast<std::size_t>(key[0])];
    const auto& edge = bodies.shape_of_slot(key[0]).edges[static_cast<std::size_t>(key[1])];
    const double* y = curve.values() + 2 * (slot.first_control + edge.first_control);
    for (std::size_t g = 0; g < 4; ++g) {
      const auto n = kernels::basis(kernels::edge_u[g]);
      const double x = n[0] * y[0] + n[1] * y[2] + n[2] * y[4] + n[3] * y[6];
      const double q = force.values()[8 * r + 2 * g];  // the contact is level to 0.04 rad
      const double p = mu * std::abs(force.values()[8 * r + 2 * g + 1]);
      if (p <= 0) continue;
      strip.pressure.add(p, x);
      strip.deficit.add(p - q, x);
    }
  }
  return strip;
}

TEST(PartialSlip, StickZoneOfCattaneoAndMindlin) {
  Experiment e("benchmark/cattaneo-mindlin.toml");
  const double mu = e.scene.contact.friction;
  const double end = e.simulation.clock().end;
  int looks = 0;
  e.run(80, [&] {
    const double P = e.value("tool/base/force_y");
    const double Q = e.value("tool/base/force_x");
    const double share = std::abs(Q / (mu * P));
    if (e.simulation.clock().time < 0.2 * end || share < 0.2 || share > 0.6) return;
    const Strip strip = contact_of(e, mu);
    const double c_over_a = strip.deficit.half_width() / strip.pressure.half_width();
    // The edge of the stick zone is known to a Gauss point, some 0.1 a apart from the next.
    EXPECT_NEAR(c_over_a / std::sqrt(1 - share), 1, 0.05) << share;
    looks += 1;
  });
  EXPECT_GT(looks, 10);
}

}  // namespace
}  // namespace pulvis
