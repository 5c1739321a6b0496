// Results as tables: a value belongs to the row that describes it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "scenes/results/history_series.hpp"
#include "tests/helpers/experiment.hpp"

namespace pulvis {
namespace {

using ::testing::ElementsAre;
using ::testing::Field;

struct TwoFigures {
  double first = 1, second = 2;
  std::vector<double> list{3, 4};
};

class ObservablesTest : public ::testing::Test {
 protected:
  Experiment e{"basic/disc-platens.toml"};
  Energies energies{.kinetic = 7};
  Observation now{e.simulation.world(), energies, e.results.shear(), 1, 0.5};
  int computed = 0;
};

TEST_F(ObservablesTest, RowsOfAGroupReadOneComputation) {
  Observables all;
  all.add([](const Observation& o) -> const Energies& { return o.energies; },
          {{"kinetic", "J", "of all nodes", &Energies::kinetic}});
  all.add(
      [&](const Observation&) {
        computed += 1;
        return TwoFigures();
      },
      {{"second", "m", "read by a function", [](const TwoFigures& f) { return f.second; }},
       {"first", "-", "a member", &TwoFigures::first}});
  EXPECT_THAT(all.infos(),
              ElementsAre(Field(&SeriesInfo::name, "kinetic"), Field(&SeriesInfo::name, "second"),
                          Field(&SeriesInfo::name, "first")));
  EXPECT_THAT(all.read(now), ElementsAre(7, 2, 1));
  EXPECT_EQ(computed, 1);
}

TEST_F(ObservablesTest, ARowThatTheSceneDoesNotHaveIsNeitherNamedNorRead) {
  Observables all;
  const auto refuses = [](const Observation&) -> double { throw std::logic_error("read"); };
  all.add({{"absent", "-", "not in this scene", refuses, false},
           {"jacobian", "-", "smallest", [](const Observation& o) { return o.min_jacobian; }}});
  EXPECT_THAT(all.infos(), ElementsAre(Field(&SeriesInfo::name, "jacobian")));
  EXPECT_THAT(all.read(now), ElementsAre(0.5));
}

TEST_F(ObservablesTest, FieldsAreTakenFromOneComputation) {
  FrameFields all;
  all.add(
      [&](const Observation&) {
        computed += 1;
        return TwoFigures();
      },
      {{{"sum", "-", "of both", FieldPlace::list, 1},
        [](const TwoFigures& f) { return std::vector{f.first + f.second}; }},
       {{"absent", "-", "not in this scene", FieldPlace::list, 1}, &TwoFigures::list, false},
       {{"list", "-", "a member", FieldPlace::list, 1}, &TwoFigures::list}});
  EXPECT_THAT(all.infos(),
              ElementsAre(Field(&FieldInfo::name, "sum"), Field(&FieldInfo::name, "list")));
  EXPECT_THAT(all.read(now), ElementsAre(ElementsAre(3), ElementsAre(3, 4)));
  EXPECT_EQ(computed, 1);
}

// Names are the keys of run.h5 and of expectations.
TEST_F(ObservablesTest, SeriesOfAWorldAreThoseKnownBeforeItExists) {
  const std::vector<SeriesInfo> before = history_series(e.scene);
  ASSERT_EQ(before.size(), e.results.series().size());
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_EQ(before[i].name, e.results.series()[i].name);
}

// The words of pages and figures, cli/python/pulvis/figures/name_table.py: JSON from its first brace on.
class Words {
 public:
  Words() {
    std::stringstream text;
    text << std::ifstream(paths::source_dir() + "/cli/python/pulvis/figures/name_table.py").rdbuf();
    table_ = nlohmann::json::parse(text.str().substr(text.str().find('{')));
    for (const auto& pattern : table_["patterns"])  // ECMAScript here has no named groups
      patterns_.emplace_back(
          std::regex_replace(pattern[0].get<std::string>(), std::regex(R"(\(\?<\w+>)"), "("));
  }
  bool has(const std::string& name) const {
    const std::string energy = "energy/";
    return table_["keys"].contains(name) ||
           (name.starts_with(energy) && table_["energies"].contains(name.substr(energy.size()))) ||
           std::ranges::any_of(patterns_,
                               [&](const std::regex& one) { return std::regex_match(name, one); });
  }

 private:
  nlohmann::json table_;
  std::vector<std::regex> patterns_;
};

TEST(SeriesNames, AllHaveWordsForPagesAndFigures) {
  const Words words;
  const std::vector<std::string> observed{"output.contacts=true", "output.particle_stress=true"};
  for (const auto& [file, changes] : std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"basic/damped-strut.toml", {}},
           {"compaction/unit-cell.toml", {observed[0], observed[1], "output.density_cells=[2,2]"}},
           {"compaction/biaxial.toml", {}},
           {"periodic/shear.toml", observed},
           {"shear/flat-16.toml", observed},
           {"bonds/pulled-blocks.toml", {}},
           {"compaction-3d/unit-cell-sc.toml",
            {observed[0], observed[1], "output.density_cells=[2,2,2]"}},
           {"compaction-3d/tablet-bonded.toml", {}}}) {
    const Scene scene = read_scene(paths::source_dir() + "/scenes/" + file, changes);
    for (const auto& all : {history_series(scene), momentum_series(scene)})
      for (const SeriesInfo& series : all)
        EXPECT_TRUE(words.has(series.name)) << series.name << " of " << file;
  }
}

}  // namespace
}  // namespace pulvis
