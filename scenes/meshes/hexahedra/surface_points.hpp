// Bezier points of the smooth surface as combinations of its control net: see smooth_surface.hpp.
#pragma once

#include <array>
#include <initializer_list>
#include <utility>
#include <vector>

#include "scenes/meshes/hexahedra/surface_net.hpp"

namespace pulvis::space {

// Weights of numbered points. In one piece of memory and sorted by number: a fit makes and adds up millions.
class Combination {
 public:
  using Term = std::pair<int, double>;  // number, weight
  Combination() = default;
  Combination(std::initializer_list<Term> terms) {
    terms_.reserve(terms.size());
    for (const auto& [number, weight] : terms) (*this)[number] = weight;
  }

  double& operator[](int number) {
    std::size_t at = 0;
    return weight_at(number, at);
  }
  auto begin() const { return terms_.begin(); }
  auto end() const { return terms_.end(); }
  bool empty() const { return terms_.empty(); }
  void clear() { terms_.clear(); }

  friend void add(Combination& to, const Combination& from, double factor);

 private:
  // `at`: not behind its term; becomes the position of the term.
  double& weight_at(int number, std::size_t& at);

  std::vector<Term> terms_;
};
void add(Combination& to, const Combination& from, double factor);

// Numbers of Bezier points: at a node; on the side that starts at a corner, next to it; inside, next to it.
struct PointNumbers {
  int nodes, faces;
  int at(int node) const { return node; }
  int beside(SurfaceNet::Corner c) const { return nodes + 4 * c.face + c.corner; }
  int inside(SurfaceNet::Corner c) const { return nodes + 4 * faces + 4 * c.face + c.corner; }
  int count() const { return nodes + 8 * faces; }
};

// The surface at a node, in terms of the nodes of the net: its position, its derivatives towards the first and second
// of the fan's neighbours, and the mixed derivative.
struct NodeFrame {
  Combination place, along[2], twist;
};
// Those of the uniform bicubic B-spline; empty where three faces meet, since the surrounding surface decides there
// (on a cube: the position only).
std::vector<NodeFrame> spline_frames(const SurfaceNet& net);

// [points] over the nodes of the net. Patches share tangent planes for any frames.
class BezierPoints {
 public:
  BezierPoints(const SurfaceNet& net, const std::vector<NodeFrame>& frames);
  // Another frame at a node where four faces meet. `join` afterwards: the points around the nodes of three faces follow.
  void set(int node, const NodeFrame& frame);
  void join();
  const std::vector<Combination>& all() const { return points_; }

 private:
  using Corner = SurfaceNet::Corner;
  Combination& at(int point) { return entry(points_, point); }
  void clear(int v);
  void set_irregular(int v);
  void set_inside(const std::vector<Corner>& fan, const std::array<Combination, 3>& sum);
  void set_cube_corner(int v, const Combination& place);
  void set_cube_inside(int v);

  const SurfaceNet& net_;
  PointNumbers number_;
  std::vector<Combination> points_;
};
// The point numbers of a face, u first.
std::array<int, 16> points_of(const SurfaceNet& net, int face);

}  // namespace pulvis::space
