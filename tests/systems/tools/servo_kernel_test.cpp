// A tool that holds a force: what it moves with and drags along takes energy from whatever it pushes, in the
// discrete scheme and at any stiffness, damping and step; it reaches its force and keeps to its speed.
#include "systems/tools/servo_kernel.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <vector>

#include "systems/tools/tool_kernel.hpp"

namespace pulvis::kernels {
namespace {

// ---- a chain of masses under the tool -----------------------------------------------------------------
// The lowest stands on a spring, the uppermost bears the tool by a contact spring and its dashpot.
struct Chain {
  std::vector<double> spring;  // N/m, below each mass
  TouchSums contact;
  double mass = 1, dt = 0, safety = 0.9;

  int size() const { return static_cast<int>(spring.size()); }

  // 4 M - dt^2 K - 2 dt C with the tool at rest: the leapfrog is stable while it is positive.
  bool stable(double step) const {
    const int n = size();
    Eigen::MatrixXd q = 4 * mass * Eigen::MatrixXd::Identity(n, n);
    const auto add = [&](int i, double k) {
      q(i, i) -= step * step * k;
      if (i == 0) return;
      q(i - 1, i - 1) -= step * step * k;
      q(i, i - 1) += step * step * k;
      q(i - 1, i) += step * step * k;
    };
    for (int i = 0; i < n; ++i) add(i, spring[static_cast<std::size_t>(i)]);
    q(n - 1, n - 1) -= step * step * contact.stiffness + 2 * step * contact.damping;
    return q.selfadjointView<Eigen::Lower>().ldlt().vectorD().minCoeff() > 0;
  }
  void choose_step() {
    double low = 0, high = 1;
    while (stable(high)) high *= 2;
    for (int i = 0; i < 60; ++i) (stable(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
    dt = safety * low;
  }
};

Chain random_chain(std::mt19937_64& random) {
  const auto log = [&](double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<>()(random));
  };
  Chain chain;
  chain.spring.resize(1 + random() % 16);
  for (double& k : chain.spring) k = log(1e-3, 1e3);
  chain.contact.stiffness = log(1e-4, 1e4);
  if (random() % 4 != 0)
    chain.contact.damping = 2 * log(1e-3, 10) * std::sqrt(chain.contact.stiffness);
  chain.safety = std::uniform_real_distribution<>(0.3, 0.99)(random);
  chain.choose_step();
  return chain;
}

class Pressed {
 public:
  Pressed(const Chain& chain, double damping, double mass_over_least = 1)
      : chain_(chain), damping_(damping) {
    const auto n = static_cast<std::size_t>(chain.size());
    x_.resize(n), v_.resize(n);
    servo_.mass = mass_over_least * min_tool_mass(chain.contact, chain.dt, chain.safety);
  }

  void shake(std::mt19937_64& random) {
    std::normal_distribution<> any;
    for (double& x : x_) x = any(random);
    for (double& v : v_) v = any(random) / chain_.dt;
    tool_ = any(random), servo_.speed = any(random) / chain_.dt;
  }

  // One step of the powder's leapfrog and of the servo, as the program takes them.
  void step(double asked) {
    const std::size_t n = x_.size();
    borne_ = chain_.contact.stiffness * (x_.back() - tool_) +
             chain_.contact.damping * (v_.back() - servo_.speed);
    std::vector<double> force(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double f = chain_.spring[i] * (x_[i] - (i > 0 ? x_[i - 1] : 0));
      force[i] -= f + (i + 1 == n ? borne_ : 0);
      if (i > 0) force[i - 1] += f;
    }
    before_ = x_, tool_before_ = tool_;
    for (std::size_t i = 0; i < n; ++i)
      x_[i] += (v_[i] += chain_.dt * force[i] / chain_.mass) * chain_.dt;
    // It pushes towards lower x.
    ServoState down = servo_;
    down.speed *= -1, down.dragged *= -1;
    down = servo_step(down, asked - borne_, damping_, {1e300, 1e300}, chain_.dt);
    servo_ = {down.mass, -down.speed, -down.dragged};
    tool_ += servo_.speed * chain_.dt;
  }

  // That of the servo's head comment, of powder, contact and servo together, in the middle of the last step.
  double energy() const {
    const double dt = chain_.dt;
    const auto spring = [&](double k, double stretch, double before, double rate) {
      const double mean = 0.5 * (stretch + before);
      return 0.5 * k * (mean * mean - 0.25 * dt * dt * rate * rate);
    };
    double sum = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const auto below = [&](const std::vector<double>& of) { return i > 0 ? of[i - 1] : 0.0; };
      sum += 0.5 * chain_.mass * v_[i] * v_[i] + spring(chain_.spring[i], x_[i] - below(x_),
                                                        before_[i] - below(before_),
                                                        v_[i] - below(v_));
    }
    const double approach = v_.back() - servo_.speed, slip = servo_.speed - servo_.dragged;
    sum += spring(chain_.contact.stiffness, x_.back() - tool_, before_.back() - tool_before_,
                  approach);
    sum -= 0.25 * dt * chain_.contact.damping * approach * approach;
    sum += 0.25 * dt * damping_ * slip * slip;
    return sum + 0.5 * servo_.mass *
                     (servo_.speed * servo_.speed + dragged_mass * servo_.dragged * servo_.dragged);
  }
  double borne() const { return borne_; }

