// Every key of the study language is read and checked as a study's.
#include <unistd.h>

#include "cli/campaigns/study/declare_study.hpp"
#include "cli/campaigns/study/study_read.hpp"
#include "plan_checks.hpp"
#include "tests/helpers/paths.hpp"
#include "tests/helpers/program.hpp"

namespace pulvis::keys {
namespace {

namespace fs = std::filesystem;

const fs::path all_bases = fs::path(paths::source_dir()) / "tests" / "keys";

// A study is read from a file: in a folder of this process, with the scenes beside it.
std::string fault_of_study(const std::string& text, const fs::path&) {
  const fs::path place = fs::temp_directory_path() / ("pulvis-study-" + std::to_string(getpid()));
  fs::copy(all_bases, place, fs::copy_options::recursive | fs::copy_options::update_existing);
  std::ofstream(place / "studies" / "case.toml") << text;
  std::string fault = fault_in([&] { load_study(place / "studies" / "case.toml", {}); });
  fs::remove_all(place);
  return fault;
}

const Plan& plan() {
  static const Plan made =
      plan_or_fault(schema::study_language(), all_bases / "studies", fault_of_study);
  return made;
}

TEST(KeysOfStudies, AreAllUsed) { expect_all_used(plan(), "study", "tests/keys/studies"); }

class StudyKeys : public ProgramTest, public ::testing::WithParamInterface<Case> {};

TEST_P(StudyKeys, AreChecked) {
  fs::copy(all_bases, place, fs::copy_options::recursive);
  std::ofstream(place / "studies" / "case.toml") << GetParam().text;
  const Outcome outcome = pulvis({"study", "studies/case.toml", "--list"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
}

INSTANTIATE_TEST_SUITE_P(Of, StudyKeys, ::testing::ValuesIn(plan().cases),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace pulvis::keys
