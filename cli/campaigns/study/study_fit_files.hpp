// Strength laws fitted across the runs, as text: for summary.json, fits.csv, strengths.csv and the
// terminal.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/campaigns/study/analysis/study_fits.hpp"

namespace pulvis {

nlohmann::ordered_json fits_json(const std::vector<FittedLaw>& laws);
std::string fits_csv(const std::vector<FittedLaw>& laws);  // one row per parameter
std::string strengths_csv(
    const std::vector<FittedLaw>& laws);  // one row per run, for strength laws
std::string sensitivities_csv(const std::vector<FittedLaw>& laws);  // the same, for power laws
bool is_power(const FittedLaw& law);
std::string fits_text(const std::vector<FittedLaw>& laws);  // one line per group

}  // namespace pulvis