 private:
  Chain chain_;
  double damping_;
  std::vector<double> x_, v_, before_;
  double tool_ = 0, tool_before_ = 0, borne_ = 0;
  ServoState servo_{};
};

TEST(Servo, TakesEnergyFromEveryChainInEveryStep) {
  std::mt19937_64 random(1);
  for (int run = 0; run < 2000; ++run) {
    const Chain chain = random_chain(random);
    const double damping = std::pow(10, std::uniform_real_distribution<>(-4, 4)(random));
    const double more = std::pow(10, std::uniform_real_distribution<>(0, 4)(random));
    Pressed pressed(chain, damping, run % 2 == 0 ? 1 : more);
    pressed.shake(random);
    pressed.step(0);
    const double first = pressed.energy();
    double before = first;
    ASSERT_GT(first, 0);
    for (int i = 0; i < 300; ++i) {
      pressed.step(0);
      const double now = pressed.energy();
      ASSERT_LE(now, before + 1e-11 * first) << "run " << run << ", step " << i;
      ASSERT_GE(now, -1e-11 * first);
      before = now;
    }
  }
}

TEST(Servo, ReachesItsForceAndStaysThere) {
  std::mt19937_64 random(2);
  for (int run = 0; run < 20; ++run) {
    Chain chain;
    chain.spring.assign(12, 1);
    chain.contact.stiffness = std::pow(10, std::uniform_real_distribution<>(-0.5, 1)(random));
    chain.contact.damping = 0.4 * std::sqrt(chain.contact.stiffness);
    chain.choose_step();
    Pressed pressed(chain, 0.3, 1);
    double worst = 0;
    for (int i = 0; i < 8000; ++i) {
      pressed.step(10 * ramp_speed(std::min(i / 4000.0, 1.0)));
      if (i >= 4000) worst = std::max(worst, std::abs(pressed.borne() - 10));
    }
    EXPECT_LT(worst, 0.01) << "contact stiffness " << chain.contact.stiffness;
  }
}

// ---- the approach ---------------------------------------------------------------------------------------
// A column of masses between tool and floor. Its springs hold gaps open, then yield along F_y (exp(a x) - 1) and unload with
// the stiffness 1: a powder that keeps what it was pressed by.
class Column {
 public:
  Column(std::mt19937_64& random, bool loose) : springs_(count + 1), x_(count), v_(count) {
    const auto any = [&](double low, double high) {
      return std::uniform_real_distribution<>(low, high)(random);
    };
    const double hardening = any(5, 60);
    for (Spring& spring : springs_) {
      spring.gap = loose ? any(0, 0.1) : 0;
      spring.hardening = hardening * any(0.7, 1.4);
      spring.yield = target / (std::exp(spring.hardening * any(0.05, 0.2)) - 1);
    }
  }

  // The largest force over the target, after the time in which a wave passes `passages` times.
  double press(double passages, bool limited) {
    ServoState tool{0.02 * count, 0, 0};
    ServoResponse response;
    const ServoPowder powder{count, 1};
    double place = 0, peak = 0;
    for (double t = 0; t < passages * count; t += dt) {
      const double force = step(place, tool.speed);
      peak = std::max(peak, force);
      response = with_step(response, force, tool.speed * dt, dt, powder);
      const ServoAim aim{target, target, reached * target};
      const SpeedLimits limits = limited
                                     ? speed_limits(response, force, aim, tool.mass, 1e300, powder)
                                     : SpeedLimits{1e300, 1e300};
      const double asked = target * ramp_speed(std::min(1.0, t / (0.2 * passages * count)));
      tool = servo_step(tool, asked - force, 0.3, limits, dt);
      place += tool.speed * dt;
    }
    return peak / target;
  }

 private:
  static constexpr int count = 20;
  static constexpr double target = 2e-3,
                          dt = 0.5;  // in units of stiffness times spacing; wave times
  struct Spring {
    double gap = 0, yield = 0, hardening = 0, set = 0;
    double force(double pressed) {
      double elastic = pressed - gap - set;
      if (elastic <= 0) return 0;
      const double flow = yield * (std::exp(hardening * (pressed - gap)) - 1);
      if (elastic > flow) set += elastic - flow, elastic = flow;
      return elastic;
    }
  };

