// A key that is declared and can be read is put into a base; one that no base takes is named.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "key_plan.hpp"
#include "scenes/keys/declare.hpp"

namespace pulvis::keys {
namespace {

namespace fs = std::filesystem;
using schema::Kind;

class KeyPlan : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder);
    std::ofstream(folder / "base.toml") << "shape = \"round\"\nradius = \"2 mm\"\n";
  }
  void TearDown() override { fs::remove_all(folder); }

  // Of a reader that takes anything but a key called "odd".
  static std::string fault(const std::string& text, const fs::path&) {
    return text.find("odd") == std::string::npos ? "" : "odd: unknown key";
  }

  const fs::path folder =
      fs::temp_directory_path() / ("pulvis-key-plan-" + std::to_string(getpid()));
  schema::TableView top{
      {"", false, "shape", ""},
      {{.name = "shape", .kind = Kind::choice, .choices = {{"round", ""}, {"square", ""}}},
       {.name = "radius", .kind = Kind::quantity, .unit = "m", .only_for = "round"}}};
};

TEST_F(KeyPlan, TheBasesOwnKeysAreUsedAndItsOtherWordsPutIn) {
  const Plan plan = plan_for({top}, folder, fault);
  EXPECT_TRUE(plan.missing.empty());
  ASSERT_EQ(plan.cases.size(), 2U);
  EXPECT_TRUE(plan.cases[0].settings.empty());
  EXPECT_EQ(plan.cases[1].settings, std::vector<std::string>{"shape=\"square\""});
}

TEST_F(KeyPlan, ANewKeyIsPutInByItself) {
  top.keys.push_back({.name = "damping",
                      .kind = Kind::number,
                      .range = schema::within(0, 1),
                      .fallback = schema::value_of(0.5)});
  top.keys.push_back({.name = "length", .kind = Kind::quantity, .unit = "m"});
  const Plan plan = plan_for({top}, folder, fault);
  EXPECT_TRUE(plan.missing.empty());
  ASSERT_EQ(plan.cases.size(), 3U);
  EXPECT_EQ(plan.cases[1].settings,
            (std::vector<std::string>{"damping=0.625", "length=\"0.0002 m\""}));
}

TEST_F(KeyPlan, AKeyThatNoBaseTakesIsNamed) {
  top.keys.push_back({.name = "odd", .kind = Kind::flag});
  top.keys.push_back({.name = "data", .kind = Kind::file});
  top.keys.push_back({.name = "edge", .kind = Kind::quantity, .unit = "m", .only_for = "square"});
  Uses missing = plan_for({top}, folder, fault).missing;
  EXPECT_TRUE(missing.erase({"", "odd", ""}));
  EXPECT_TRUE(missing.erase({"", "data", ""}));
  EXPECT_TRUE(missing.empty());
}

TEST_F(KeyPlan, ABaseThatIsRefusedIsNamed) {
  std::ofstream(folder / "wrong.toml") << "odd = 1\n";
  const Plan plan = plan_for({top}, folder, fault);
  EXPECT_EQ(plan.faults, std::vector<std::string>{"wrong.toml: odd: unknown key"});
}

}  // namespace
}  // namespace pulvis::keys
