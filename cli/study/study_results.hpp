// What the runs of a study left in their folders: read back for the table, the curves and the verdicts.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scenes/study/study.hpp"

namespace pulvis {

enum class RunState { absent, unfinished, finished };  // finished: there is nothing to run again

// Judged by summary.json: of the same scene (its hash), and ended by itself.
RunState state_of(const std::filesystem::path& folder, std::uint64_t scene_hash);

// One run, after it ended or was found finished.
struct StudyResult {
  const StudyRun* run = nullptr;
  std::filesystem::path folder;
  bool kept = false;     // found finished
  bool resumed = false;  // found broken off, with a checkpoint to go on from
  std::string
      elsewhere;  // who runs it, where that is not this study; then nothing of its folder is read
  int code = 0;   // exit code of the run; of a kept one as it must have been
  std::string failure;  // why it is not as it should be; empty: good
  bool usable = false;  // it reached its end: its curves can be compared
  nlohmann::ordered_json summary = nlohmann::ordered_json::object();

  // A series of the study (scenes/study/study_series.hpp); empty where the run has left none.
  const std::vector<double>& series(const std::string& name) const;

 private:
  mutable std::map<std::string, std::vector<double>> read_;
};

// Fills in what the folder tells.
void read_result(StudyResult& result);

// study.csv: one row a run, one column a figure. Text is quoted where it has to be.
std::string study_csv(const Study& study, const std::vector<StudyResult>& results);

// The figures of one run as they stand in the table: name, unit, value (null: it has none).
struct Figure {
  std::string name, unit;
  nlohmann::ordered_json value;
};
std::vector<Figure> figures_of(const StudyResult& result);

// The keys that some run varies, and what one run sets them to ("" where it does not).
std::vector<std::string> varied_keys(const Study& study);
std::string varied_value(const StudyRun& run, const std::string& key);

}  // namespace pulvis
