#include "scenes/meshes/hexahedra/surface_points.hpp"

#include <stdexcept>

namespace pulvis::space {
namespace {

using Corner = SurfaceNet::Corner;

bool is_cube(const SurfaceNet& net) { return net.faces() == 6; }

// Around a node v with neighbours e_k and the opposite corners d_k of its faces, between e_k and e_(k+1): products of
// (1, 4, 1)/6 and (1, 0, -1)/2.
NodeFrame spline_frame(const SurfaceNet& net, int v) {
  int e[4], d[4];
  for (int k = 0; k < 4; ++k) {
    const Corner c = entry(entry(net.fan, v), k);
    e[k] = net.node(c, 1);
    d[k] = net.node(c, 2);
  }
  NodeFrame f;
  add(f.place, {{v, 16.0}, {e[0], 4.0}, {e[1], 4.0}, {e[2], 4.0}, {e[3], 4.0}}, 1.0 / 36);
  add(f.place, {{d[0], 1.0}, {d[1], 1.0}, {d[2], 1.0}, {d[3], 1.0}}, 1.0 / 36);
  for (std::size_t k = 0; k < 2; ++k) {
    add(f.along[k], {{e[k], 4.0}, {e[k + 2], -4.0}}, 1.0 / 12);
    add(f.along[k], {{d[k], 1.0}, {d[(k + 3) % 4], 1.0}, {d[k + 1], -1.0}, {d[k + 2], -1.0}},
        1.0 / 12);
  }
  add(f.twist, {{d[0], 1.0}, {d[1], -1.0}, {d[2], 1.0}, {d[3], -1.0}}, 1.0 / 4);
  return f;
}

// The position of a three-face node on the Catmull-Clark surface.
NodeFrame cube_frame(const SurfaceNet& net, int v) {
  NodeFrame f;
  add(f.place, {{v, 9.0}}, 1.0 / 24);
  for (const Corner c : entry(net.fan, v))
    add(f.place, {{net.node(c, 1), 4.0}, {net.node(c, 2), 1.0}}, 1.0 / 24);
  return f;
}

}  // namespace

double& Combination::weight_at(int number, std::size_t& at) {
  while (at < terms_.size() && terms_[at].first < number) ++at;
  if (at == terms_.size() || terms_[at].first != number)
    terms_.insert(terms_.begin() + static_cast<std::ptrdiff_t>(at), {number, 0.0});
  return terms_[at].second;
}

void add(Combination& to, const Combination& from, double factor) {
  if (to.empty()) to.terms_.reserve(2 * from.terms_.size());  // most grow once more
  std::size_t at = 0;
  for (const auto& [number, weight] : from) to.weight_at(number, at) += factor * weight;
}

std::vector<NodeFrame> spline_frames(const SurfaceNet& net) {
  std::vector<NodeFrame> frames;
  for (int i = 0; i < net.nodes(); ++i) {
    if (net.valence(i) != 3 && net.valence(i) != 4)
      throw std::logic_error("a surface node of neither 3 nor 4 faces");
    const bool regular = net.valence(i) == 4;
    frames.push_back(regular        ? spline_frame(net, i)
                     : is_cube(net) ? cube_frame(net, i)
                                    : NodeFrame{});
  }
  return frames;
}

BezierPoints::BezierPoints(const SurfaceNet& net, const std::vector<NodeFrame>& frames)
    : net_(net),
      number_{net.nodes(), net.faces()},
      points_(static_cast<std::size_t>(number_.count())) {
  for (int i = 0; i < net.nodes(); ++i)
    if (net.valence(i) == 4) set(i, entry(frames, i));
  if (!is_cube(net)) {
    join();
    return;
  }
  for (int i = 0; i < net.nodes(); ++i) set_cube_corner(i, entry(frames, i).place);
  for (int i = 0; i < net.nodes(); ++i) set_cube_inside(i);
}

void BezierPoints::join() {
  const auto each = [&](const auto& act) {
    for (int i = 0; i < net_.nodes(); ++i)
      if (net_.valence(i) == 3) act(i);
  };
  each([&](int i) { clear(i); });
  each([&](int i) { set_irregular(i); });
}

// The points of the corners that meet at v.
void BezierPoints::clear(int v) {
  at(number_.at(v)).clear();
  for (const Corner c : entry(net_.fan, v)) {
    at(number_.beside(c)).clear();
    at(number_.inside(c)).clear();
  }
}

void BezierPoints::set(int v, const NodeFrame& frame) {
  clear(v);
  const std::vector<Corner>& fan = entry(net_.fan, v);
  add(at(number_.at(v)), frame.place, 1);
  for (std::size_t k = 0; k < 4; ++k) {
    // Signs of the directions to e_k and e_(k+1) in the frame.
    const double ahead = k < 2 ? 1 : -1, left = k == 0 || k == 3 ? 1 : -1;
    Combination &beside = at(number_.beside(fan[k])), &inside = at(number_.inside(fan[k]));
    add(beside, frame.place, 1);
    add(beside, frame.along[k % 2], ahead / 3);
    add(inside, beside, 1);
    add(inside, frame.along[(k + 1) % 2], left / 3);
    add(inside, frame.twist, ahead * left / 9);
  }
}

// p0, p1, p2, p3: points of the side from v along fan[k]. It is quadratic, p1 = (p0 + 3 p2 - p3)/3, and the three
// tangents p1 - p0 sum to zero.
void BezierPoints::set_irregular(int v) {
  const std::vector<Corner>& fan = entry(net_.fan, v);
  Combination& p0 = at(number_.at(v));
  std::array<Combination, 3> sum;  // of the two inner points next to a side
  for (const Corner c : fan) {
    add(p0, at(number_.beside(net_.beyond(c))), 3.0 / 6);
    add(p0, at(number_.at(net_.node(c, 1))), -1.0 / 6);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Combination &p2 = at(number_.beside(net_.beyond(fan[k]))),
                      &p3 = at(number_.at(net_.node(fan[k], 1)));
    Combination& p1 = at(number_.beside(fan[k]));
    add(p1, p0, 1.0 / 3);
    add(p1, p2, 1);
    add(p1, p3, -1.0 / 3);
    // With q1 = (3 p2 - p3)/2 and q2 = p3 of the quadratic: 2 p1 - 2/9 (q2 - q1).
    add(sum[k], p1, 2);
    add(sum[k], p2, 1.0 / 3);
    add(sum[k], p3, -1.0 / 3);
  }
  set_inside(fan, sum);
}

// Face k lies between the sides k and k + 1: inside_k + inside_(k-1) = sum_k.
void BezierPoints::set_inside(const std::vector<Corner>& fan,
                              const std::array<Combination, 3>& sum) {
  for (std::size_t k = 0; k < 3; ++k) {
    Combination& inside = at(number_.inside(fan[k]));
    add(inside, sum[k], 0.5);
    add(inside, sum[(k + 1) % 3], 0.5);
    add(inside, sum[(k + 2) % 3], -0.5);
  }
}

// For a net of six faces: the tangents have the length for a great-circle arc if the net is a cube.
void BezierPoints::set_cube_corner(int v, const Combination& place) {
  constexpr double tangent = 0.2247;
  const std::vector<Corner>& fan = entry(net_.fan, v);
  add(at(number_.at(v)), place, 1);
  for (const Corner c : fan) {
    Combination& p1 = at(number_.beside(c));
    add(p1, place, 1);
    add(p1, {{net_.node(c, 1), 1.0}}, tangent);
    for (const Corner other : fan) add(p1, {{net_.node(other, 1), 1.0}}, -tangent / 3);
  }
}

void BezierPoints::set_cube_inside(int v) {
  const std::vector<Corner>& fan = entry(net_.fan, v);
  std::array<Combination, 3> sum;  // 2 p1 + ((p1 - p0) - 2 (p2 - p1))/3
  for (std::size_t k = 0; k < 3; ++k) {
    add(sum[k], at(number_.beside(fan[k])), 3);
    add(sum[k], at(number_.at(v)), -1.0 / 3);
    add(sum[k], at(number_.beside(net_.beyond(fan[k]))), -2.0 / 3);
  }
  set_inside(fan, sum);
}

std::array<int, 16> points_of(const SurfaceNet& net, int face) {
  const PointNumbers number{net.nodes(), net.faces()};
  // For each corner: itself, along its side, along the previous side, inside.
  constexpr int place[4][4] = {{0, 1, 4, 5}, {3, 7, 2, 6}, {15, 14, 11, 10}, {12, 8, 13, 9}};
  std::array<int, 16> points{};
  for (int k = 0; k < 4; ++k) {
    const Corner c{face, k};
    const int of_corner[4] = {number.at(net.node(c)), number.beside(c),
                              number.beside(net.beyond({face, (k + 3) % 4})), number.inside(c)};
    for (int i = 0; i < 4; ++i) entry(points, entry(place[k], i)) = of_corner[i];
  }
  return points;
}

}  // namespace pulvis::space
