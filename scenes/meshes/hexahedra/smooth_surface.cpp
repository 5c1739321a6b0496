#include "scenes/meshes/hexahedra/smooth_surface.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "scenes/meshes/hexahedra/bezier_patch.hpp"
#include "scenes/meshes/hexahedra/surface_points.hpp"
#include "systems/space/contact/node_springs.hpp"

namespace pulvis::space {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr double usual_c = 1.0 / 12;
constexpr double least_c = 0, most_c = 0.25;
// Weights that keep c and the lines at irregular nodes at their usual values, relative to the fit of the surface.
constexpr double stay = 1e-3, stay_turned = 1e-4;
// Where |U . n| is less than this fraction of its maximum, the surface is flat: c does not matter to its shape there, and must
// not differ from node to node. Uniform pressure would otherwise load the nodes unevenly, and push a checkerboard of them
// through a tool.
constexpr double flat = 0.25;
// The largest changes of a, which is normally 1, and of b (smooth_surface.hpp): larger ones, which sharp shapes with few
// faces require, reverse tangents and fold the surface.
constexpr std::array most_change{0.75, 0.2};
constexpr std::array shares_of_change{1.0, 0.75, 0.5, 0.25, 0.0};  // tried in turn
constexpr int volume_fits = 24;                                    // halvings
constexpr int fits = 3;  // since the target point moves slightly along the surface

Vec3 vector_of(const Point& p) { return {p[0], p[1], p[2]}; }

// U of smooth_surface.hpp, in terms of the surface nodes.
Combination umbrella(const SurfaceNet& net, int node) {
  Combination u{{node, -4.0}};
  for (const SurfaceNet::Corner c : entry(net.fan, node))
    u[net.node(c, 1)] += 4.0 / net.valence(node);
  return u;
}

Vec3 value_of(const Combination& combination, const std::vector<Vec3>& of) {
  Vec3 sum = Vec3::Zero();
  for (const auto& [number, weight] : combination) sum += weight * entry(of, number);
  return sum;
}

// Where faces are checked, along both sides: folds start at their corners.
constexpr std::array looked_at{0.0, 0.03, 0.1, 0.3, 0.5, 0.7, 0.9, 0.97, 1.0};

// How well a smooth surface represents the true one.
struct Likeness {
  double distance = 0;  // m, maximum from the true surface, as seen from the centre of volume
  double bulge = 0;     // m, maximum outwards along its normal
  double cosine = 1;    // minimum between both normals; <= 0: the surface is folded
  double evenness = 1;  // minimum area per unit of (u, v), over the mean of the face

  // >= 1: good enough. Where the area almost vanishes, closest points cannot be found.
  double quality() const { return std::min(cosine / 0.5, evenness / 0.2); }
};
std::vector<PatchWeights> weights_looked_at() {
  std::vector<PatchWeights> weights;
  for (const double u : looked_at)
    for (const double v : looked_at) weights.push_back(patch_weights(u, v));
  return weights;
}
Likeness likeness(const SurfaceNet& net, const std::vector<Vec3>& points,
                  const StarSurface& surface) {
  static const std::vector<PatchWeights> all_weights = weights_looked_at();
  Likeness worst;
  for (int f = 0; f < net.faces(); ++f) {
    const std::array<int, 16> numbers = points_of(net, f);
    double least = std::numeric_limits<double>::infinity(), sum = 0;
    for (const PatchWeights& weights : all_weights) {
      const PatchPoint patch = patch_at(numbers, points, weights);
      const Vec3 direction = patch.at.normalized();
      const auto [radius, normal] = surface.spot(direction);
      const Vec3 off = patch.at - radius * direction;
      worst.distance = std::max(worst.distance, off.norm());
      worst.bulge = std::max(worst.bulge, off.dot(normal));
      const double area = patch.area().norm(), along = patch.area().dot(normal);
      worst.cosine = std::min(worst.cosine, along > 0 ? along / area : -1.0);
      least = std::min(least, area);
      sum += area;
    }
    worst.evenness = std::min(worst.evenness, least * looked_at.size() * looked_at.size() / sum);
  }
  return worst;
}

// Fits the undeformed surface to the true one.
class Fit {
 public:
  Fit(const Shape& shape, const SurfaceNet& net, const StarSurface& surface)
      : net_(net),
        surface_(surface),
        frames_(spline_frames(net)),
        bezier_(net, frames_),
        c_(count(), usual_c) {
    for (int i = 0; i < net.nodes(); ++i) nodes_.push_back(vector_of(entry(shape.nodes, i)));
    for (int i = 0; i < net.nodes(); ++i) u_.push_back(value_of(umbrella(net, i), nodes_));
    for (int i = 0; i < net.nodes(); ++i)
      normal_u_.push_back(
          std::abs(entry(u_, i).dot(surface.normal(entry(nodes_, i).normalized()))));
    most_u_ = *std::ranges::max_element(normal_u_);
    for (int i = 0; i < net.nodes(); ++i)
      if (net.valence(i) == 4 && meets_irregular(i)) turning_.push_back(i);
    for (int i = 0; i < fits; ++i) improve_smoothing();
    turn_as_far_as_good();
  }

