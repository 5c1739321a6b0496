// The value of an expression: "n*D", "2*D + 0.1 mm", "D*sin(30 deg)".
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/let/dimension.hpp"

namespace pulvis::let {

struct Variables {
  std::vector<std::string> names;
  std::function<Quantity(std::string_view)> value_of;  // of one of the names

  bool has(std::string_view name) const;
};

inline constexpr std::size_t longest_expression = 1000;  // characters

bool is_function(std::string_view name);  // pi, too
std::string listed_functions();

// Whether a text is meant as an expression, right or wrong. "24 mm" and "-5" are not, nor is what has neither
// variables nor signs in it; a lone unknown name is one where there are variables.
bool is_expression(std::string_view text, const Variables& variables);

// Of what is no expression: "2*D" where "2 D" is written, with D a variable; otherwise empty.
std::string product_meant(std::string_view text, const Variables& variables);

// Throws ExpressionError with what is wrong.
Quantity value_of(std::string_view text, const Variables& variables);

}  // namespace pulvis::let
