// Lines of a structured mesh, graded towards one end or both.
#pragma once

#include <vector>

namespace pulvis {

// Edges are `first` and `last` long at the ends, grow by `growth` times the distance from there, `largest` at most.
struct Grading {
  double length = 0;           // m
  double first = 0, last = 0;  // m
  double largest = 0;          // m
  double growth = 0.4;         // -
  double coarser = 1;          // -, scales all edges
};
// How many intervals this takes.
int intervals_of(const Grading& grading);
// Positions from 0 to the length; at least `fewest` intervals. Where that is more than needed, all edges shrink by
// one factor.
std::vector<double> graded_lines(const Grading& grading, int fewest = 1);

}  // namespace pulvis
