#include "bench/throughput/limit.hpp"

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <vector>

#include "bench/throughput/limit_loop.hpp"

namespace pulvis::bench {
namespace {

constexpr int lanes = 4, settling = 25, timed = 80;  // steps
constexpr double youngs_modulus = 210e9, poissons_ratio = 0.3, density = 7850;
constexpr double mu = youngs_modulus / (2 * (1 + poissons_ratio));
constexpr double lambda = 2 * mu * poissons_ratio / (1 - 2 * poissons_ratio);

double shortest_edge(const Shape& shape) {
  double shortest = 1e300;
  for (const auto& q : shape.quads)
    for (std::size_t k = 0; k < 4; ++k) {
      const Point &a = entry(shape.nodes, q[k].value),
                  &b = entry(shape.nodes, q[(k + 1) % 4].value);
      shortest = std::min(shortest, std::hypot(a[0] - b[0], a[1] - b[1]));
    }
  return shortest;
}

LimitMaterial material_of(const Shape& shape) {
  const double speed = std::sqrt((lambda + 2 * mu) / density);
  const double dt = 0.8 * shortest_edge(shape) / speed;
  constexpr double hourglass = 0.05;  // of the elastic stiffness
  return {lambda, 2 * mu, 250e6, 1e9, hourglass / 8 * (lambda + 2 * mu) * dt, dt};
}

// All particles, four per block.
class Loop {
 public:
  Loop(const Shape& shape, int particles)
      : shape_(shape), blocks_((particles + lanes - 1) / lanes), material_(material_of(shape)) {
    for (const auto& q : shape.quads) {
      LimitQuad& quad = quads_.emplace_back();
      for (std::size_t k = 0; k < 4; ++k) quad.node[k] = static_cast<unsigned short>(q[k].value);
    }
    for (const double area : shape.nodal_area) inv_mass_.push_back(1 / (density * area));
    nodes_.resize(static_cast<std::size_t>(blocks_) * shape.nodes.size());
    elements_.resize(static_cast<std::size_t>(blocks_) * quads_.size());
  }
  int blocks() const { return blocks_; }

  // Every particle is compressed at a different speed.
  void start(int first, int last) {
    const double radius = std::sqrt(shape_.area / 3.14159265358979);
    for (int b = first; b < last; ++b) {
      for (std::size_t i = 0; i < shape_.nodes.size(); ++i) {
        const auto [x, y] = shape_.nodes[i];
        LimitNode& n = nodes_of(b)[i];
        for (int l = 0; l < lanes; ++l) {
          const double rate = (40 + (b * lanes + l) * 37 % 101) / radius;
          n.x[l] = x, n.y[l] = y, n.u[l] = rate * x, n.v[l] = -rate * y;
        }
      }
      std::fill_n(elements_of(b), quads_.size(), LimitElement{});
    }
  }
  void step(int first, int last, std::vector<LimitForce>& force) {
    const LimitMesh mesh{quads_.data(), inv_mass_.data(), static_cast<int>(quads_.size()),
                         static_cast<int>(inv_mass_.size())};
    for (int b = first; b < last; ++b)
      limit_step(nodes_of(b), elements_of(b), force.data(), mesh, material_);
  }
  // Fraction of elements that have yielded.
  double flowed() const {
    double count = 0;
    for (const LimitElement& e : elements_)
      for (int l = 0; l < lanes; ++l) count += e.eps[l] > 0;
    return count / (lanes * static_cast<double>(elements_.size()));
  }
  std::size_t nodes() const { return shape_.nodes.size(); }

 private:
  LimitNode* nodes_of(int b) { return nodes_.data() + static_cast<std::size_t>(b) * nodes(); }
  LimitElement* elements_of(int b) {
    return elements_.data() + static_cast<std::size_t>(b) * quads_.size();
  }
  const Shape& shape_;
  int blocks_;
  LimitMaterial material_;
  std::vector<LimitQuad> quads_;
  std::vector<double> inv_mass_;
  std::vector<LimitNode> nodes_;
  std::vector<LimitElement> elements_;
};

// Barrier for threads after every step. Threads spin, since a step takes about 60 microseconds, and sleep only if
// another process occupies the core of the missing one.
class Meeting {
 public:
  explicit Meeting(int threads) : threads_(threads) {}
  void wait() {
    const int round = round_.load(std::memory_order_acquire);
    if (here_.fetch_add(1, std::memory_order_acq_rel) == threads_ - 1) {
      here_.store(0, std::memory_order_relaxed);
      round_.store(round + 1, std::memory_order_release);
    } else {
      for (int i = 0; round_.load(std::memory_order_acquire) == round; ++i)
        i < patience ? __builtin_ia32_pause() : std::this_thread::yield();
    }
  }

 private:
  static constexpr int patience = 10'000;  // about 100 microseconds
  int threads_;
  alignas(64) std::atomic<int> here_{0};
  alignas(64) std::atomic<int> round_{0};
};

// The t-th core available to the process: two spinning threads must not share one core.
void keep_to_processor(int t) {
  cpu_set_t allowed, one;
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
  CPU_ZERO(&one);
  for (int cpu = 0, seen = 0; cpu < CPU_SETSIZE; ++cpu)
    if (CPU_ISSET(cpu, &allowed) && seen++ == t) CPU_SET(cpu, &one);
  if (CPU_COUNT(&one) == 1) pthread_setaffinity_np(pthread_self(), sizeof one, &one);
}

// Work of one thread: `rounds` times a start, steps into the plastic range, timed steps. Returns their seconds.
double run(Loop& loop, Meeting& meeting, int rounds, int thread, int threads) {
  using Time = std::chrono::steady_clock;
  const int first = loop.blocks() * thread / threads, last = loop.blocks() * (thread + 1) / threads;
  std::vector<LimitForce> force(loop.nodes());
  const auto steps = [&](int count) {
    for (int i = 0; i < count; ++i) {
      loop.step(first, last, force);
      meeting.wait();
    }
  };
  double seconds = 0;
  for (int round = 0; round < rounds; ++round) {
    loop.start(first, last);
    steps(settling);
    const auto from = Time::now();
    steps(timed);
    seconds += std::chrono::duration<double>(Time::now() - from).count();
  }
  return seconds;
}

}  // namespace

bool has_limit() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }

double limit_seconds(const Shape& shape, int particles, int steps, int threads) {
  Loop loop(shape, particles);
  Meeting meeting(threads);
  const int rounds = std::max(1, steps / timed);
  std::vector<double> seconds(static_cast<std::size_t>(threads));
  {
    std::vector<std::jthread> all;
    for (int t = 0; t < threads; ++t)
      all.emplace_back([&, t] {
        if (threads > 1) keep_to_processor(t);
        seconds[static_cast<std::size_t>(t)] = run(loop, meeting, rounds, t, threads);
      });
  }
  if (!(loop.flowed() > 0.5)) throw std::runtime_error("limit: the particles do not flow");
  return seconds[0] * steps / (rounds * timed);
}

}  // namespace pulvis::bench
