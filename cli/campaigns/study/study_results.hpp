// Results of the runs of a study: read back from their folders for the table, curves and verdicts.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/campaigns/study/analysis/study_spec.hpp"

namespace pulvis {

enum class RunState { absent, unfinished, finished };  // finished: need not be run again

// Judged by summary.json: finished means the same scene (its hash), and a regular end.
RunState state_of(const std::filesystem::path& folder, std::uint64_t scene_hash);

// One run, after it ended or was found finished.
struct StudyResult {
  const StudyRun* run = nullptr;
  std::filesystem::path folder;
  bool kept = false;      // found already finished
  bool resumed = false;   // found interrupted, with a checkpoint to resume from
  std::string elsewhere;  // who runs it, if not this study; then its folder is not read
  int code = 0;           // exit code of the run; for a kept one, as it must have been
  std::string failure;    // why it is not usable; empty: good
  bool usable = false;    // it reached its end: its curves can be compared
  nlohmann::ordered_json summary = nlohmann::ordered_json::object();

  // A series of the study (cli/campaigns/study/analysis/study_series.hpp); empty if the run left none.
  const std::vector<double>& series(const std::string& name) const;

 private:
  mutable std::map<std::string, std::vector<double>> read_;
};

// Reads the result from the run's folder.
void read_result(StudyResult& result);

// study.csv: one row per run, one column per figure. Text is quoted where necessary.
std::string study_csv(const Study& study, const std::vector<StudyResult>& results);

// The figures of one run as shown in the table: name, unit, value (null: none).
struct Figure {
  std::string name, unit;
  nlohmann::ordered_json value;
};
std::vector<Figure> figures_of(const StudyResult& result);

// The keys that any run varies, and the values one run sets them to ("" if it does not).
std::vector<std::string> varied_keys(const Study& study);
std::string varied_value(const StudyRun& run, const std::string& key);

}  // namespace pulvis
