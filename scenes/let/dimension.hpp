// Numbers with a dimension, as used in expressions: in SI base units. The angle is a separate dimension, as
// where quantities are read: 10 rad is not a plain number.
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
  std::string text() const;  // "m-1.kg.s-2", in the notation of udunits; "" for a plain number
};

struct Quantity {
  double value = 0;
  Dimension dimension = {};

  std::string text() const;  // "0.024 m", "10": for messages, rounded
};

// "24 mm", "10": a number with an optional unit.
Quantity quantity_of(std::string_view text);

}  // namespace pulvis::let
