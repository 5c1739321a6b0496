// Statistics over the runs of a study: every variation over its seeds, and the main effect of every varied key.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/campaigns/study/study_results.hpp"

namespace pulvis {

// Runs that did not reach their end are not counted.
struct StudySample {
  std::size_t count = 0;
  double mean = 0;
  double deviation = 0;  // standard deviation, n - 1; 0 for one
};

struct NamedSample {
  std::string name, unit;
  StudySample sample;
};

struct VariationStatistics {
  std::string variation;
  std::vector<std::string> settings;  // of each varied key, in the order of varied_keys
  std::size_t runs = 0, of = 0;       // runs that reached their end, and all runs
  std::vector<NamedSample> values;
};

struct EffectLevel {
  std::string level;  // value of the key; empty: as in the scene
  std::size_t runs = 0;
  std::vector<NamedSample> values;
};

// The mean over all runs with a given level, whatever their other keys: the marginal mean.
struct MainEffect {
  std::string key;
  bool balanced = true;  // every level occurs equally often with each combination of other keys
  std::vector<EffectLevel> levels;
};

struct StudyStatistics {
  std::vector<VariationStatistics> variations;
  std::vector<MainEffect> effects;  // of keys with at least two levels
};

StudyStatistics statistics_of(const Study& study, const std::vector<StudyResult>& results);

nlohmann::ordered_json variations_json(const StudyStatistics& statistics);
nlohmann::ordered_json effects_json(const StudyStatistics& statistics);
std::string variations_csv(const Study& study, const StudyStatistics& statistics);
std::string effects_csv(const StudyStatistics& statistics);

}  // namespace pulvis
