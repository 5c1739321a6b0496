// What told_test calls in the library that is built with the sanitizers.
#pragma once

#include <cstddef>

namespace told {

double read(const double* values, std::size_t place);
int next(int number);

}  // namespace told
