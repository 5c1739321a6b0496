// Quantities with units, as scene files write them: "10 mm", "200 GPa", "0.3 N/um^2", "45 deg".
// udunits2 knows the units; this file adds what it lacks: the number is parsed exactly, angles
// are distinguished from plain numbers, and units with an offset or a hidden factor are refused.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace pulvis {

struct UnitError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The value of `text` in the SI unit `wanted` ("m", "Pa", "rad/s", ...). Throws UnitError, stating what
// was given and what is required. Thread-safe.
double parse_quantity(std::string_view text, const std::string& wanted);

// A quantity of any dimension in SI base units: "2 GPa" is 2e9 "m-1.kg.s-2", "20 deg" 0.35 "rad";
// a plain number, including "5 %", has the unit "".
struct BaseQuantity {
  double value = 0;
  std::string unit;
};
BaseQuantity parse_any_quantity(std::string_view text);

}  // namespace pulvis
