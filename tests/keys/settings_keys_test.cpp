// Every key of the settings of `reduce`: what it keeps of them does the same again.
#include "cli/laboratory/lab_reduction.hpp"
#include "cli/laboratory/lab_settings.hpp"
#include "cli/laboratory/output/compression_output.hpp"
#include "cli/laboratory/output/die_output.hpp"
#include "cli/laboratory/output/volts_files.hpp"
#include "cli/laboratory/output/wedge_files.hpp"
#include "plan_checks.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/program.hpp"

namespace pulvis::keys {
namespace {

namespace fs = std::filesystem;

const fs::path bases = fs::path(paths::source_dir()) / "tests" / "keys" / "settings";
const fs::path records = fs::path(paths::source_dir()) / "scenes" / "lab";

std::string fault_of_settings(const std::string& text, const fs::path&) {
  return fault_in([&] {
    auto loaded = lab::load_settings_text(text, records / "case.toml", {});
    const lab::Settings& settings = loaded.settings;
    if (settings.volts.wanted()) {
      loaded.settings.volts.afm.draws = 1000;  // enough to tell whether the settings are fit
      volts_reduction(loaded);
      return;
    }
    if (!settings.wedge.loops.empty()) wedge_reduction(loaded);
    if (!settings.curves.empty()) compression_output(loaded, {});
    if (!settings.transmissions.empty()) die_output(loaded, {});
    for (const lab::RunSpec& run : settings.runs)
      lab::reduce(lab::read_press(records / run.press, settings),
                  lab::read_logger(records / run.logger, settings), settings.of_run(run),
                  {run.name, run.press, run.logger, run.offset});
  });
}

const Plan& plan() {
  static const Plan made = plan_or_fault(lab::language(), bases, fault_of_settings);
  return made;
}

TEST(KeysOfSettings, AreAllUsed) {
  expect_all_used(plan(), "file of settings", "tests/keys/settings");
}

class SettingsKeys : public ProgramTest, public ::testing::WithParamInterface<Case> {
 protected:
  void reduce(const std::string& settings, const std::string& folder) const {
    const Outcome outcome = pulvis({"reduce", settings, "-o", folder});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
  }
};

TEST_P(SettingsKeys, GoThroughSaveAndReduceAgain) {
  for (const auto& entry : fs::directory_iterator(records))
    if (entry.path().extension() == ".csv" || entry.path().extension() == ".json")
      fs::copy(entry.path(), place / entry.path().filename());
  std::ofstream(place / "case.toml") << GetParam().text;
  reduce("case.toml", "first");
  for (const auto& entry : fs::directory_iterator(place))
    if (entry.is_regular_file()) fs::remove(entry.path());
  fs::rename(place / "first", place / "moved où ça");
  reduce("moved où ça/reduce.toml", "again");
  for (const char* file : {"reduce.toml", "curves.csv", "facets.csv", "friction.csv",
                           "contributions.csv", "curve-one.csv", "slices.csv", "conditions.csv"})
    EXPECT_EQ(text_of(place / "moved où ça" / file), text_of(place / "again" / file)) << file;
}

INSTANTIATE_TEST_SUITE_P(Of, SettingsKeys, ::testing::ValuesIn(plan().cases),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace pulvis::keys