  double step(double place, double speed) {
    std::vector<double> force(springs_.size());
    for (std::size_t i = 0; i < force.size(); ++i) {
      const double above = i == 0 ? place : x_[i - 1], below = i == x_.size() ? 0 : x_[i];
      const double rate = (i == 0 ? speed : v_[i - 1]) - (i == x_.size() ? 0 : v_[i]);
      force[i] = springs_[i].force(above - below);
      if (force[i] > 0) force[i] += 0.02 * rate;
    }
    for (std::size_t i = 0; i < x_.size(); ++i) {
      v_[i] += dt * (force[i] - force[i + 1]);
      x_[i] += dt * v_[i];
    }
    return force[0];
  }

  std::vector<Spring> springs_;
  std::vector<double> x_, v_;
};

// Without the limit the worst of them is pressed by many times its force.
TEST(Servo, DoesNotPassItsForceOnAPowderThatKeepsIt) {
  for (const bool loose : {false, true}) {
    std::mt19937_64 random(3), same(3);
    double worst = 0, unlimited = 0;
    for (int run = 0; run < 12; ++run) {
      const double passages = 50 * std::pow(20, run / 11.0);
      worst = std::max(worst, Column(random, loose).press(passages, true));
      unlimited = std::max(unlimited, Column(same, loose).press(passages, false));
    }
    EXPECT_LT(worst, 1.05) << (loose ? "loose" : "touching");
    EXPECT_GT(unlimited, 1.5) << (loose ? "loose" : "touching");
  }
}

// A spring is approached exponentially; the limits are mirrored for a tensile target, and end near it.
TEST(Servo, ApproachesFasterTheSofterThePowder) {
  const ServoPowder powder{1, 10};
  const ServoAim push{100, 100, 5}, pull{-100, 100, 5};
  const auto forward = [&](double stiffness, double force) {
    return speed_limits({0, 0, stiffness, 1}, force, push, 0.1, 1e300, powder).forward;
  };
  EXPECT_DOUBLE_EQ(forward(0, 0), 2 * 100 / 10.0);
  EXPECT_GT(forward(2, 50), forward(8, 50));
  EXPECT_DOUBLE_EQ(forward(2, 50), 2 * forward(8, 50));
  EXPECT_DOUBLE_EQ(forward(1e9, 50), 50 / (2 * std::sqrt(powder.stiffest() * 1.1)));
  EXPECT_EQ(forward(1e9, 96), 1e300);
  EXPECT_EQ(speed_limits({0, 0, 1, 1}, 50, push, 0.1, 1e300, powder).backward, 1e300);
  EXPECT_DOUBLE_EQ(speed_limits({0, 0, 1, 1}, -50, pull, 0.1, 1e300, powder).backward, forward(1, 50));
}

// ---- its parts ------------------------------------------------------------------------------------------
TEST(Servo, MassThatComesAndGoesTakesEnergyAway) {
  const auto energy = [](const ServoState& s) {
    return s.mass * (s.speed * s.speed + dragged_mass * s.dragged * s.dragged);
  };
  const ServoState state{2, 3, -1};
  const ServoState heavier = with_mass(state, 3), lighter = with_mass(state, 1);
  EXPECT_DOUBLE_EQ(heavier.mass * heavier.speed, state.mass * state.speed);
  EXPECT_DOUBLE_EQ(heavier.mass * heavier.dragged, state.mass * state.dragged);
  EXPECT_LT(energy(heavier), energy(state));
  EXPECT_DOUBLE_EQ(lighter.mass, 2 * (1 - let_go));
  EXPECT_EQ(lighter.speed, state.speed);
  EXPECT_LT(energy(lighter), energy(state));
}

TEST(Servo, TheTangentOfTheContactIsNeverTakenTooSmall) {
  const double kappa = 3e13, g_s = 2e-5;
  for (const double x : {1e-6, 1e-3, 0.1, 0.5, 1.0, 2.0, 10.0}) {
    const double exact = 1 + 3 * x * x,
                 found = tangent_at(kappa * g_s * x * (1 + x * x), kappa, g_s);
    EXPECT_GE(found, exact * (1 - 1e-14));
    EXPECT_LE(found, exact * 1.05) << x;
  }
}

TEST(Servo, KeepsToItsSpeedAndDoesNotRunUp) {
  ServoState state{1, 0, 0};
  for (int i = 0; i < 1000; ++i) {
    state = servo_step(state, 1e9, 1, {2.0, 2.0}, 0.1);
    ASSERT_LE(state.speed, 2.0);
    ASSERT_LE(state.dragged, 2.0);
  }
  EXPECT_DOUBLE_EQ(state.speed, 2.0);
  // Turned round at once by what is missing now.
  EXPECT_LT(servo_step(state, -100, 1, {2.0, 2.0}, 0.1).speed, 0);
}

}  // namespace
}  // namespace pulvis::kernels
