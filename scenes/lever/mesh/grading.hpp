// Lines of a structured mesh, closer together at one end or at both.
#pragma once

#include <vector>

namespace pulvis {

// Edges are `first` and `last` long at the ends, longer by `growth` times the distance from there, `largest` at most.
struct Grading {
  double length = 0;           // m
  double first = 0, last = 0;  // m
  double largest = 0;          // m
  double growth = 0.4;         // -
  double coarser = 1;          // -, all edges by so much
};
// How many intervals that takes.
int intervals_of(const Grading& grading);
// Places from 0 to the length; at least `fewest` intervals, all smaller by one factor where that is more than it
// takes.
std::vector<double> graded_lines(const Grading& grading, int fewest = 1);

}  // namespace pulvis
