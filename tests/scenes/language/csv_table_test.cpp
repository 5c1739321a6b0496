// Tables of numbers: what instruments write is read, what cannot be meant is refused with its place.
#include "scenes/language/csv_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/helpers/wrong.hpp"

namespace pulvis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

csv::Table table_of(const std::string& text) { return csv::read_text(text, "t.csv"); }

std::vector<double> column(const std::string& text, const std::string& name,
                           const std::string& unit) {
  const csv::Table table = table_of(text);
  return csv::numbers(table, csv::column_at(table, name), unit);
}

TEST(CsvTable, ReadsCommasAndUnitsInBrackets) {
  const std::string text = "time [s],force [kN]\n0,1.5\n0.5,-2e-3\n";
  EXPECT_THAT(column(text, "time", "s"), ElementsAre(0, 0.5));
  EXPECT_THAT(column(text, "force", "N"), ElementsAre(1500, -2));
}

TEST(CsvTable, ReadsSemicolonsDecimalCommasAndALineOfUnits) {
  const std::string text =
      "\xEF\xBB\xBF# made by a press\r\nZeit;Kraft\r\ns;N\r\n0,00;1,25\r\n1;2\r\n";
  EXPECT_THAT(column(text, "Zeit", "s"), ElementsAre(0, 1));
  EXPECT_THAT(column(text, "kraft", "N"), ElementsAre(1.25, 2));
}

TEST(CsvTable, ReadsEveryEndOfLine) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const std::string good = "x [m],y [m]" + end + "1,2" + end + "3,4" + end;
    EXPECT_THAT(column(good, "x", "m"), ElementsAre(1, 3));
    EXPECT_THAT(message_of([&] { column(good + "5,oops", "y", "m"); }), StartsWith("t.csv:4:3: "));
  }
}

TEST(CsvTable, ReadsTabsQuotesAndATrailingSeparator) {
  EXPECT_THAT(column("\"a (mm)\"\tb\t\n\" 1,5 \"\tx\t\n", "a", "m"), ElementsAre(0.0015));
}

TEST(CsvTable, ColumnsThatNobodyAsksForMayHoldAnything) {
  EXPECT_THAT(column("x [m],note\n1,\"good, dry\"\n2,\n", "x", "m"), ElementsAre(1, 2));
}

TEST(CsvTable, AHeaderBelowAPreambleIsFoundByItsLine) {
  const csv::Table table = csv::read_text("Instrument;7\nx;y\nm;m\n1;2\n", "t.csv", {2});
  EXPECT_THAT(csv::numbers(table, csv::column_at(table, "y"), "m"), ElementsAre(2));
}

TEST(CsvTable, RefusesWhatIsNoNumber) {
  EXPECT_THAT(message_of([] { column("x [m],y [m]\n1,2\n1,oops\n", "y", "m"); }),
              StartsWith("t.csv:3:3: y: 'oops' is not a finite number, allowed: "));
  EXPECT_THAT(message_of([] { column("x [m],y [m]\n1,2\n,3\n", "x", "m"); }),
              StartsWith("t.csv:3:1: x: no value, allowed: "));
  EXPECT_THAT(message_of([] { column("x;y\n1,5;2\n1.234,5;1\n", "x", ""); }),
              StartsWith("t.csv:3:1: x: '1.234,5' is not a finite number"));
  EXPECT_THAT(message_of([] { column(std::string("x [m]\n1\0\n", 9), "x", "m"); }),
              StartsWith("t.csv:2:2: table: a NUL byte, allowed: text"));
  EXPECT_THAT(message_of([] { column("x [m]\n1e999\n", "x", "m"); }),
              HasSubstr("not a finite number"));
  EXPECT_THAT(message_of([] { column("x [km]\n1e29\n", "x", "m"); }),
              StartsWith("t.csv:2:1: x: '1e29' is 1e+32 in SI units, allowed: up to 1e+30"));
}

TEST(CsvTable, RefusesRowsOfAnotherLength) {
  EXPECT_THAT(
      message_of([] { table_of("x [m],y [m]\n1,2\n\n1,2,3\n"); }),
      StartsWith(
          "t.csv:4:1: row: has 3 fields, allowed: 2, as many as the column names in line 1"));
}

TEST(CsvTable, RefusesWrongAndMissingUnits) {
  EXPECT_THAT(message_of([] { column("x [kg]\n1\n", "x", "N"); }),
              HasSubstr("has the dimension of kg, N is expected"));
  EXPECT_THAT(message_of([] { column("x\n1\n", "x", "N"); }),
              StartsWith("t.csv:1:1: x: has no unit, allowed: "));
}

TEST(CsvTable, RefusesMissingColumnsAndEmptyFiles) {
  EXPECT_THAT(message_of([] { column("x [m],y [m]\n1,2\n", "z", "m"); }),
              StartsWith("t.csv:1:1: z: there is no such column, allowed: one of the columns of "
                         "the file: 'x', 'y'"));
  EXPECT_THAT(message_of([] { table_of("# nothing\n\n"); }), HasSubstr("is empty, allowed: "));
  EXPECT_THAT(message_of([] { table_of("x [m]\n"); }), HasSubstr("has no rows, allowed: "));
  EXPECT_THAT(message_of([] { csv::read("no-such.csv"); }), HasSubstr("there is no such file"));
}

}  // namespace
}  // namespace pulvis
