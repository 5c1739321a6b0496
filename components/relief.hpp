// What lies below the crests of a tool that bounds a powder from below and is no plane.
#pragma once

#include <vector>

namespace pulvis {

struct Relief {  // its surface against x, relative to the tool's position; empty: a plane
  std::vector<double> x, y;    // m, x never falls; straight in between, flat beyond
  std::vector<double> volume;  // m^2, integral of y from the first x on
};

}  // namespace pulvis
