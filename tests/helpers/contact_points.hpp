// The Gauss points of contacts in a run, for tests that hold pressures and their widths against theory.
#pragma once

#include <cmath>

#include "systems/contact/contact_kernel.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {

struct ContactPoint {
  double x;              // m
  double normal, shear;  // N, along y and x: of contacts that lie level
};

// Half-width of a strip from the second moment of what acts on it, 1/4 a^2 for an ellipse: unlike the outermost
// touching point it does not come in steps of the mesh.
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

// Of every contact that touches and whose key (slot of the sampled body, edge, what it touches) is asked for.
template <class Place, class Asked, class Look>
void for_each_contact_point(const Experiment& e, const Asked& asked, const Look& look) {
  const auto& pair = e.column<ContactPair<Place>>();
  const auto& touches = e.column<ContactTouches<Place>>();
  const auto& force = e.column<PointForce<Place>>();
  const auto& curve = e.column<CurvePosition>();
  const Bodies& bodies = const_cast<Experiment&>(e).simulation.world().resource<Bodies>();
  for (std::size_t r = 0; r < pair.table.rows; ++r) {
    const std::int32_t* key = pair.values() + 3 * r;
    if (!asked(key) || touches.values()[r] == 0) continue;
    const auto& slot = bodies.slots[static_cast<std::size_t>(key[0])];
    const auto& edge = bodies.shape_of_slot(key[0]).edges[static_cast<std::size_t>(key[1])];
    const double* y = curve.values() + 2 * (slot.first_control + edge.first_control);
    for (std::size_t g = 0; g < 4; ++g) {
      const auto n = kernels::basis(kernels::edge_u[g]);
      look(ContactPoint{n[0] * y[0] + n[1] * y[2] + n[2] * y[4] + n[3] * y[6],
                        std::abs(force.values()[8 * r + 2 * g + 1]),
                        force.values()[8 * r + 2 * g]});
    }
  }
}

}  // namespace pulvis
