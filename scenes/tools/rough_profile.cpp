#include "scenes/tools/rough_profile.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/outlines/portable.hpp"

namespace pulvis {
namespace {

constexpr double kernel_reach = 3;  // correlation lengths; the kernel is exp(-18) there

std::vector<double> white_noise(std::uint64_t seed, std::size_t count) {
  constexpr double minimum = 1e-15;  // uniform() can be 0, whose quantile is infinite
  portable::Random random(seed);
  std::vector<double> noise(count);
  for (double& value : noise) value = portable::normal_quantile(random.between(minimum, 1));
  return noise;
}

// Filtered with the kernel, as if the row were periodic.
std::vector<double> smoothed(const std::vector<double>& noise) {
  const auto count = static_cast<int>(noise.size());
  const auto reach = static_cast<int>(kernel_reach * stations_a_length);
  std::vector<double> kernel;
  for (int k = -reach; k <= reach; ++k) {
    const double x = static_cast<double>(k) / stations_a_length;
    kernel.push_back(portable::exp(-2 * x * x));
  }
  std::vector<double> heights(noise.size());
  for (int i = 0; i < count; ++i)
    for (int k = -reach; k <= reach; ++k)
      heights[static_cast<std::size_t>(i)] +=
          kernel[static_cast<std::size_t>(k + reach)] *
          noise[static_cast<std::size_t>((i + k + count) % count)];
  return heights;
}

// Integral of |h| over a straight segment of length 1.
double magnitude(double from, double to) {
  if (from * to >= 0) return 0.5 * std::abs(from + to);
  return 0.5 * (from * from + to * to) / (std::abs(from) + std::abs(to));
}

}  // namespace

double arithmetic_roughness(const std::vector<Vec2>& points) {
  double mean = 0, sum = 0;
  const double length = points.back().x() - points.front().x();
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    mean +=
        0.5 * (points[i].y() + points[i + 1].y()) * (points[i + 1].x() - points[i].x()) / length;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    sum += magnitude(points[i].y() - mean, points[i + 1].y() - mean) *
           (points[i + 1].x() - points[i].x()) / length;
  return sum;
}

std::vector<double> rough_heights(double ra, std::uint64_t seed, int lengths) {
  const auto count = static_cast<std::size_t>(lengths * stations_a_length);
  std::vector<double> heights = smoothed(white_noise(seed, count));
  double mean = 0;
  for (const double h : heights) mean += h / static_cast<double>(count);
  std::vector<Vec2> period;
  for (std::size_t i = 0; i <= count; ++i)
    period.push_back({static_cast<double>(i), heights[i % count] - mean});
  const double scale = ra / arithmetic_roughness(period);
  for (double& h : heights) h = scale * (h - mean);
  return heights;
}

}  // namespace pulvis
