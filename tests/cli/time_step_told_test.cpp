// What `check` and the summary of a run say of the time step, against the history of the run.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "engine/files/hdf5.hpp"
#include "tests/helpers/program.hpp"

namespace pulvis {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class TimeStepTold : public ProgramTest {
 protected:
  json limits_of_a_run(const std::string& file) {
    EXPECT_EQ(pulvis({"run", file, "-o", "run"}).code, 0);
    return json::parse(text_of(place / "run" / "summary.json"))["time_step"];
  }
};

TEST_F(TimeStepTold, AgreesWithTheHistory) {
  for (const char* name : {"compaction/unit-cell.toml", "compaction-3d/one-sphere.toml"}) {
    std::filesystem::remove_all(place / "run");
    const json limits = limits_of_a_run(scene(name));
    const std::vector<double> dt =
        hdf5::File::open(place / "run" / "run.h5").read_doubles("/history/dt");
    ASSERT_GE(limits.size(), 2) << name;
    EXPECT_EQ(limits.front()["dt"], dt.front()) << name;
    EXPECT_EQ(limits.back()["when"], "end");
    // The history has steps that may still be growing, or ending a stage; none is longer than is stable.
    double shortest = limits.front()["stable"];
    for (const json& limit : limits) shortest = std::min(shortest, limit["stable"].get<double>());
    EXPECT_LE(*std::ranges::min_element(dt), 0.9 * shortest * 1.02) << name;
    EXPECT_LE(limits.back()["dt"], 0.9 * limits.back()["stable"].get<double>() * 1.02);
    const Outcome check = pulvis({"check", scene(name)});
    EXPECT_THAT(check.out + check.err,
                HasSubstr("time step: " + limits.front()["text"].get<std::string>()));
    EXPECT_THAT(check.out + check.err,
                HasSubstr("elements: " + limits.front()["slowest"].get<std::string>()));
  }
}

}  // namespace
}  // namespace pulvis
