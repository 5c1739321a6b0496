#include "scenes/language/unit_hint.hpp"

#include <fmt/format.h>

#include <cmath>

namespace pulvis::schema {
namespace {

struct NamedUnit {
  const char* name;
  double in_si;
};

// Commonly used units, the most likely first, and their usual magnitudes.
struct Usual {
  std::vector<NamedUnit> units;
  double low, high;  // SI: low <= |value| < high
};

constexpr double degree = 0.017453292519943295;  // rad

Usual usual_length(bool of_lever) {
  const std::vector<NamedUnit> units{{"m", 1}, {"mm", 1e-3}, {"um", 1e-6}, {"nm", 1e-9}};
  return of_lever ? Usual{units, 1e-9, 5e-4} : Usual{units, 1e-6, 0.11};
}

Usual usual_pressure(const KeyInfo& key) {
  if (key.name.find("modulus") != std::string::npos)
    return {{{"Pa", 1}, {"GPa", 1e9}, {"MPa", 1e6}}, 1e8, 2e12};
  return {{{"Pa", 1}, {"MPa", 1e6}, {"GPa", 1e9}, {"kPa", 1e3}}, 1e4, 2e10};
}

Usual usual_of(const KeyInfo& key) {
  constexpr double any = 1e300;
  if (key.unit == "m") return usual_length(key.of_lever);
  if (key.unit == "Pa") return usual_pressure(key);
  if (key.unit == "s") return {{{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}}, 1e-6, 0.1};
  if (key.unit == "rad") return {{{"deg", degree}, {"rad", 1}}, 0, any};
  if (key.unit == "kg/m^3") return {{{"kg/m^3", 1}, {"g/cm^3", 1e3}}, 50, 1e5};
  if (key.unit == "N")
    return key.of_lever ? Usual{{{"N", 1}, {"nN", 1e-9}, {"uN", 1e-6}}, 1e-12, 1e-3}
                        : Usual{{{"N", 1}, {"kN", 1e3}}, 0.1, 1e7};
  return {{{key.unit.c_str(), 1}}, 0, any};
}

std::string written(double number, const NamedUnit& unit) {
  return fmt::format("\"{:g} {}\"", number, unit.name);
}

// The same in the unit of the list that gives the most readable number.
std::string in_another(double si, const std::vector<NamedUnit>& units, const NamedUnit& first) {
  for (const NamedUnit& unit : units) {
    const double number = std::abs(si / unit.in_si);
    if (unit.name != first.name && number >= 0.01 && number < 10000)
      return " or " + written(si / unit.in_si, unit);
  }
  return "";
}

}  // namespace

std::string quantity_example(const KeyInfo& key, double number) {
  const Usual usual = usual_of(key);
  if (number == 0)
    return written(0, usual.units[usual.units.size() > 1 && key.unit == "m" ? 1 : 0]);
  for (const NamedUnit& unit : usual.units) {
    const double si = number * unit.in_si;
    if (std::abs(si) >= usual.low && std::abs(si) < usual.high && key.range.holds(si))
      return written(number, unit) + in_another(si, usual.units, unit);
  }
  std::string names;
  for (const NamedUnit& unit : usual.units)
    names += fmt::format("{}\"... {}\"", names.empty() ? "" : " or ", unit.name);
  return names;
}

}  // namespace pulvis::schema
