// Checks of [[expect]]: series that exist, bounds that do not contradict each other, scenes to compare
// with that can be read.
#pragma once

#include <functional>

#include "engine/files/record.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/language/table_reader.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

// Figures of a whole run that an expectation may name like a series.
inline constexpr const char* figures_of_a_run[] = {"energy_balance_error", "kinetic_ratio"};
bool is_figure_of_a_run(const std::string& name);

// Every series of a run that an expectation may name: the history, and the momentum.
std::vector<SeriesInfo> expectable_series(const Scene& scene);

// Turns a bound written with a unit into a number in `unit` ("-": none). Returns what is wrong with it, as
// "what, allowed: ..."; nothing where it will do.
std::string settle_bound(std::optional<ExpectSpec::Bound>& bound, const std::string& unit);

std::filesystem::path other_scene(const Scene& scene, const ExpectSpec& expect);

// Also turns bounds with a unit into numbers. `read_other` reads a scene without what it expects.
void complete_and_check_expectations(
    Scene& scene, const std::function<Scene(const std::filesystem::path&)>& read_other,
    const schema::Origins& origins, Problems& problems);

}  // namespace pulvis
