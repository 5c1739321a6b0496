#include "scenes/scaled_outline.hpp"

namespace pulvis {
namespace {

DiscOutline scaled_by(double f, const DiscOutline& o) { return {f * o.diameter}; }
RectangleOutline scaled_by(double f, const RectangleOutline& o) {
  return {f * o.width, f * o.height};
}
RoundedRectangleOutline scaled_by(double f, const RoundedRectangleOutline& o) {
  return {f * o.width, f * o.height, f * o.radius};
}
RingOutline scaled_by(double f, const RingOutline& o) { return {f * o.diameter, f * o.hole}; }

}  // namespace

Outline scaled(const Outline& outline, double factor) {
  return std::visit([factor](const auto& o) -> Outline { return scaled_by(factor, o); }, outline);
}

}  // namespace pulvis
