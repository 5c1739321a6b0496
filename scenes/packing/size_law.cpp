#include "scenes/packing/size_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

#include "scenes/language/csv_table.hpp"
#include "scenes/outlines/portable.hpp"

namespace pulvis {
namespace {

constexpr int samples = 256;         // for every part of a law, by the midpoint rule
constexpr double normal_limits = 3;  // standard deviations from the mean, by default

constexpr double min_size = 1e-12;  // m, of a sieve: smaller sizes are not a powder

using Quantile = std::function<double(double)>;  // size as a function of the smaller share

Quantile uniform(const SizeLaw& law) {
  return [a = *law.minimum, b = *law.maximum](double p) { return a + (b - a) * p; };
}

// The part of the standard normal distribution between two limits.
Quantile cut_normal(double low, double high) {
  const double from = portable::normal_probability(low);
  const double to = portable::normal_probability(high);
  return [=](double p) { return portable::normal_quantile(from + (to - from) * p); };
}

Quantile normal(const SizeLaw& law) {
  const auto standard = [&](std::optional<double> size, double otherwise) {
    return size ? (*size - law.mean) / law.deviation : otherwise;
  };
  const Quantile z =
      cut_normal(standard(law.minimum, -normal_limits), standard(law.maximum, normal_limits));
  return [=, m = law.mean, d = law.deviation](double p) { return m + d * z(p); };
}

// For mean m and deviation s of the size itself: sigma^2 = log(1 + s^2/m^2), mu = log m - sigma^2/2.
Quantile lognormal(const SizeLaw& law) {
  const double ratio = law.deviation / law.mean;
  const double variance = portable::log(1 + ratio * ratio), sigma = std::sqrt(variance);
  const auto standard = [&](std::optional<double> size, double otherwise) {
    return size ? (portable::log(*size / law.mean) + variance / 2) / sigma : otherwise;
  };
  constexpr double far = 8;  // where the law ends in double precision
  const Quantile z = cut_normal(standard(law.minimum, -far), standard(law.maximum, far));
  return [=, m = law.mean](double p) { return m * portable::exp(sigma * z(p) - variance / 2); };
}

Quantile sieved(const SieveCurve& curve) {
  return [&curve](double p) {
    std::size_t i = 1;
    while (i + 1 < curve.size() && curve[i].passing < p) ++i;
    const SievePoint a = curve[i - 1], b = curve[i];
    return a.size + (b.size - a.size) * (p - a.passing) / (b.passing - a.passing);
  };
}

Quantile quantile_of(const SizeLaw& law, const SieveCurve& curve) {
  switch (law.kind) {
    case SizeLaw::Kind::normal:
      return normal(law);
    case SizeLaw::Kind::lognormal:
      return lognormal(law);
    case SizeLaw::Kind::sieve:
      return sieved(curve);
    default:
      return uniform(law);
  }
}

void check_point(const csv::Table& table, std::size_t i, const SieveCurve& curve) {
  const SievePoint p = curve[i];
  const auto refuse = [&](const char* column, const std::string& message) {
    csv::refuse(table, i, csv::column_at(table, column), message);
  };
  if (p.size < min_size)
    refuse("size", fmt::format("size {:g} m, allowed: >= {:g} m", p.size, min_size));
  if (p.passing < 0 || p.passing > 1)
    refuse("passing", fmt::format("passing {:g}, allowed: from 0 to 1", p.passing));
  if (i == 0 && p.passing != 0)
    refuse("passing",
           fmt::format("{:g} pass the smallest sieve, allowed: 0 in the first row", p.passing));
  if (i > 0 && p.size <= curve[i - 1].size)
    refuse("size",
           fmt::format("size {:g} m is not above that of the previous row, allowed: > {:g} m",
                       p.size, curve[i - 1].size));
  if (i > 0 && p.passing < curve[i - 1].passing)
    refuse("passing",
           fmt::format("passing {:g} is below that of the previous row, allowed: >= {:g}",
                       p.passing, curve[i - 1].passing));
  if (i + 1 == curve.size() && p.passing != 1)
    refuse("passing",
           fmt::format("{:g} pass the largest sieve, allowed: 1 in the last row", p.passing));
}

}  // namespace

SieveCurve read_sieve_curve(const std::filesystem::path& file) {
  const csv::Table table = csv::read(file);
  csv::only(table, {"size", "passing"});
  const std::vector<double> size = csv::numbers(table, csv::column_at(table, "size"), "m"),
                            passing = csv::numbers(table, csv::column_at(table, "passing"), "");
  SieveCurve curve;
  for (std::size_t i = 0; i < size.size(); ++i) curve.push_back({size[i], passing[i]});
  for (std::size_t i = 0; i < curve.size(); ++i) check_point(table, i, curve);
  if (curve.size() < 2) csv::refuse(table, 0, 0, "one sieve, allowed: at least two");
  // Flat parts at the ends contain no particles and have no quantile.
  while (curve[1].passing == 0) curve.erase(curve.begin());
  while (curve[curve.size() - 2].passing == 1) curve.pop_back();
  return curve;
}

std::vector<SizeShare> sizes_of(const SizeLaw& law, const SieveCurve& curve, int count,
                                int dimensions) {
  const Quantile quantile = quantile_of(law, curve);
  const bool by_content = law.kind == SizeLaw::Kind::sieve;
  std::vector<SizeShare> shares;
  double whole = 0;
  for (int part = 0; part < count; ++part) {
    double sum = 0;  // of areas or volumes, or of numbers for one area or volume
    for (int i = 0; i < samples; ++i) {
      const double size = quantile((part + (i + 0.5) / samples) / count);
      const double content = dimensions == 3 ? size * size * size : size * size;
      sum += by_content ? 1 / content : content;
    }
    const double mean = by_content ? samples / sum : sum / samples;
    shares.push_back(
        {dimensions == 3 ? portable::cbrt(mean) : std::sqrt(mean), by_content ? sum : 1});
    whole += shares.back().share;
  }
  for (SizeShare& share : shares) share.share /= whole;
  return shares;
}

std::vector<int> apportioned(int total, const std::vector<double>& shares) {
  const double whole = std::accumulate(shares.begin(), shares.end(), 0.0);
  std::vector<int> numbers;
  std::vector<std::pair<double, std::size_t>> rest;  // negative remainder: largest first
  int given = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double wanted = total * (shares[i] / whole);
    numbers.push_back(static_cast<int>(wanted));
    given += numbers.back();
    rest.emplace_back(numbers.back() - wanted, i);
  }
  std::stable_sort(rest.begin(), rest.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; given < total; ++i, ++given) ++numbers[rest[i % rest.size()].second];
  return numbers;
}

}  // namespace pulvis
