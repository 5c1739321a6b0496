#include "bench/throughput/machine.hpp"

#include <benchmark/benchmark.h>
#include <immintrin.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

namespace pulvis::bench {
namespace {

// Measured until the last thread has finished its share.
double seconds_on(int threads, const std::function<void(int)>& work) {
  const auto start = std::chrono::steady_clock::now();
  {
    std::vector<std::jthread> others;
    for (int t = 1; t < threads; ++t) others.emplace_back(work, t);
    work(0);
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// ---- arithmetic -----------------------------------------------------------------------------------
// Each returns its operation count. Enough independent sums to hide the latency of a multiply-add.
constexpr int sums = 12;
constexpr std::int64_t rounds = 20'000'000;

__attribute__((target("avx512f"))) double multiply_add_512() {
  __m512d sum[sums], factor = _mm512_set1_pd(0.999), more = _mm512_set1_pd(1e-3);
  for (__m512d& s : sum) s = more;
  for (std::int64_t i = 0; i < rounds; ++i) {
#pragma GCC unroll 12
    for (__m512d& s : sum) s = _mm512_fmadd_pd(s, factor, more);
  }
  for (const __m512d& s : sum) benchmark::DoNotOptimize(s);
  return 2.0 * 8 * sums * rounds;
}

__attribute__((target("avx2,fma"))) double multiply_add_256() {
  __m256d sum[sums], factor = _mm256_set1_pd(0.999), more = _mm256_set1_pd(1e-3);
  for (__m256d& s : sum) s = more;
  for (std::int64_t i = 0; i < rounds; ++i) {
#pragma GCC unroll 12
    for (__m256d& s : sum) s = _mm256_fmadd_pd(s, factor, more);
  }
  for (const __m256d& s : sum) benchmark::DoNotOptimize(s);
  return 2.0 * 4 * sums * rounds;
}

double multiply_add_128() {
  __m128d sum[sums], factor = _mm_set1_pd(0.999), more = _mm_set1_pd(1e-3);
  for (__m128d& s : sum) s = more;
  for (std::int64_t i = 0; i < rounds; ++i) {
#pragma GCC unroll 12
    for (__m128d& s : sum) s = _mm_add_pd(_mm_mul_pd(s, factor), more);
  }
  for (const __m128d& s : sum) benchmark::DoNotOptimize(s);
  return 2.0 * 2 * sums * rounds;
}

double multiply_add() {
  if (__builtin_cpu_supports("avx512f")) return multiply_add_512();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return multiply_add_256();
  return multiply_add_128();
}

// ---- memory ---------------------------------------------------------------------------------------
struct Triad {
  static constexpr std::int64_t length = std::int64_t{1} << 23;  // 64 MiB per array
  static constexpr int passes = 4;

  std::unique_ptr<double[]> a{new double[length]}, b{new double[length]}, c{new double[length]};

  void fill() {
    for (std::int64_t i = 0; i < length; ++i) {
      a[i] = 0;
      b[i] = 1;
      c[i] = 2;
    }
  }
  void pass(int thread, int threads) {
    const double s = 3;
    const double *from = b.get(), *other = c.get();
    double* __restrict to = a.get();
    const std::int64_t end = length * (thread + 1) / threads;
    for (std::int64_t i = length * thread / threads; i < end; ++i) to[i] = from[i] + s * other[i];
    benchmark::ClobberMemory();
  }
};

}  // namespace

double peak_flops(int threads) {
  std::vector<double> done(static_cast<std::size_t>(threads));
  const double seconds = seconds_on(
      threads, [&](int thread) { done[static_cast<std::size_t>(thread)] = multiply_add(); });
  double sum = 0;
  for (const double d : done) sum += d;
  return sum / seconds;
}

double triad_bandwidth(int threads) {
  Triad triad;
  triad.fill();
  const double seconds = seconds_on(threads, [&](int thread) {
    for (int pass = 0; pass < Triad::passes; ++pass) triad.pass(thread, threads);
  });
  return 3.0 * sizeof(double) * Triad::length * Triad::passes / seconds;
}

std::string compiler() {
#ifdef __clang__
  return "clang++ " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

double resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  double all = 0, resident = 0;
  statm >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace pulvis::bench
