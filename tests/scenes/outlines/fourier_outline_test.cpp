// Irregular outlines: their area, and the spectrum that they are asked for, measured on the outline of a scene.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "scenes/outlines/curve_of.hpp"
#include "scenes/outlines/outline.hpp"
#include "tests/helpers/right_scene.hpp"

namespace pulvis {
namespace {

using std::numbers::pi;
using Spectrum = std::vector<std::complex<double>>;

constexpr double diameter = 10e-3, aspect_ratio = 1.4, irregularity = 0.09, roughness = 0.01,
                 decay = 1.6;
constexpr int modes = 12;

Outline from_scene(const std::string& more) {
  std::string text = right_scene;
  const std::string disc =
      "outline = \"disc\"\ndiameter = \"10 mm\"\n\n[particle.mesh]\nboundary_edges = 40\nrings = "
      "1\n";
  text.replace(text.find(disc), disc.size(),
               "outline = \"fourier\"\ndiameter = \"10 mm\"\n" + more +
                   "\n[particle.mesh]\nboundary_edges = 96\n");
  return load_scene_text(text, "fourier.toml", {"packing[0].spacing=16 mm"})
      .scene.particles[0]
      .outline;
}

Outline irregular_grain(int variant) {
  return from_scene(
      "aspect_ratio = 1.4\nirregularity = 0.09\nroughness = 0.01\ndecay = 1.6\nmodes = 12\n"
      "variant = " +
      std::to_string(variant) + "\n");
}

// Where the ray from a point inside meets the polygon.
double radius_at(const std::vector<Vec2>& polygon, const Vec2& from, double angle) {
  const Vec2 ray(std::cos(angle), std::sin(angle));
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i] - from, b = polygon[(i + 1) % polygon.size()] - from;
    const double left = ray.x() * a.y() - ray.y() * a.x(),
                 right = ray.x() * b.y() - ray.y() * b.x();
    if (left > 0 || right <= 0) continue;
    const double share = left / (left - right);
    const double along = ray.dot(a + share * (b - a));
    if (along > 0) return along;
  }
  return 0;
}

// Amplitudes of the radius about a point over the mean radius, by a discrete transform.
Spectrum spectrum_about(const std::vector<Vec2>& polygon, const Vec2& from) {
  constexpr int angles = 96;
  Spectrum spectrum(modes + 4);
  for (int k = 0; k < angles; ++k) {
    const double angle = 2 * pi * k / angles, r = radius_at(polygon, from, angle);
    for (std::size_t n = 0; n < spectrum.size(); ++n)
      spectrum[n] +=
          (n == 0 ? 1.0 : 2.0) / angles * r * std::polar(1.0, static_cast<double>(n) * angle);
  }
  for (std::size_t n = 1; n < spectrum.size(); ++n) spectrum[n] /= spectrum[0];
  return spectrum;
}

// The pole of the descriptors is the point about which there is no mode 1; the outline's origin is its centroid.
Spectrum spectrum_of(const Outline& outline) {
  std::vector<Vec2> polygon = outline_polygon(outline, 1e-8 * diameter);
  for (Vec2& p : polygon) p = {p.x() / std::sqrt(aspect_ratio), p.y() * std::sqrt(aspect_ratio)};
  Vec2 pole = Vec2::Zero();
  Spectrum spectrum = spectrum_about(polygon, pole);
  for (int i = 0; i < 15; ++i) {
    const std::complex<double> aside = spectrum[0].real() * spectrum[1];
    pole += Vec2(aside.real(), aside.imag());
    spectrum = spectrum_about(polygon, pole);
  }
  return spectrum;
}

TEST(FourierOutline, HasTheSpectrumThatItsKeysSay) {
  for (const int variant : {1, 2, 3}) {
    const Spectrum spectrum = spectrum_of(irregular_grain(variant));
    for (int n = 1; n < static_cast<int>(spectrum.size()); ++n) {
      double wanted = 0;
      if (n >= 3 && n < 8) wanted = irregularity * std::pow(n / 3.0, -decay);
      if (n >= 8 && n <= modes) wanted = roughness * std::pow(n / 8.0, -decay);
      EXPECT_NEAR(std::abs(spectrum[static_cast<std::size_t>(n)]), wanted, 1e-7)
          << "mode " << n << " of variant " << variant;
    }
  }
}

TEST(FourierOutline, HasTheAreaOfTheCircleOfItsDiameter) {
  const double area = pi / 4 * diameter * diameter;
  for (int variant = 0; variant < 4; ++variant) {
    const Outline grain = irregular_grain(variant);
    EXPECT_NEAR(any_curve(grain).area() / area, 1, 1e-12) << variant;
    EXPECT_NEAR(outline_area(grain) / area, 1, 1e-12) << variant;
  }
}

TEST(FourierOutline, WithoutModesIsTheEllipseOfItsAspectRatio) {
  const double a = diameter / 2 * std::sqrt(2), b = diameter / 2 / std::sqrt(2);
  for (const Vec2& p : outline_polygon(from_scene("aspect_ratio = 2\n"), 1e-6))
    EXPECT_NEAR(std::hypot(p.x() / a, p.y() / b), 1, 1e-12);
}

TEST(FourierOutline, IsTheSameForAVariantAndAnotherForTheNext) {
  const auto points = [](int variant) { return outline_polygon(irregular_grain(variant), 1e-6); };
  EXPECT_EQ(points(5), points(5));
  const Spectrum five = spectrum_of(irregular_grain(5)), six = spectrum_of(irregular_grain(6));
  double apart = 0;
  for (std::size_t n = 3; n < 8; ++n)
    apart += std::abs(five[n] / six[n] - std::abs(five[n] / six[n]));
  EXPECT_GT(apart, 0.1);
}

}  // namespace
}  // namespace pulvis
