// Whether the results of a run are reliable, and what to do where they are not: one table for all. The terminal
// prints it at the end of a run, summary.json (`quality`) stores it, and reports and studies read it there.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "engine/world.hpp"
#include "scenes/results/contact_findings.hpp"
#include "scenes/results/results.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

struct QualityFigure {
  std::string name, meaning;
  double value = 0;             // -
  std::optional<double> limit;  // -
  std::string advice;           // what to change; empty while the value is within its limit

  bool beyond() const { return limit && !(std::abs(value) <= *limit); }
  std::string line() const;  // "hourglass energy 5.4% (limit 3%)", and what to do
};

// The name of the figure that says how much of the energy released on unloading was in contact springs.
inline constexpr const char* release_figure = "Released energy in contact springs";
inline constexpr double most_in_springs = 0.15;  // its limit

// The keys that refine the meshes of a scene in two dimensions, whatever gives their present size: these replace `accuracy`,
// which may be "fine" already, or have no effect because the meshes have keys of their own.
std::string refining_keys(const Scene& scene);

// Omits those that the run does not have.
std::vector<QualityFigure> run_quality(const Scene& scene, const World& world,
                                       const Results& results, const ContactFindings& contacts);

}  // namespace pulvis
