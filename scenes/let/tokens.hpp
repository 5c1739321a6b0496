// The text of an expression cut into its parts. A unit stands right behind its number and belongs to it: "0.1 mm",
// "3 N/um^2"; everywhere else a name is a variable or a function.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace pulvis::let {

struct Token {
  enum class Kind { number, name, sign };  // sign: one of + - * / ^ ( ) ,
  Kind kind = Kind::sign;
  std::string_view text;       // of a number, with its unit
  std::string_view unit = {};  // of a number
};

// Whether a name is a variable or a function, so that it ends a unit.
using IsKnown = std::function<bool(std::string_view)>;

// Throws ExpressionError at a character that belongs to no expression.
std::vector<Token> tokens_of(std::string_view text, const IsKnown& is_known);

// "24 mm", "-5": read as in scenes without variables.
bool is_literal(const std::vector<Token>& tokens);

// The names that stand in a text, whatever else there is.
std::vector<std::string_view> words_of(std::string_view text);

}  // namespace pulvis::let
