// Files as data loggers and old editors write them: text before the table, decimal commas, Latin-1.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/language/csv_table.hpp"
#include "scenes/language/encoding.hpp"
#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using ::testing::HasSubstr;

csv::Table record_of(const std::string& text) { return csv::read_text(text, "record.csv"); }
std::string refused_record(const std::string& text) {
  return message_of([&] { record_of(text); });
}

const std::string preamble = "Logger 5000\nOperator: J. Doe, room 3\n\n";

TEST(Preamble, IsLeftOutWhereOneLineOfNamesStandsAboveTheNumbers) {
  const csv::Table t = record_of(preamble + "time [s],force [N]\n0,1.5\n1,2.5\n");
  EXPECT_EQ(t.header_line, 4);
  ASSERT_EQ(t.columns.size(), 2U);
  EXPECT_EQ(csv::numbers(t, csv::column_at(t, "force"), "N"), (std::vector<double>{1.5, 2.5}));
}

TEST(Preamble, MayHaveUnitsInALineOfTheirOwn) {
  const csv::Table t = record_of(preamble + "time;force\ns;kN\n0;1,5\n1;2,5\n");
  EXPECT_EQ(csv::numbers(t, csv::column_at(t, "force"), "N"), (std::vector<double>{1500, 2500}));
}

TEST(Preamble, WithoutNamesIsRefusedAtTheLineWhereTheyShouldBe) {
  const std::string refused = refused_record("Logger 5000\nOperator: J. Doe\n0,1.5\n1,2.5\n");
  EXPECT_THAT(refused, HasSubstr("record.csv:2:1: table: there are no names for the 2 columns"));
}

TEST(DecimalCommas, BetweenCommasAreNamed) {
  EXPECT_THAT(refused_record("time [s],force [N]\n0,0,1,5\n1,0,2,5\n"),
              HasSubstr("if the numbers have decimal commas (1,5), separate the columns by ';'"));
}

TEST(Latin1, IsReadInRecordsAndNamedInScenes) {
  const csv::Table t = record_of("displacement [\xB5m],force [N]\n1,2\n2,3\n");
  EXPECT_EQ(csv::numbers(t, 0, "m"), (std::vector<double>{1e-6, 2e-6}));
  EXPECT_THAT(latin1_text('\xB5'), HasSubstr("0xB5, in Latin-1 'µ'"));
  EXPECT_EQ(as_utf8("5 µm"), "5 µm");  // UTF-8 stays what it is
}

}  // namespace
}  // namespace pulvis
