// A run that went bad: which system saw it, where, when, and the value that says so.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace pulvis {

struct RunFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace pulvis
