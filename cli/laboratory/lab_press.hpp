// Compression curves from the records of a press: force and displacement to pressure and relative density.
//
//   u = u_0 - h + g(F)      displacement of the punch: h height of the compact, g compliance of the press
//   D = m / (rho_s A h)     relative density: m mass, rho_s density of the solid, A area of the punch
//   P = F / A               axial pressure on the punch
//
// g        a polynomial of the force, given or fitted to the loading of the empty press, whose constant term is the
//          displacement u_0 at which the punches meet
// u_0      one of three: the height at zero displacement, that of the unloaded compact at the end of the record, or that
//          of the empty press, if both records measure displacement from the same zero
// Noise    standard deviation of one displacement, which u_0 has where it comes from the last sample alone: from the median
//          of |u_(i-1) - 2 u_i + u_(i+1)|, 0.6745 sqrt(6) times it if the noise is normal and independent (Gasser, Sroka &
//          Jennen-Steinmetz 1986, with the median for the few samples where the loading turns)
// Errors   of u_0 and g of the empty press: covariance of the fitted polynomial, s^2 (X'X)^-1 = L L'; the columns of L are
//          independent. Correlated neighbouring residuals count as fewer (scenes/solve/least_squares.hpp)
// Loading  from where the force exceeds compression.contact of its maximum, up to that; unloading from there on
#pragma once

#include "cli/laboratory/lab_record.hpp"

#include <optional>
#include <span>
#include <vector>

namespace pulvis::lab {

struct Compliance {                  // g(F) = c[0] F + c[1] F^2 + ...
  std::vector<double> coefficients;  // m/N, m/N^2, ...; empty: a rigid press
  std::optional<double> meeting;     // m, u_0
  double largest_force = 0;          // N, of the record; 0: coefficients given, no limit
  double rms = 0;                    // m, residual of the record about the polynomial
  std::size_t samples = 0;
  // Of a record: changes of u_0 and c by one standard uncertainty, in directions in which the errors are independent.
  struct Error {
    double meeting = 0;                // m
    std::vector<double> coefficients;  // as above
  };
  std::vector<Error> errors = {};

  double at(double force) const;
};

Compliance compliance_of(const PressRecord& empty, const CompressionSpec& spec);
// As specified in the settings: from the empty press's record, given, or rigid.
Compliance machine_of(const Settings& settings);

// m, see above; 0 if there are fewer than three samples.
double displacement_noise(const PressRecord& record);

struct PressCurve {  // one value per sample, from the start of the loading on
  std::vector<double> height, density, pressure;  // m, -, Pa
  std::size_t first = 0;                          // index in the record of the first sample here
  std::size_t peak = 0;                           // index of the sample with the largest force
  double machine_give = 0;                        // m, at the peak

  std::span<const double> loading_density() const { return std::span(density).first(peak + 1); }
  std::span<const double> loading_pressure() const { return std::span(pressure).first(peak + 1); }
};

// Rejects a record that is not a single loading, or whose compact would have no height.
PressCurve press_curve(const PressRecord& record, const Filling& filling, const DieSpec& die,
                       const CompressionSpec& spec, const Compliance& machine);

// Rejects a relative density that no compact has: above 1 without load, beyond twice the stated uncertainties, or
// under load above what elastic compression explains.
void check_density(const PressRecord& record, const PressCurve& curve, const DieSpec& die);

struct Unloading {
  double last_pressure = 0, last_density = 0;  // Pa, -
  double recovery = 0;                         // -, axial: (last height - lowest)/lowest
  std::optional<double> modulus;               // Pa, slope of pressure against axial strain
};

// Empty where the record ends at its largest force.
std::optional<Unloading> unloading_of(const PressCurve& curve);

}  // namespace pulvis::lab
