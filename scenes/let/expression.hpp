// Evaluates expressions: "n*D", "2*D + 0.1 mm", "D*sin(30 deg)".
#pragma once

#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/let/dimension.hpp"

namespace pulvis::let {

class Variables {
 public:
  void add(const std::string& name);
  const std::vector<std::string>& names() const { return names_; }  // in the order of the file
  bool has(std::string_view name) const { return known_.contains(name); }

  std::function<Quantity(std::string_view)> value_of;  // of one of the names

 private:
  std::vector<std::string> names_;
  std::set<std::string, std::less<>> known_;
};

inline constexpr std::size_t longest_expression = 1000;  // characters

bool is_function(std::string_view name);  // including pi
std::string listed_functions();

// Whether a text is meant as an expression, valid or not. "24 mm" and "-5" are not, nor is text without
// variables and operators; a single unknown name is one if there are variables.
bool is_expression(std::string_view text, const Variables& variables);

// For text that is not an expression: "2*D" if it is "2 D", with D a variable; otherwise empty.
std::string product_meant(std::string_view text, const Variables& variables);

// The variables whose values an expression needs, each once. None of a text that is not one.
std::vector<std::string> variables_in(std::string_view text, const Variables& variables);

// Throws ExpressionError with the reason.
Quantity value_of(std::string_view text, const Variables& variables);

}  // namespace pulvis::let
