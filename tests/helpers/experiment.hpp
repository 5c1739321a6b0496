// A shipped scene run inside a test: the same reader, builder and step as the program's.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "components/contact.hpp"
#include "scenes/read.hpp"
#include "scenes/results/results.hpp"
#include "scenes/simulation.hpp"

#include "tests/helpers/paths.hpp"

namespace pulvis {

// A scene of a test's own, which may extend those of scenes/.
inline Scene own_scene(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return load_scene_text(text, paths::source_dir() + "/scenes/of-a-test.toml", overrides).scene;
}

class Experiment {
 public:
  explicit Experiment(const std::string& scene_file, const std::vector<std::string>& overrides = {},
                      int threads = 1)
      : Experiment(read_scene(paths::source_dir() + "/scenes/" + scene_file, overrides), threads) {}
  explicit Experiment(Scene given, int threads = 1)
      : scene(std::move(given)), simulation(scene, threads), results(scene, simulation.world()) {}

  // Runs to the end with `samples` observations; `look` is called after each.
  template <class Look>
  void run(int samples, const Look& look) {
    const double end = simulation.clock().end;
    for (int i = 0; i <= samples; ++i) {
      simulation.run_until(i < samples ? end * i / samples : end);
      simulation.observe();
      row = results.sample();
      look();
      if (i < samples) simulation.move();
    }
  }
  void run(int samples = 50) {
    run(samples, [] {});
  }

  double value(const std::string& series) const { return results.value(series); }
  // Of a frame of now.
  std::vector<double> field(const std::string& name) const {
    const auto& fields = results.fields();
    const auto at = std::ranges::find(fields, name, &FieldInfo::name) - fields.begin();
    return results.frame().at(static_cast<std::size_t>(at));
  }
  template <class C>
  const Column<C>& column() const {
    return const_cast<Simulation&>(simulation).world().column<C>();
  }

  Scene scene;
  Simulation simulation;
  Results results;
  std::vector<double> row;
};

// Linear interpolation of y at x in a curve with rising x.
inline double at(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  for (std::size_t i = 1; i < xs.size(); ++i)
    if (xs[i] >= x) return ys[i - 1] + (ys[i] - ys[i - 1]) * (x - xs[i - 1]) / (xs[i] - xs[i - 1]);
  return ys.back();
}

}  // namespace pulvis
