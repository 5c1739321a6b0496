// Elementary functions that give the same bits on every machine, with every compiler and every math library.
// IEEE 754 defines the rounding of sums, products, quotients, square roots and fused multiply-adds; but sines,
// exponentials and powers of a libm differ in the last bit between processors (glibc uses another variant
// where there is FMA) and between versions. Everything that enters the state of a run is computed with these
// functions; tests/checks/portable.py enforces that.
//
// Accuracy: one unit in the last place (acos 1.5), log_gamma 2e-14. For finite arguments.
#pragma once

#include <numbers>

namespace pulvis::portable {

double sin(double x);  // |x| < 2^50, also for cos and tan; NaN beyond
double cos(double x);
double tan(double x);
double acos(double x);             // -1 <= x <= 1
double atan(double x);             // in (-pi/2, pi/2)
double atan2(double y, double x);  // in [-pi, pi]
double exp(double x);
double log(double x);            // x > 0
double pow(double x, double y);  // x >= 0
double cbrt(double x);
double hypot(double x, double y);
double log_gamma(double x);  // ln Gamma(x), x >= 1

}  // namespace pulvis::portable
