// The nearest point of a triangle, and on which side of a closed triangle surface a point is.
//
// Source   Ericson 2005, ch. 5.1.5 (Voronoi regions of a triangle by dot products of edges and corner offsets); Baerentzen
//          & Aanaes 2005 (sign of the dot product with the angle-weighted normal of the nearest face, edge or corner)
#pragma once

#include "components/space/tools.hpp"
#include "systems/space/contact/vector.hpp"

namespace pulvis::space::kernels {

template <class T>
struct NearestOfMesh {
  T square;           // m^2, squared distance
  Vector<T> offset;   // m, from the nearest point to the point
  Vector<T> outward;  // normal of the nearest face, edge or corner
};

template <class T>
Vector<T> everywhere(const Point& p) {
  return {T{} + p[0], T{} + p[1], T{} + p[2]};
}

template <class T>
void look_at_triangle(const TriangleMesh::Triangle& t, const Vector<T>& p,
                      NearestOfMesh<T>& nearest) {
  const T zero{}, one = T{} + 1.0;
  const Vector<T> a = everywhere<T>(t.corner[0]), b = everywhere<T>(t.corner[1]),
                  c = everywhere<T>(t.corner[2]);
  const Vector<T> ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const T d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
          d6 = dot(ac, cp);
  const T area_a = d3 * d6 - d5 * d4, area_b = d5 * d2 - d1 * d6, area_c = d1 * d4 - d3 * d2;
  const T scale = one / (area_a + area_b + area_c);
  T v = area_b * scale, w = area_c * scale;  // of corners b, c
  Vector<T> outward = everywhere<T>(t.normal);
  const auto nearer = [&](const auto& region, const T& of_b, const T& of_c, const Point& normal) {
    v = select(region, of_b, v);
    w = select(region, of_c, w);
    outward = select(region, everywhere<T>(normal), outward);
  };
  const T bc = (d4 - d3) / ((d4 - d3) + (d5 - d6));
  nearer((area_a <= zero) & (d4 - d3 >= zero) & (d5 - d6 >= zero), one - bc, bc, t.edge_normal[1]);
  nearer((area_b <= zero) & (d2 >= zero) & (d6 <= zero), zero, d2 / (d2 - d6), t.edge_normal[2]);
  nearer((area_c <= zero) & (d1 >= zero) & (d3 <= zero), d1 / (d1 - d3), zero, t.edge_normal[0]);
  nearer((d1 <= zero) & (d2 <= zero), zero, zero, t.corner_normal[0]);
  nearer((d3 >= zero) & (d4 <= d3), one, zero, t.corner_normal[1]);
  nearer((d6 >= zero) & (d5 <= d6), zero, one, t.corner_normal[2]);
  const Vector<T> offset = ap - (v * ab + w * ac);
  const T square = dot(offset, offset);
  const auto closer = square < nearest.square;
  nearest.square = select(closer, square, nearest.square);
  nearest.offset = select(closer, offset, nearest.offset);
  nearest.outward = select(closer, outward, nearest.outward);
}

}  // namespace pulvis::space::kernels