  const std::vector<double>& smoothing() const { return c_; }
  // Of a node: the surface is flat there.
  bool is_flat(int node) const { return entry(normal_u_, node) < flat * most_u_; }
  // In terms of the nodes of the net.
  const std::vector<Combination>& points() const { return bezier_.all(); }
  const Likeness& reached() const { return reached_; }

 private:
  std::size_t count() const { return static_cast<std::size_t>(net_.nodes()); }
  std::vector<Vec3> net_places() const {
    std::vector<Vec3> control;
    for (std::size_t i = 0; i < count(); ++i) control.push_back(nodes_[i] - c_[i] * u_[i]);
    return control;
  }

  // The c for which the corners of the faces lie on the true surface, all at once.
  void improve_smoothing() {
    const std::vector<Vec3> control = net_places();
    Sparse by_c(net_.nodes(), net_.nodes());
    Eigen::VectorXd off = Eigen::VectorXd::Zero(net_.nodes());
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < net_.nodes(); ++j) {
      const Combination& place = entry(frames_, j).place;
      if (place.empty()) continue;
      const Vec3 at = value_of(place, control), direction = at.normalized();
      const auto [radius, normal] = surface_.spot(direction);
      off[j] = normal.dot(radius * direction - at);
      for (const auto& [i, weight] : place)
        entries.emplace_back(j, i, -weight * normal.dot(entry(u_, i)));
    }
    by_c.setFromTriplets(entries.begin(), entries.end());
    solve(by_c, off);
  }

  // m^2: weak, but firm where the surface is flat.
  double spring_of(int node, double weak) const {
    const double missing = std::max(flat * most_u_ - entry(normal_u_, node), 0.0) / flat;
    return weak * entry(u_, node).squaredNorm() + missing * missing;
  }

  // Least squares of the distances, with each c held at its usual value by a spring.
  void solve(const Sparse& by_c, const Eigen::VectorXd& off) {
    Sparse normal = by_c.transpose() * by_c;
    Eigen::VectorXd right = by_c.transpose() * off;
    for (int i = 0; i < net_.nodes(); ++i) {
      const double spring = spring_of(i, stay);
      normal.coeffRef(i, i) += spring;
      right[i] += spring * (usual_c - entry(c_, i));
    }
    const Eigen::SimplicialLDLT<Sparse> factors(normal);
    if (factors.info() != Eigen::Success)
      throw std::logic_error("the smoothing of a surface has no solution");
    const Eigen::VectorXd change = factors.solve(right);
    for (int i = 0; i < net_.nodes(); ++i)
      entry(c_, i) = std::clamp(entry(c_, i) + change[i], least_c, most_c);
  }

  bool meets_irregular(int node) const {
    for (int end = 0; end < 4; ++end)
      if (net_.valence(neighbour(node, end)) == 3) return true;
    return false;
  }

  // Of all Bezier points only those around the irregular nodes depend on the positions.
  void turn_lines(const std::vector<Vec3>& control) {
    for (const int w : turning_) {
      NodeFrame frame = entry(frames_, w);
      for (int k = 0; k < 2; ++k) turn_line(w, k, control, frame);
      bezier_.set(w, frame);
    }
    if (!turning_.empty()) bezier_.join();
  }

  // The first fraction of the changes that is good enough; if there is none, the best.
  void turn_as_far_as_good() {
    const std::vector<double> c = c_;
    double best_share = 0;
    std::vector<double> best_c;
    for (const double share : shares_of_change) {
      share_ = share;
      c_ = c;
      match_volume();
      const Likeness now = likeness(net_, places(), surface_);
      if (!best_c.empty() && !(now.quality() > reached_.quality())) continue;
      reached_ = now;
      best_share = share;
      best_c = c_;
      if (now.quality() >= 1) break;
    }
    share_ = best_share;
    c_ = best_c;
    turn_lines(net_places());
  }

  // m, positions of the Bezier points.
  std::vector<Vec3> places() {
    const std::vector<Vec3> control = net_places();
    turn_lines(control);
    std::vector<Vec3> at;
    for (const Combination& point : points()) at.push_back(value_of(point, control));
    return at;
  }

