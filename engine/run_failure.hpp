// A failed run: which system detected it, where, when, and the value that shows it.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace pulvis {

struct RunFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace pulvis
