// Evaluates expressions: "n*D", "2*D + 0.1 mm", "D*sin(30 deg)".
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

bool is_function(std::string_view name);  // including pi
std::string listed_functions();

// Whether a text is meant as an expression, valid or not. "24 mm" and "-5" are not, nor is text without
// variables and operators; a single unknown name is one if there are variables.
bool is_expression(std::string_view text, const Variables& variables);

// For text that is not an expression: "2*D" if it is "2 D", with D a variable; otherwise empty.
std::string product_meant(std::string_view text, const Variables& variables);

// Throws ExpressionError with the reason.
Quantity value_of(std::string_view text, const Variables& variables);

}  // namespace pulvis::let
