// Checks of [[expect]]: the series exist, bounds do not contradict each other, and scenes to compare
// with can be read.
#pragma once

#include <functional>

#include "engine/files/record.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Values for a whole run that an expectation may name like a series.
inline constexpr const char* figures_of_a_run[] = {"energy_balance_error", "kinetic_ratio"};
bool is_figure_of_a_run(const std::string& name);

// Every series of a run that an expectation may name: history columns and momentum.
std::vector<SeriesInfo> expectable_series(const Scene& scene);

// Converts a bound written with a unit to a number in `unit` ("-": none). Returns what is wrong, as
// "what, allowed: ..."; an empty string if it is valid.
std::string settle_bound(std::optional<ExpectSpec::Bound>& bound, const std::string& unit);

std::filesystem::path other_scene(const Scene& scene, const ExpectSpec& expect);

// Also converts bounds with a unit to numbers. `read_other` reads a scene without its expectations.
void complete_and_check_expectations(
    Scene& scene, const std::function<Scene(const std::filesystem::path&)>& read_other,
    const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
