// Quantities: the value is the double nearest to the exact one, and dimensions are never mixed.
#include "scenes/language/units.hpp"
#include "tests/helpers/wrong.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace pulvis {
namespace {

std::string refusal(const std::string& text, const std::string& unit) {
  return message_of<UnitError>([&] { parse_quantity(text, unit); });
}

TEST(Units, ValuesInSi) {
  EXPECT_EQ(parse_quantity("10 mm", "m"), 0.01);
  EXPECT_EQ(parse_quantity("-10 mm", "m"), -0.01);
  EXPECT_EQ(parse_quantity("+1.5e1mm", "m"), 0.015);
  EXPECT_EQ(parse_quantity("200 GPa", "Pa"), 200e9);
  EXPECT_EQ(parse_quantity("0.3 N/um^2", "Pa"), 0.3e12);
  EXPECT_EQ(parse_quantity("5.6 ms", "s"), 0.0056);
  EXPECT_EQ(parse_quantity("7.99 g/cm^3", "kg/m^3"), 7990);
  EXPECT_EQ(parse_quantity("0 m", "m"), 0);
  EXPECT_DOUBLE_EQ(parse_quantity("1 inch", "m"), 0.0254);
}

// udunits raises the prefix to the power by the library's pow, some last bits beside.
TEST(Units, PowersOfPrefixes) {
  EXPECT_EQ(parse_quantity("1 nm^-3", "m-3"), 1e27);
  EXPECT_EQ(parse_quantity("1 um^-3", "m-3"), 1e18);
  EXPECT_EQ(parse_quantity("3 nm^3", "m3"), 3e-27);
  EXPECT_EQ(parse_quantity("7 um^3", "m3"), 7e-18);
  EXPECT_EQ(parse_quantity("1 um^4", "m4"), 1e-24);
  EXPECT_EQ(parse_quantity("1 pm^2", "m2"), 1e-24);
  EXPECT_EQ(parse_quantity("1 N/nm^2", "Pa"), 1e18);
  EXPECT_EQ(parse_quantity("1 kN/nm^2", "Pa"), 1e21);
  EXPECT_EQ(parse_quantity("1 inch^2", "m2"), 0.00064516);
  EXPECT_EQ(parse_quantity("1 inch^3", "m3"), 1.6387064e-05);
}

TEST(Units, SpellingsOfTheMicrometre) {
  for (const char* text : {"3 um", "3 \u00B5m", "3 \u03BCm", "3 micron", "3 micrometer"})
    EXPECT_EQ(parse_quantity(text, "m"), 3e-6) << text;
}

TEST(Units, AnglesInRadiansAndDegrees) {
  EXPECT_DOUBLE_EQ(parse_quantity("45 deg", "rad"), 0.78539816339744831);
  EXPECT_DOUBLE_EQ(parse_quantity("45 degrees", "rad"), 0.78539816339744831);
  EXPECT_DOUBLE_EQ(parse_quantity("180 \u00B0", "rad"), 3.14159265358979324);
  EXPECT_EQ(parse_quantity("1e4 rad/s", "rad/s"), 1e4);
  EXPECT_DOUBLE_EQ(parse_quantity("90 deg/s", "rad/s"), 1.57079632679489662);
}

TEST(Units, DimensionsAreNotMixed) {
  EXPECT_EQ(refusal("10 N", "Pa"), "\"10 N\" has the dimension of m.kg.s-2, Pa is expected");
  EXPECT_THAT(refusal("10 Hz", "rad/s"), testing::HasSubstr("rad/s is expected"));
  EXPECT_THAT(refusal("1 m.rad", "m"), testing::HasSubstr("m is expected"));
  EXPECT_THAT(refusal("10 %", "rad"), testing::HasSubstr("a plain number"));
}

TEST(Units, WhatIsNoQuantity) {
  EXPECT_THAT(refusal("10", "m"), testing::HasSubstr("missing unit"));
  EXPECT_THAT(refusal("10 mmm", "m"), testing::HasSubstr("unknown unit 'mmm'"));
  EXPECT_THAT(refusal("mm", "m"), testing::HasSubstr("does not start with a number"));
  EXPECT_THAT(refusal("", "m"), testing::HasSubstr("does not start with a number"));
  EXPECT_THAT(refusal("--1 m", "m"), testing::HasSubstr("does not start with a number"));
  EXPECT_THAT(refusal("+-1 m", "m"), testing::HasSubstr("does not start with a number"));
  EXPECT_THAT(refusal("nan m", "m"), testing::HasSubstr("not a finite number"));
  EXPECT_THAT(refusal("-inf m", "m"), testing::HasSubstr("not a finite number"));
  EXPECT_THAT(refusal("1e999 m", "m"), testing::HasSubstr("outside the range of double precision"));
  EXPECT_THAT(refusal("1e300 Ym", "m"),
              testing::HasSubstr("outside the range of double precision"));
}

TEST(Units, FactorsAndOffsetsDoNotHideInUnits) {
  EXPECT_THAT(refusal("10 2 mm", "m"), testing::HasSubstr("contains a number"));
  EXPECT_THAT(refusal("1 m^-1.5", "m"), testing::HasSubstr("contains a number"));
  EXPECT_THAT(refusal("10 m @ 5", "m"), testing::Ne(""));
  EXPECT_THAT(refusal("10 m @ x", "m"), testing::Ne(""));
  EXPECT_THAT(refusal("10 lg(re m)", "m"), testing::Ne(""));
}

TEST(Units, SeveralThreadsGetTheSameValues) {
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([] {
      for (int n = 0; n < 200; ++n) EXPECT_EQ(parse_quantity("10 mm", "m"), 0.01);
    });
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace pulvis
