// The area below the crests of a tool that bounds a powder from below and is not a plane.
#pragma once

#include <vector>

namespace pulvis {

struct Relief {  // surface height over x, relative to the tool's position; empty: a plane
  std::vector<double> x, y;    // m, x never decreases; linear in between, constant outside
  std::vector<double> volume;  // m^2, integral of y from the first x
};

}  // namespace pulvis
