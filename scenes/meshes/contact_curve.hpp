// The smooth contact curve of a meshed outline: control points as combinations of boundary nodes.
//
// y_i = x_i - c (x_(i-1) - 2 x_i + x_(i+1)) with c = 1/12: the spline follows the true outline
// when the nodes lie on the polygon of equal area, and a uniform pressure on it loads the nodes as it
// would load the element edges.
#pragma once

#include <vector>

#include "components/shape.hpp"

namespace pulvis {

// On an even outline without corners a fourth difference is added, d (x_(i-2) - 4 x_(i-1) + 6 x_i - ...), d < 0.
// It leaves flat, round and slowly varying outlines unchanged and smooths features as short as an edge, so
// that the force depends less on where the nodes lie: with d = -1/24 the scatter over mesh phases of the
// unit cell is 0.6 of that with d = 0; more (d = -1/16: 0.4) distorts the force curve itself.
inline constexpr double short_wave_filter = -1.0 / 24;

// How a closed outline is smoothed: c of every node (about 1/12), and one d for all.
struct Smoothing {
  std::vector<double> c;
  double d = 0;
};

// One closed spline along all boundary nodes, without corners.
void close_curve(Shape& shape, const Smoothing& smoothing);
// A spline for every face between two corners (boundary node numbers, ascending, first is 0). A curve ends
// at its corner node; the rows next to it are chosen so that a uniform pressure on an even face still gives
// every node the load of its element edges: 1/2, 1, 1, ..., 1/2 edge lengths.
void cornered_curve(Shape& shape, const std::vector<int>& corners);
// [boundary nodes] the element that has the edge from boundary node i to the next as a side.
std::vector<std::size_t> elements_behind(const Shape& shape);
// Undeformed lengths, contact stiffness and Gauss weights of the edges. Needs the mesh's Gauss points.
void measure_edges(Shape& shape);

}  // namespace pulvis
