// Cattaneo (1938), Mindlin (1949): a pressed contact under a tangential force sticks in the middle.
#include <gtest/gtest.h>

#include "tests/helpers/contact_points.hpp"

namespace pulvis {
namespace {

struct Strip {
  Moments pressure;  // mu p
  Moments deficit;   // mu p - q: what friction could still carry, an ellipse over the stick zone
};

// The contact as the lower disc samples it (half of every force: the other half is the upper one's).
Strip contact_of(const Experiment& e, double mu) {
  const int lower =
      const_cast<Experiment&>(e).simulation.world().resource<Bodies>().slot_of_number[0];
  Strip strip;
  for_each_contact_point<Contact>(
      e, [&](const std::int32_t* key) { return key[0] == lower; },
      [&](const ContactPoint& point) {  // the contact is level to 0.04 rad
        const double p = mu * point.normal;
        if (p <= 0) return;
        strip.pressure.add(p, point.x);
        strip.deficit.add(p - point.shear, point.x);
      });
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
