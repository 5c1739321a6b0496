#include "scenes/results/cooper_eaton.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <limits>

#include "scenes/solve/least_squares.hpp"

namespace pulvis {
namespace {

using Vector = Eigen::VectorXd;

constexpr double closest_ratio = 1.05;  // of k2 to k1; below it the two terms are treated as one

constexpr double min_k =
    1e-4;  // as shares of the largest pressure: beyond these a term is constant,
constexpr double max_k = 1e2;  // or zero, within the measured pressures

bool is_at_bound(double k) {
  constexpr double rounding = 1e-9;
  return k <= min_k * (1 + rounding) || k >= max_k * (1 - rounding);
}

double k_of(double log_k) { return std::clamp(std::exp(log_k), min_k, max_k); }

// exp(-k/P) of every sample. P and k are shares of the largest pressure here.
Vector shape_of(const Vector& p, double k) { return (-k / p.array()).exp(); }

// Best a1, a2 >= 0 for two given exponentials.
std::array<double, 2> best_shares(const Vector& first, const Vector& second, const Vector& y) {
  const double ff = first.squaredNorm(), ss = second.squaredNorm(), fs = first.dot(second);
  const double fy = first.dot(y), sy = second.dot(y);
  const double determinant = ff * ss - fs * fs;
  if (determinant > 1e-14 * ff * ss) {
    const double a = (fy * ss - sy * fs) / determinant, b = (sy * ff - fy * fs) / determinant;
    if (a >= 0 && b >= 0) return {a, b};
  }
  const double alone_first = ff > 0 ? std::max(0.0, fy / ff) : 0;
  const double alone_second = ss > 0 ? std::max(0.0, sy / ss) : 0;
  return alone_first * fy >= alone_second * sy ? std::array{alone_first, 0.0}
                                               : std::array{0.0, alone_second};
}

// Residuals for log k1, log k2 with the best a1, a2 inserted.
struct Remainder {
  const Vector& p;
  const Vector& y;

  void operator()(const Vector& log_k, Vector& remainder) const {
    const Vector first = shape_of(p, k_of(log_k[0])), second = shape_of(p, k_of(log_k[1]));
    const auto [a, b] = best_shares(first, second, y);
    remainder = a * first + b * second - y;
  }
};

struct Candidate {
  Vector log_k;
  double error = std::numeric_limits<double>::infinity();  // sum of squares
};

std::vector<Candidate> grid(const Remainder& remainder) {
  constexpr double coarsest = 10;  // k
  constexpr int steps = 15;
  const double step = std::log(coarsest / min_k) / (steps - 1);
  std::vector<Candidate> all;
  Vector left;
  for (int i = 0; i < steps; ++i)
    for (int j = i + 1; j < steps; ++j) {
      Candidate candidate{Vector(2), 0};
      candidate.log_k << std::log(min_k) + i * step, std::log(min_k) + j * step;
      remainder(candidate.log_k, left);
      candidate.error = left.squaredNorm();
      all.push_back(std::move(candidate));
    }
  std::ranges::sort(all, {}, &Candidate::error);
  return all;
}

void refine(const Remainder& remainder, Candidate& candidate) {
  Vector log_k = candidate.log_k, left;
  levenberg_marquardt(remainder, remainder.p.size(), {.evaluations = 400, .tolerance = 1e-14},
                      log_k);
  if (!log_k.allFinite()) return;
  remainder(log_k, left);
  if (left.squaredNorm() <= candidate.error) candidate = {log_k, left.squaredNorm()};
}

CooperEaton with_terms(const Candidate& best, const Vector& p, const Vector& y, double scale) {
  CooperEaton found;
  std::array k{k_of(best.log_k[0]), k_of(best.log_k[1])};
  auto a = best_shares(shape_of(p, k[0]), shape_of(p, k[1]), y);
  if (k[0] > k[1]) std::swap(k[0], k[1]), std::swap(a[0], a[1]);
  if (a[0] > 0 && a[1] > 0 && k[1] < closest_ratio * k[0]) {  // one term split in two
    a = {a[0] + a[1], 0};
    k[0] = std::sqrt(k[0] * k[1]);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    if (!(a[i] > 0)) continue;
    const auto term = static_cast<std::size_t>(found.terms);
    found.a[term] = a[i];
    found.k[term] = k[i] * scale;
    found.is_k_at_bound[term] = is_at_bound(k[i]);
    found.terms += 1;
  }
  return found;
}

}  // namespace

CooperEaton find_cooper_eaton(const std::vector<double>& pressure,
                              const std::vector<double>& value) {
  constexpr std::size_t refined = 6;
  const auto count = static_cast<Eigen::Index>(pressure.size());
  const double scale = *std::ranges::max_element(pressure);
  const Vector p = Eigen::Map<const Vector>(pressure.data(), count) / scale;
  const Vector y = Eigen::Map<const Vector>(value.data(), count);
  const Remainder remainder{p, y};
  std::vector<Candidate> candidates = grid(remainder);
  candidates.resize(refined);
  for (Candidate& candidate : candidates) refine(remainder, candidate);
  const Candidate& best = *std::ranges::min_element(candidates, {}, &Candidate::error);
  return with_terms(best, p, y, scale);
}

}  // namespace pulvis
