// Shared parts of packing tables in two and three dimensions.
#pragma once

#include "scenes/language/csv_table.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace pulvis {

// Index of the class named in a cell. Throws SceneError, as do all functions below.
int class_named_in(const csv::Table& table, std::size_t row, std::size_t column,
                   const std::vector<std::string>& names);
std::vector<double> scales_in(const csv::Table& table);  // 1 if the table has none
std::optional<double> top_in(const csv::Table& table);   // m, of `# top: 0.1 m`

template <class Particles>
int class_in(const csv::Table& table, std::size_t row, std::size_t column,
             const Particles& particles) {
  std::vector<std::string> names;
  for (const auto& particle : particles)
    if (particle.class_of < 0) names.push_back(particle.name);
  return class_named_in(table, row, column, names);
}

// The class name in the scene; for classes of one size, that of the class that was scaled.
template <class Particles>
const std::string& name_of_class(const Particles& particles,
                                 const typename Particles::value_type& own) {
  return own.class_of < 0 ? own.name : particles[static_cast<std::size_t>(own.class_of)].name;
}

template <class Particles, class Bodies>
bool any_scaled(const Particles& particles, const Bodies& bodies) {
  return std::ranges::any_of(bodies, [&](const auto& body) {
    return particles[static_cast<std::size_t>(body.particle)].class_of >= 0;
  });
}

}  // namespace pulvis
