// Elementary functions with the same bits on every machine, with every compiler and every mathematical library.
// IEEE 754 rounds sums, products, quotients, square roots and fused multiply-adds alike everywhere; sines,
// exponentials and powers of a libm differ in the last bit from processor to processor (glibc takes another one
// where there is FMA) and from version to version. Whatever goes into the state of a run is made with these;
// tests/checks/portable.py holds that.
//
// Each is within one unit in the last place (acos 1.5), log_gamma within 2e-14. For finite arguments.
#pragma once

#include <numbers>

namespace pulvis::portable {

double sin(double x);  // |x| < 2^50, as cos and tan; NaN beyond
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
