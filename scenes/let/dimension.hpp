// Numbers with a dimension, as expressions reckon with them: in the base units of the SI. The angle is kept apart, as
// where quantities are read: 10 rad is no plain number.
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

namespace pulvis::let {

struct ExpressionError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Dimension {
  std::array<double, 8> powers{};  // of kg, m, s, A, K, mol, cd, rad; halves after a square root

  bool plain() const { return *this == Dimension{}; }
  bool operator==(const Dimension& other) const;
  Dimension times(const Dimension& other, double power = 1) const;  // this * other^power
  std::string text() const;  // "m-1.kg.s-2", as udunits reads it; "" of a plain number
};

struct Quantity {
  double value = 0;
  Dimension dimension = {};

  std::string text() const;  // "0.024 m", "10": for messages, rounded
};

// "24 mm", "10": a number, and a unit where there is one.
Quantity quantity_of(std::string_view text);

}  // namespace pulvis::let
