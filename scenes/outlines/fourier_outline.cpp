#include "scenes/outlines/fourier_outline.hpp"

#include <cmath>
#include <numbers>

#include "engine/portable_math.hpp"
#include "scenes/outlines/curve_of.hpp"

namespace pulvis {
namespace {

using Mode = FourierModes::Mode;

double power_of(const std::vector<Mode>& modes) {
  double sum = 0;
  for (const Mode& mode : modes) sum += mode.cosine * mode.cosine + mode.sine * mode.sine;
  return sum;
}

}  // namespace

FourierModes fourier_modes(const FourierOutline& outline) {
  constexpr int first_irregular = 3, first_rough = 8;
  portable::Random random(outline.variant);
  FourierModes modes;
  for (int n = first_irregular; n <= outline.modes; ++n) {
    const bool irregular = n < first_rough;
    const double first = irregular ? first_irregular : first_rough;
    const double amplitude = portable::pow(n / first, -outline.decay);
    const double phase = random.between(0, 2 * std::numbers::pi);
    (irregular ? modes.irregular : modes.rough)
        .push_back({n, amplitude * portable::cos(phase), -amplitude * portable::sin(phase)});
  }
  return modes;
}

FourierSum sum_at(const std::vector<Mode>& modes, portable::Turn angle) {
  FourierSum sum;
  portable::V2 turned{1, 0};  // of n times the angle
  int n = 0;
  for (const Mode& mode : modes) {
    for (; n < mode.n; ++n) turned = angle * turned;
    sum.value += mode.cosine * turned.x + mode.sine * turned.y;
    sum.slope += n * (mode.sine * turned.x - mode.cosine * turned.y);
  }
  return sum;
}

OutlineCurve curve_of(const FourierOutline& outline) {
  FourierModes modes = fourier_modes(outline);
  if (outline.roughness == 0) modes.rough.clear();
  const double d3 = outline.irregularity, d8 = outline.roughness;
  // Area: pi r0^2 (1 + half the sum of D_n^2).
  const double power = d3 * d3 * power_of(modes.irregular) + d8 * d8 * power_of(modes.rough);
  const double r0 = 0.5 * outline.diameter / std::sqrt(1 + 0.5 * power);
  const double stretch = std::sqrt(outline.aspect_ratio);
  // At least two pieces per shortest wave, so that OutlineCurve::polygon misses none.
  const int count = 2 * (modes.rough.empty() ? modes.irregular : modes.rough).back().n;
  const double width = 2 * std::numbers::pi / count;
  std::vector<OutlineCurve::Piece> pieces;
  for (int piece = 0; piece < count; ++piece)
    pieces.push_back([=](double t) {
      const double angle = width * (piece + t);
      const portable::Turn turn{portable::cos(angle), portable::sin(angle)};
      const FourierSum irregular = sum_at(modes.irregular, turn), rough = sum_at(modes.rough, turn);
      const double r = r0 * (1 + d3 * irregular.value + d8 * rough.value);
      const double slope = r0 * (d3 * irregular.slope + d8 * rough.slope);
      const auto stretched = [&](double x, double y) { return Vec2(x * stretch, y / stretch); };
      return OutlineCurve::Point{
          stretched(r * turn.c, r * turn.s),
          width * stretched(slope * turn.c - r * turn.s, slope * turn.s + r * turn.c)};
    });
  return {std::move(pieces), false};
}

}  // namespace pulvis
