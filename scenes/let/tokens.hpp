// Splits the text of an expression into tokens. A unit directly follows its number and belongs to it: "0.1 mm",
// "3 N/um^2"; anywhere else a name is a variable or a function.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace pulvis::let {

struct Token {
  enum class Kind { number, name, sign };  // sign: one of + - * / ^ ( ) ,
  Kind kind = Kind::sign;
  std::string_view text;       // a number's includes its unit
  std::string_view unit = {};  // of a number
};

// Whether a name is a variable or a function, which ends a unit.
using IsKnown = std::function<bool(std::string_view)>;

// Throws ExpressionError at a character that is not allowed in expressions.
std::vector<Token> tokens_of(std::string_view text, const IsKnown& is_known);

// "24 mm", "-5": read as in scenes without variables.
bool is_literal(const std::vector<Token>& tokens);

// All names in a text, whatever else it contains.
std::vector<std::string_view> words_of(std::string_view text);

}  // namespace pulvis::let
