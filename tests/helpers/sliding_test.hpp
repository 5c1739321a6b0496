// A sliding-plate test whose truth is known, as the two instruments would record it.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "cli/laboratory/lab_friction.hpp"
#include "cli/laboratory/lab_reduction.hpp"

namespace pulvis::lab {

struct SlidingTest {
  double peak = 0.23, level = 0.18;              // static at `take_up`, dynamic from `settled` on
  double take_up = 0.52e-3, settled = 4e-3;      // m
  double slip_height = 0, slip_period = 2.4e-3;  // -, m, a sawtooth beyond `settled`
  double speed = 1.3e-3, distance = 50e-3;       // m/s, m
  double press_start = 23.35, logger_start = 6.21;  // s, of sliding, on either clock
  double drift = 0;                                 // seconds the press's clock gains each second
  double force = 1000, length = 10e-3;              // N, m
  double stress_ratio = 0.3 / 0.7;                  // -, K: elastic
  double settling = 3e-3;                           // m of punch travel for each m of the plate
  double noise = 0;                                 // times 1 um/m, 0.02 mV, 1 N, 0.5 um
  unsigned seed = 1;

  double friction(double x) const {
    if (x <= take_up) return peak * x / take_up;
    const double down = std::min(1.0, (x - take_up) / (settled - take_up));
    const double saw = x > settled ? std::fmod(x - settled, slip_period) / slip_period - 0.5 : 0;
    return peak + (level - peak) * down + slip_height * saw;
  }
  double plate(double logger_time) const {
    return std::clamp(speed * (logger_time - logger_start), 0.0, distance);
  }
  double lasts() const { return distance / speed; }
  double logger_time(double press_time) const {
    return logger_start + (press_time - press_start) / (1 + drift);
  }
  double press_time(double time) const { return press_start + (time - logger_start) * (1 + drift); }
  double punch(double t) const {  // loading of 2 s from 1.5 s on, then settling
    return 1.8e-3 * std::clamp((t - 1.5) / 2, 0.0, 1.0) + settling * plate(logger_time(t));
  }
  double shear(double time) const {  // (3.2) with (3.1), for the length that is left
    const double mu = friction(plate(time)), t = press_time(time);
    const double left = length - (punch(t) - punch(press_start));
    return mu * force * std::exp(-wall_exponent(stress_ratio, left, 15e-3) * mu);
  }

  PressRecord press() const {
    PressRecord record;
    std::mt19937 source(seed);
    std::normal_distribution<double> normal(0, noise);
    record.file = "press.csv";
    record.interval = 0.05;
    for (int i = 0; i * 0.05 < press_start + lasts() + 9; ++i) {
      const double t = i * 0.05;
      record.lines.push_back(i + 2);
      record.time.push_back(t);
      record.force.push_back(force * std::clamp((t - 1.5) / 2, 0.0, 1.0) + normal(source));
      record.displacement.push_back(punch(t) + 5e-7 * normal(source));
    }
    return record;
  }
  LoggerRecord logger() const {
    LoggerRecord record;
    std::mt19937 source(seed + 1000);
    std::normal_distribution<double> normal(0, noise);
    record.file = "logger.csv";
    record.interval = 0.1;
    for (int i = 0; i * 0.1 < logger_start + lasts() + 4; ++i) {
      const double t = i * 0.1;
      record.lines.push_back(i + 2);
      record.time.push_back(t);
      record.strain.push_back((shear(t) - 1.3795) / 0.7257e6 + 1e-6 * normal(source));
      record.lvdt.push_back(0.012 + 3.58 * plate(t) + 2e-5 * normal(source));
    }
    return record;
  }
};

inline Settings settings_of(const std::vector<std::string>& more = {}) {
  std::vector<std::string> all{"compact.length=10 mm", "compact.powder=316L"};
  all.insert(all.end(), more.begin(), more.end());
  return load_settings_text("", "reduce.toml", all).settings;
}

inline ReducedRun reduced(const SlidingTest& truth, const std::vector<std::string>& more = {},
                          std::optional<double> offset = {}) {
  return reduce(truth.press(), truth.logger(), settings_of(more), {"run-1", "p", "l", offset});
}

}  // namespace pulvis::lab
