// The half of told_test that is built with the sanitizers, as libpulvis_core.so is.
#include "told_library.hpp"

namespace told {

double read(const double* values, std::size_t place) { return values[place]; }

int next(int number) { return number + 1; }

}  // namespace told
