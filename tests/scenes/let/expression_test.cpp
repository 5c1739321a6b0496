// Values of expressions with dimensions, and what is told of wrong ones.
#include <gmock/gmock.h>

#include <map>
#include <numbers>

#include "scenes/let/expression.hpp"

namespace pulvis {
namespace {

using testing::HasSubstr;

const std::map<std::string, let::Quantity, std::less<>>& values() {
  static const std::map<std::string, let::Quantity, std::less<>> all{
      {"D", let::quantity_of("24 mm")},
      {"n", {10}},
      {"F", let::quantity_of("3 N")},
      {"m", {7}},
      {"phi", let::quantity_of("30 deg")}};
  return all;
}

const let::Variables& variables() {
  static const let::Variables all = [] {
    let::Variables made;
    for (const auto& [name, value] : values()) made.add(name);
    made.value_of = [](std::string_view name) { return values().find(name)->second; };
    return made;
  }();
  return all;
}

struct Worked {
  const char* text;
  double value;
  const char* unit;
};

void PrintTo(const Worked& worked, std::ostream* stream) { *stream << worked.text; }

class Expressions : public testing::TestWithParam<Worked> {};

TEST_P(Expressions, HaveTheirValueAndDimension) {
  const Worked& worked = GetParam();
  EXPECT_TRUE(let::is_expression(worked.text, variables()));
  const let::Quantity found = let::value_of(worked.text, variables());
  EXPECT_NEAR(found.value, worked.value, 1e-14 * std::abs(worked.value));
  EXPECT_EQ(found.dimension.text(), worked.unit);
}

INSTANTIATE_TEST_SUITE_P(
    All, Expressions,
    testing::Values(Worked{"n*D", 0.24, "m"}, Worked{"2*D + 0.1 mm", 0.0481, "m"},
                    Worked{"D/200", 1.2e-4, "m"}, Worked{"-D", -0.024, "m"},
                    Worked{"D - D*2", -0.024, "m"}, Worked{"2 + 3*4^2", 50, ""},
                    Worked{"2^3^2", 512, ""}, Worked{"-2^2", -4, ""}, Worked{"(2 - -3)*n", 50, ""},
                    Worked{"D^2", 5.76e-4, "m2"}, Worked{"sqrt(D^2)", 0.024, "m"},
                    Worked{"sqrt(D)^2", 0.024, "m"}, Worked{"(D^3)^(1/3)", 0.024, "m"},
                    Worked{"F/D^2", 3 / 5.76e-4, "kg.m-1.s-2"},
                    Worked{"3 N/um^2 * D^2", 3e12 * 5.76e-4, "kg.m.s-2"},
                    Worked{"10 mm/D", 0.01 / 0.024, ""}, Worked{"10 mm*n", 0.1, "m"},
                    Worked{"10 mm / 2", 0.005, "m"}, Worked{"6 m/2 s", 3, "m.s-1"},
                    Worked{"2*500 J/(kg K)", 1000, "m2.s-2.K-1"}, Worked{"2 * 5 1/s", 10, "s-1"},
                    Worked{"3 kg m-3*n", 30, "kg.m-3"}, Worked{"D/(1 mm)", 24, ""},
                    // Behind a number stands a unit; a variable of its name is meant elsewhere.
                    Worked{"2 m + D", 2.024, "m"}, Worked{"2 mm*m", 0.014, "m"},
                    Worked{"sin(30 deg)", 0.5, ""}, Worked{"2*cos(phi)", std::numbers::sqrt3, ""},
                    Worked{"tan(pi/4)", 1, ""}, Worked{"atan(1)", std::numbers::pi / 4, "rad"},
                    Worked{"asin(0.5) + phi", std::numbers::pi / 3, "rad"},
                    Worked{"acos(0)", std::numbers::pi / 2, "rad"}, Worked{"exp(log(n))", 10, ""},
                    Worked{"min(D, 1 mm, 3 cm)", 1e-3, "m"}, Worked{"max(D, 1 mm)", 0.024, "m"},
                    Worked{"abs(-D)", 0.024, "m"},
                    Worked{"floor(2.9) + ceil(2.1) + round(2.5)", 8, ""}, Worked{"n^-1", 0.1, ""},
                    Worked{"n^0.5", 3.1622776601683795, ""}, Worked{"n*5 %", 0.5, ""}));

class Literals : public testing::TestWithParam<const char*> {};

// They are read, or refused, as in a scene without variables.
TEST_P(Literals, AreNoExpressions) { EXPECT_FALSE(let::is_expression(GetParam(), variables())); }

INSTANTIATE_TEST_SUITE_P(All, Literals,
                         testing::Values("24 mm", "-5", "+5 mm", "1e-3 N/um^2", "2 m", "5 1/s",
                                         "1 J/(kg K)", "7 kg m-3", "0,5 mm", "", "-", "10 mm 20",
                                         "3 µm", "45°", "1.5e3Pa"));

struct WrongText {
  const char* text;
  const char* says;
};

void PrintTo(const WrongText& wrong, std::ostream* stream) { *stream << wrong.text; }

class WrongExpressions : public testing::TestWithParam<WrongText> {};

TEST_P(WrongExpressions, AreRefusedWithTheReason) {
  EXPECT_TRUE(let::is_expression(GetParam().text, variables()));
  try {
    let::value_of(GetParam().text, variables());
    FAIL() << "accepted";
  } catch (const let::ExpressionError& error) {
    EXPECT_THAT(error.what(), HasSubstr(GetParam().says));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongExpressions,
    testing::Values(
        WrongText{"D + F", "0.024 m + 3 kg.m.s-2: the dimensions differ"},
        WrongText{"D + 1", "the dimensions differ"}, WrongText{"phi + 1", "the dimensions differ"},
        WrongText{"ph*2", "no variable is called 'ph', did you mean 'phi'?"},
        WrongText{"n*mm", "for the unit write 1 mm"}, WrongText{"2 D + 1 mm", "write 2*D"},
        WrongText{"sine(phi)", "no function 'sine'"}, WrongText{"sin(D)", "an angle is expected"},
        WrongText{"exp(D)", "plain number"}, WrongText{"min(D, F)", "the dimensions differ"},
        WrongText{"sqrt(D, D)", "takes one value, 2 are given"},
        WrongText{"2^D", "not a plain number"}, WrongText{"(-n)^0.5", "cannot be raised"},
        WrongText{"D/(n - 10)", "not finite"}, WrongText{"log(0*n)", "not finite"},
        WrongText{"sqrt(-n)", "not finite"}, WrongText{"(D", "not closed"},
        WrongText{"D)", "')' where an operator"}, WrongText{"D D", "'D' where an operator"},
        WrongText{"n**2", "'*' where a value"}, WrongText{"n*", "it ends"},
        WrongText{"sqrt", "an opening bracket is expected"},
        WrongText{"D & n", "'&' is not allowed"}, WrongText{"n*3 furlongses", "unknown unit"},
        WrongText{"n*20 degC", "offset"}));

TEST(DeepExpressions, AreRefused) {
  const std::string deep(100, '('), signs(100, '-');
  EXPECT_THROW(let::value_of(deep + "1", variables()), let::ExpressionError);
  EXPECT_THROW(let::value_of(signs + "1", variables()), let::ExpressionError);
  EXPECT_THROW(let::value_of(std::string(2000, '1') + "+1", variables()), let::ExpressionError);
}

}  // namespace
}  // namespace pulvis
