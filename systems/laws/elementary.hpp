// Elementary functions for laws, for numbers and for lanes. Those of engine/portable_math.hpp, lane by lane: a lane
// is bitwise equal to the scalar result.
#pragma once

#include <type_traits>

#include "engine/lane.hpp"
#include "engine/portable_math.hpp"

namespace pulvis::kernels {

// f(number) for each number in x.
template <class T, class F>
T each_number(const T& x, const F& f) {
  if constexpr (is_pack<T>)
    return T::from([&](int l) { return f(x[l]); });
  else
    return f(x);
}

template <class T>
T exponential(const T& x) {
  return each_number(x, [](double one) { return portable::exp(one); });
}

template <class T>
T power(const T& x, double exponent) {  // x >= 0
  return each_number(x, [=](double one) { return portable::pow(one, exponent); });
}

}  // namespace pulvis::kernels
