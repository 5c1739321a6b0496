// Results as tables: a value belongs to the row that describes it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
          {{"kinetic", "J", "kinetic energy $E$", "of all nodes", &Energies::kinetic}});
  all.add(
      [&](const Observation&) {
        computed += 1;
        return TwoFigures();
      },
      {{"second", "m", "second", "read by a function",
        [](const TwoFigures& f) { return f.second; }},
       {"first", "-", "first", "a member", &TwoFigures::first}});
  EXPECT_THAT(all.infos(),
              ElementsAre(Field(&SeriesInfo::name, "kinetic"), Field(&SeriesInfo::name, "second"),
                          Field(&SeriesInfo::name, "first")));
  EXPECT_THAT(all.read(now), ElementsAre(7, 2, 1));
  EXPECT_EQ(computed, 1);
}

TEST_F(ObservablesTest, ARowThatTheSceneDoesNotHaveIsNeitherNamedNorRead) {
  Observables all;
  const auto refuses = [](const Observation&) -> double { throw std::logic_error("read"); };
  all.add({{"absent", "-", "absent", "not in this scene", refuses, false},
           {"jacobian", "-", "Jacobian $J$", "smallest",
            [](const Observation& o) { return o.min_jacobian; }}});
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
      {{{"sum", "-", "sum", "of both", FieldPlace::list, 1},
        [](const TwoFigures& f) { return std::vector{f.first + f.second}; }},
       {{"absent", "-", "absent", "not in this scene", FieldPlace::list, 1},
        &TwoFigures::list,
        false},
       {{"list", "-", "list", "a member", FieldPlace::list, 1}, &TwoFigures::list}});
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

}  // namespace
}  // namespace pulvis