  // m^3, of the smooth surface when every c is increased by `more`, within its limits.
  double volume_with(const std::vector<double>& c, double more) {
    for (std::size_t i = 0; i < count(); ++i) c_[i] = std::clamp(c[i] + more, least_c, most_c);
    const std::vector<Vec3> at = places();
    double volume = 0;
    for (int f = 0; f < net_.faces(); ++f) volume += volume_under(points_of(net_, f), at);
    return volume;
  }

  // Between its corners the surface may still deviate slightly: a common addition to every c makes its volume correct.
  void match_volume() {
    const std::vector<double> c = c_;
    double low = -most_c, high = most_c;  // the volume increases with c
    for (int i = 0; i < volume_fits; ++i) {
      const double more = (low + high) / 2;
      (volume_with(c, more) < surface_.volume() ? low : high) = more;
    }
  }

  // The least-squares solution of square * change = right. A change beyond its bound is set to the bound, and the other one
  // is the best for it.
  Eigen::Vector2d bounded_change(const Eigen::Matrix2d& square,
                                 const Eigen::Vector2d& right) const {
    const auto bounded = [&](int i, double change) {
      const double most = share_ * entry(most_change, i);
      return std::clamp(change, -most, most);
    };
    Eigen::Vector2d change = square.ldlt().solve(right);
    for (int i = 0; i < 2; ++i) {
      const double here = bounded(i, change[i]);
      if (here == change[i]) continue;
      change[i] = here;
      const int other = 1 - i;
      change[other] = bounded(other, (right[other] - square(0, 1) * here) / square(other, other));
    }
    return change;
  }

  int neighbour(int node, int end) const { return net_.node(entry(entry(net_.fan, node), end), 1); }

  // Where a line leads to an irregular node, whose position follows from the derivative D along it at the regular node w:
  // D = a D_spline + b U_w in the tangent plane at w, and half of it reaches that at the irregular node.
  void turn_line(int w, int line, const std::vector<Vec3>& control, NodeFrame& frame) const {
    if (net_.valence(neighbour(w, line)) != 3 && net_.valence(neighbour(w, line + 2)) != 3) return;
    const Vec3 at = value_of(frame.place, control), spline = value_of(frame.along[line], control);
    const Vec3 u = value_of(umbrella(net_, w), control);
    Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    const auto demand = [&](const Vec3& normal, double half,
                            double wanted) {  // normal . half D = wanted
      const Eigen::Vector2d by(half * normal.dot(spline), half * normal.dot(u));
      square += by * by.transpose();
      right += by * (wanted - by[0]);
    };
    for (const int end : {line, line + 2}) {
      const int v = neighbour(w, end);
      if (net_.valence(v) != 3) continue;
      const Vec3 direction = entry(control, v).normalized();
      const auto [radius, normal] = surface_.spot(direction);
      demand(normal, end == line ? 0.5 : -0.5, normal.dot(radius * direction - at));
    }
    demand(surface_.normal(at.normalized()), 1, 0);
    square.diagonal().array() +=
        std::max(stay_turned * u.squaredNorm(), std::numeric_limits<double>::min());
    const Eigen::Vector2d change = bounded_change(square, right);
    Combination turned;
    add(turned, frame.along[line], 1 + change[0]);
    add(turned, umbrella(net_, w), change[1]);
    frame.along[line] = turned;
  }

  const SurfaceNet& net_;
  const StarSurface& surface_;
  std::vector<NodeFrame> frames_;  // not turned
  BezierPoints bezier_;
  std::vector<int> turning_;  // nodes with lines to irregular ones
  std::vector<double> c_;
  double share_ = 1;  // of most_change
  Likeness reached_;
  std::vector<Vec3> nodes_, u_;
  std::vector<double> normal_u_;  // m, [nodes]
  double most_u_ = 0;             // m
};

void store(const Combination& combination, Shape::Terms& terms) {
  constexpr double rounding = 1e-14;  // of weights that cancel
  for (const auto& [number, weight] : combination)
    if (std::abs(weight) > rounding) terms.all.push_back({Row<BoundaryNode>(number), weight});
  terms.close();
}

// Face by face: the data of a face is contiguous.
void store_points(Shape& shape, const SurfaceNet& net, const std::vector<Combination>& points,
                  const std::vector<double>& c) {
  shape.net = shape.points = {};
  for (int i = 0; i < net.nodes(); ++i) {
    Combination y{{i, 1.0}};
    add(y, umbrella(net, i), -entry(c, i));
    store(y, shape.net);
  }
  std::vector<int> taken(points.size(), -1);
  for (Shape::Face& face : shape.faces)
    for (int& p : face.point) {
      if (entry(taken, p) < 0) {
        entry(taken, p) = shape.surface_points();
        store(entry(points, p), shape.points);
      }
      p = entry(taken, p);
    }
  shape.complete_points();
}

