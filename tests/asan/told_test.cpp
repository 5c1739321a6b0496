// A program without sanitizers over a library with them: told_test beyond-end|after-free|overflow|leak|right. The first
// four must be reported and end with an exit code, though the memory is this program's.
#include <climits>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "told_library.hpp"

int main(int, char** words) {
  const std::string mode = words[1];
  constexpr std::size_t places = 10;
  auto values = std::make_unique<std::vector<double>>(places, 1.0);
  const double* const first = values->data();
  if (mode == "after-free") values.reset();
  if (mode == "leak") static_cast<void>(values.release());
  const double value = told::read(first, mode == "beyond-end" ? places : places - 1);
  std::printf("%g %d\n", value, told::next(mode == "overflow" ? INT_MAX : 1));
}