void store_faces(Shape& shape, const SurfaceNet& net) {
  shape.faces.clear();
  for (int f = 0; f < net.faces(); ++f) {
    Shape::Face& face = shape.faces.emplace_back();
    face.point = points_of(net, f);
    face.neighbour = entry(net.neighbour, f);
    face.element = entry(net.element, f);
    for (int k = 0; k < 4; ++k) entry(face.corner, k) = Row<BoundaryNode>(net.node({f, k}));
  }
}

// The surface nodes, with the points at the corners of their faces.
void measure_nodes(Shape& shape, const std::vector<Vec3>& points, const Fit& fit) {
  constexpr std::array corner_point{0, 3, 15, 12};
  shape.surface_node.assign(static_cast<std::size_t>(shape.boundary_nodes), {});
  for (const Shape::Face& face : shape.faces)
    for (int k = 0; k < 4; ++k) {
      const Row<BoundaryNode> corner = entry(face.corner, k);
      Shape::SurfaceNode& node = entry(shape.surface_node, corner);
      node.point = entry(face.point, entry(corner_point, k));
      const Vec3 off = vector_of(entry(shape.nodes, corner.value)) - entry(points, node.point);
      const double slack = fit.is_flat(corner.value) ? flat_slack : curved_slack;
      node.size = std::max(node.size, face.size);
      node.slack = std::max({node.slack, node_growth * off.norm(), slack * face.size});
      node.stiffness += 0.25 * face.size * face.size / face.thickness;
    }
  for (int i = 0; i < shape.boundary_nodes; ++i)
    entry(shape.node_at, entry(shape.surface_node, i).point) = i;
}

// Contact springs, on average k K over the thickness of the elements behind. They are in proportion to the mass that they
// move: equal thickness would let the light nodes along the edges of the cube alone set the time step, 1.3 times shorter. A mesh of
// very different elements keeps to these, within limits.
void set_springs(Shape& shape) {
  constexpr double softest = 0.4, stiffest = 2.5;  // over that of the element behind
  std::vector<double> area(static_cast<std::size_t>(shape.boundary_nodes), 0);
  for (const Shape::Face& face : shape.faces)
    for (const auto corner : face.corner) entry(area, corner) += 0.25 * face.size * face.size;
  const auto depth = [&](const Shape::Face& face) {  // m, volume over area of its lightest node
    double least = std::numeric_limits<double>::infinity();
    for (const auto corner : face.corner)
      least = std::min(least, entry(shape.nodal_volume, corner.value) / entry(area, corner));
    return least;
  };
  double by_thickness = 0, by_depth = 0;
  for (const Shape::Face& face : shape.faces) {
    by_thickness += face.size * face.size / face.thickness;
    by_depth += face.size * face.size * depth(face);
  }
  shape.mean_face_stiffness = 0;
  for (Shape::Face& face : shape.faces) {
    face.stiffness = std::clamp(by_thickness / by_depth * depth(face), softest / face.thickness,
                                stiffest / face.thickness);
    shape.mean_face_stiffness += face.size * face.size * face.stiffness / shape.area;
  }
}

// Areas, and the particle's properties that follow from them.
void measure(Shape& shape, const Fit& fit) {
  const std::vector<Vec3> points = surface_points_of(shape, shape.nodes);
  shape.area = 0;
  for (Shape::Face& face : shape.faces) {
    double area = 0;
    for (int g = 0; g < Shape::gauss_points; ++g) {
      const PatchPlace at = gauss_place(g);
      entry(face.weight, g) = at.weight * patch_at(face, points, at.u, at.v).area().norm();
      area += entry(face.weight, g);
    }
    face.size = std::sqrt(area);
    face.thickness = entry(shape.element, face.element).volume / area;
    shape.area += area;
  }
  set_springs(shape);
  measure_nodes(shape, points, fit);
  shape.radius = 0;
  for (const Vec3& p : points) shape.radius = std::max(shape.radius, p.norm());
  for (const Point& p : shape.nodes) shape.radius = std::max(shape.radius, vector_of(p).norm());
}

}  // namespace

void complete_surface(Shape& shape, const StarSurface& surface) {
  const SurfaceNet net = surface_net(shape);
  const Fit fit(shape, net, surface);
  store_faces(shape, net);
  store_points(shape, net, fit.points(), fit.smoothing());
  shape.surface_error = fit.reached().distance;
  shape.surface_bulge = fit.reached().bulge;
  if (!(fit.reached().cosine > 0)) throw std::invalid_argument("its smoothed surface is folded");
  measure(shape, fit);
}

}  // namespace pulvis::space
