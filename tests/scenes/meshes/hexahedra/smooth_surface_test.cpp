// Smooth surfaces: that they are smooth, also when the particle has been deformed; loads; where they lie.
#include "scenes/meshes/hexahedra/smooth_surface.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "tests/scenes/meshes/hexahedra/shape_cases.hpp"

namespace pulvis::space {
namespace {

const std::vector<int> divisions_of_cases{1, 2, 3, 4, 5};

// Nodes of a particle that was pressed, sheared and dented: nothing of its symmetry is left.
std::vector<Point> dented(const Shape& shape) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> even(-1, 1);
  std::vector<Point> nodes = shape.nodes;
  for (Point& p : nodes) {
    const double z = 0.6 * p[2] + 0.2 * p[0] * p[1] / shape.radius;
    p = {p[0] + 0.4 * z, 1.2 * p[1] - 0.1 * p[0] * p[0] / shape.radius, z};
    for (double& x : p) x += 0.02 * shape.radius * even(random);
  }
  return nodes;
}

struct Seam {
  double gap = 0, kink = 0;  // m; sine of the angle between the normals
};
Seam worst_seam(const Shape& shape, const std::vector<Vec3>& points) {
  Seam worst;
  for (const Shape::Face& face : shape.faces)
    for (int s = 0; s < 4; ++s) {
      const Shape::Neighbour beyond = entry(face.neighbour, s);
      for (int k = 0; k <= 10; ++k) {
        const auto here = on_side(s, k / 10.0), there = on_side(beyond.side, 1 - k / 10.0);
        const PatchPoint a = patch_at(face, points, here[0], here[1]);
        const PatchPoint b = patch_at(entry(shape.faces, beyond.face), points, there[0], there[1]);
        worst.gap = std::max(worst.gap, (a.at - b.at).norm());
        worst.kink =
            std::max(worst.kink, a.area().normalized().cross(b.area().normalized()).norm());
      }
    }
  return worst;
}

struct SurfaceCase {
  std::string name;
  Shape shape;
};
const std::vector<SurfaceCase>& surface_cases() {
  static const std::vector<SurfaceCase> cases = [] {
    std::vector<SurfaceCase> made;
    for (const ShapeCase& c : shape_cases())
      for (const int n : divisions_of_cases)
        made.push_back({c.name + ", " + std::to_string(n) + " divisions", shape_of(c.shape, n, 1)});
    for (const auto& [name, shape] : extruded_cases()) made.push_back({"extruded " + name, shape});
    return made;
  }();
  return cases;
}

TEST(SmoothSurface, HasWeightsThatSumToOne) {
  for (const auto& [name, shape] : surface_cases()) {
    SCOPED_TRACE(name);
    for (const Shape::Terms* terms : {&shape.net, &shape.points})
      for (int p = 0; p < terms->points(); ++p) {
        double sum = 0;
        for (const Shape::Term& term : terms->of(p)) sum += term.weight;
        EXPECT_NEAR(sum, 1, 1e-13);
      }
  }
}

// What a Bezier point looks at ends within four faces: the force at a contact stays where it is.
TEST(SmoothSurface, IsMadeOfNodesNearBy) {
  const Shape shape = shape_of(SphereShape{2}, 8, 1);
  const std::vector<Vec3> points = surface_points_of(shape, shape.nodes);
  for (int p = 0; p < shape.surface_points(); ++p)
    for (const Shape::Term& of_net : shape.points.of(p))
      for (const Shape::Term& term : shape.net.of(static_cast<int>(of_net.row.value)))
        EXPECT_LT((entry(points, p) - node_of(shape, term.row.value)).norm(),
                  4.5 * shape.faces[0].size);
}

TEST(SmoothSurface, NeighboursFindBack) {
  for (const auto& [name, shape] : surface_cases()) {
    SCOPED_TRACE(name);
    for (int f = 0; f < static_cast<int>(shape.faces.size()); ++f)
      for (int s = 0; s < 4; ++s) {
        const Shape::Face& face = entry(shape.faces, f);
        const Shape::Neighbour beyond = entry(face.neighbour, s);
        const Shape::Face& other = entry(shape.faces, beyond.face);
        EXPECT_EQ(entry(other.neighbour, beyond.side).face, f);
        EXPECT_EQ(entry(other.neighbour, beyond.side).side, s);
        EXPECT_EQ(entry(face.corner, s), entry(other.corner, (beyond.side + 1) % 4));
        EXPECT_EQ(entry(face.corner, (s + 1) % 4), entry(other.corner, beyond.side));
      }
  }
}

// Round-off alone: the surface is closed and has one tangent plane on both sides of every seam, undeformed or not.
TEST(SmoothSurface, IsClosedAndHasNoKinks) {
  for (const auto& [name, shape] : surface_cases()) {
    SCOPED_TRACE(name);
    for (const std::vector<Point>& nodes : {shape.nodes, dented(shape)}) {
      const Seam worst = worst_seam(shape, surface_points_of(shape, nodes));
      EXPECT_LT(worst.gap, 1e-14 * shape.radius);
      EXPECT_LT(worst.kink, 1e-10);  // of tangents that may be short on a dented needle
    }
  }
}

// About nodes of four faces far from the eight corners even the curvature is continuous: second derivatives across seams.
TEST(SmoothSurface, IsCurvedEvenlyAwayFromTheCorners) {
  const Shape shape = shape_of(SphereShape{2}, 8, 1);
  const std::vector<Vec3> points = surface_points_of(shape, dented(shape));
  const int row = 8, inner = 3 * row + 3;  // a face in the middle of the first side of the cube
  const auto point = [&](int face, int i, int j) {
    return entry(points, entry(shape.faces, face).point[static_cast<std::size_t>(4 * j + i)]);
  };
  for (int j = 0; j < 4; ++j) {
    const Vec3 before = point(inner, 3, j) - 2 * point(inner, 2, j) + point(inner, 1, j);
    const Vec3 behind =
        point(inner + 1, 0, j) - 2 * point(inner + 1, 1, j) + point(inner + 1, 2, j);
    EXPECT_LT((before - behind).norm(), 1e-14);
    EXPECT_GT(before.norm(), 1e-4);
  }
}

TEST(SmoothSurface, LiesOnASphereWithin1e3OfTheRadiusAndConverges) {
  std::vector<double> error;
  for (const int divisions : {4, 8, 16}) {
    const Shape shape = shape_of(SphereShape{2}, divisions, 1);
    const std::vector<Vec3> points = surface_points_of(shape, shape.nodes);
    error.push_back(0);
    for (const Shape::Face& face : shape.faces)
      for (int k = 0; k < 121; ++k)
        error.back() =
            std::max(error.back(),
                     std::abs(patch_at(face, points, k % 11 / 10.0, k / 11 / 10.0).at.norm() - 1));
  }
  EXPECT_LT(error[0], 1e-3);
  EXPECT_LT(error[1],
            0.45 * error[0]);  // first order in the worst point, at a corner; 1.3 are seen
  EXPECT_LT(error[2], 0.45 * error[1]);
}

TEST(SmoothSurface, HoldsTheVolumeOfTheTrueShape) {
  for (const auto& [name, shape] : surface_cases()) {
    SCOPED_TRACE(name);
    EXPECT_NEAR(smooth_volume(shape, surface_points_of(shape, shape.nodes)), shape.true_volume,
                1e-5 * shape.true_volume);
  }
}

// Sharp and flat shapes, from meshes that hardly resolve them.
std::vector<SurfaceCase> sharp_cases() {
  const std::vector<ShapeCase> shapes{
      {"cube", box_shape({1, 1, 1}, 0.05)},
      {"octahedron",
       PolyhedronShape{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                       0.05}},
      {"tablet", CylinderShape{1, 0.2, 0.02}},
      {"plate", SuperquadricShape{Vec3(1, 1, 0.3), 20, 20}}};
  std::vector<SurfaceCase> cases;
  for (const ShapeCase& c : shapes)
    for (const int n : {2, 3, 4, 6})
      cases.push_back({c.name + ", " + std::to_string(n) + " divisions", shape_of(c.shape, n, 1)});
  return cases;
}

// Its normals look outwards, in the corners of its faces, too.
TEST(SmoothSurface, IsNowhereFolded) {
  constexpr int steps = 40;
  for (const auto& [name, shape] : sharp_cases()) {
    SCOPED_TRACE(name);
    const std::vector<Vec3> points = surface_points_of(shape, shape.nodes);
    double least = 1;
    for (const Shape::Face& face : shape.faces)
      for (int i = 0; i <= steps; ++i)
        for (int j = 0; j <= steps; ++j) {
          const PatchPoint at = patch_at(face, points, static_cast<double>(i) / steps,
                                         static_cast<double>(j) / steps);
          least = std::min(least, at.area().normalized().dot(at.at.normalized()));
        }
    EXPECT_GT(least, 0.1);
  }
}

// Flat faces leave it to no noise how their nodes are smoothed: the same bits each time, whatever was in memory before.
TEST(SmoothSurface, IsTheSameEachTime) {
  const auto weights = [](const Shape& shape) {
    std::vector<double> all;
    for (const Shape::Terms* terms : {&shape.net, &shape.points})
      for (const Shape::Term& term : terms->all) all.push_back(term.weight);
    return all;
  };
  for (const double rounding : {0.05, 0.1})
    for (const int n : {3, 4, 6}) {
      SCOPED_TRACE(n);
      const PolyhedronShape octahedron{
          {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, rounding};
      const std::vector<double> first = weights(shape_of(octahedron, n, 1));
      for (int time = 0; time < 3; ++time) EXPECT_EQ(weights(shape_of(octahedron, n, 1)), first);
    }
}

// How far it is off its shape is what a coarse mesh is warned of.
TEST(SmoothSurface, TellsHowFarItIsOffItsShape) {
  const Shape ball = shape_of(SphereShape{2}, 4, 1);
  EXPECT_GT(ball.surface_error, 1e-4);
  EXPECT_LT(ball.surface_error, 1e-3);
  double before = std::numeric_limits<double>::infinity();
  for (const int n : {2, 4, 8}) {
    const double error = shape_of(box_shape({1, 1, 1}, 0.05), n, 1).surface_error;
    EXPECT_LT(error, 0.6 * before);
    before = error;
  }
  EXPECT_GT(before, 5e-3);  // an edge of a tenth of the faces' width is not resolved
}

// Forces of a pressure 1 on the nodes, by the Gauss points of the faces.
std::vector<Vec3> pressure_loads(const Shape& shape, const std::vector<Point>& nodes) {
  const std::vector<Vec3> points = surface_points_of(shape, nodes);
  std::vector<Vec3> on_point(points.size(), Vec3::Zero()), load(nodes.size(), Vec3::Zero());
  const auto bernstein = [](double u) {
    return std::array{(1 - u) * (1 - u) * (1 - u), 3 * u * (1 - u) * (1 - u), 3 * u * u * (1 - u),
                      u * u * u};
  };
  for (const Shape::Face& face : shape.faces)
    for (int g = 0; g < Shape::gauss_points; ++g) {
      const PatchPlace at = gauss_place(g);
      const Vec3 area = at.weight * patch_at(face, points, at.u, at.v).area();
      for (int k = 0; k < 16; ++k)
        entry(on_point, entry(face.point, k)) +=
            entry(bernstein(at.u), k % 4) * entry(bernstein(at.v), k / 4) * area;
    }
  for (int p = 0; p < shape.surface_points(); ++p)
    for (const Shape::Term& of_net : shape.points.of(p))
      for (const Shape::Term& term : shape.net.of(static_cast<int>(of_net.row.value)))
        entry(load, term.row) += of_net.weight * term.weight * entry(on_point, p);
  return load;
}

// 4 x 4 points integrate the area vector (degree 5) exactly, the moment and the volume (degree 8) but for a little.
TEST(SmoothSurface, AUniformPressureHasNeitherForceNorMoment) {
  for (const auto& [name, shape] : surface_cases()) {
    SCOPED_TRACE(name);
    const std::vector<Point> nodes = dented(shape);
    const std::vector<Vec3> load = pressure_loads(shape, nodes);
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    double size = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      force += load[i];
      moment += Vec3(nodes[i][0], nodes[i][1], nodes[i][2]).cross(load[i]);
      size += load[i].norm();
    }
    EXPECT_LT(force.norm(), 1e-13 * size);
    EXPECT_LT(moment.norm(), 1e-5 * size * shape.radius);
  }
}

TEST(SmoothSurface, AUniformPressureWorksOnTheVolumeItEncloses) {
  const Shape shape = shape_of(SuperquadricShape{Vec3(2, 1, 1), 4, 3}, 3, 1);
  const std::vector<Point> nodes = dented(shape);
  const std::vector<Vec3> load = pressure_loads(shape, nodes);
  const double step = 1e-5;
  std::vector<Point> more = nodes, less = nodes;
  double work = 0;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> even(-1, 1);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const double way = even(random);
      more[i][k] += step * way;
      less[i][k] -= step * way;
      work += load[i][static_cast<Eigen::Index>(k)] * way;
    }
  const double rise = (smooth_volume(shape, surface_points_of(shape, more)) -
                       smooth_volume(shape, surface_points_of(shape, less))) /
                      (2 * step);
  EXPECT_NEAR(work, rise, 1e-4 * std::abs(work));
}

// m^2, a quarter of every face.
std::vector<double> shares_of_nodes(const Shape& shape) {
  std::vector<double> share(static_cast<std::size_t>(shape.boundary_nodes));
  for (const Shape::Face& face : shape.faces)
    for (const Row<BoundaryNode> corner : face.corner)
      entry(share, corner) += face.size * face.size / 4;
  return share;
}

// Uneven loads on a flat face would push every other node through a tool. All but the outermost two rows of the faces of
// boxes and cylinders with rounded rims.
TEST(SmoothSurface, AUniformPressureOnAFlatFaceLoadsTheNodesEvenly) {
  for (const ParticleShape& of :
       {ParticleShape(CylinderShape{1, 0.7, 0.2}), ParticleShape(box_shape({1, 1, 1}, 0.1))})
    for (const int divisions : {6, 7, 8, 10}) {
      SCOPED_TRACE(divisions);
      const Shape shape = shape_of(of, divisions, 1);
      const std::vector<Vec3> load = pressure_loads(shape, shape.nodes);
      const std::vector<double> share = shares_of_nodes(shape);
      double top = 0;
      for (const Point& node : shape.nodes) top = std::max(top, node[2]);
      int looked_at = 0;
      for (int i = 0; i < shape.boundary_nodes; ++i) {
        const Vec3 node = node_of(shape, i);
        if (node.z() < top - 0.02 || node.head<2>().norm() > 0.36 - 0.8 / divisions) continue;
        EXPECT_NEAR(entry(load, i).z() / entry(share, i), 1, 0.1) << node.transpose();
        ++looked_at;
      }
      EXPECT_GT(looked_at, 0);
    }
}

// Of a sphere, against what pressure on the flat-sided elements would load them with: no node is left out, none is
// pulled; most of all a corner, 0.77.
TEST(SmoothSurface, AUniformPressureLoadsTheNodesEvenly) {
  const Shape shape = shape_of(SphereShape{2}, 4, 2);
  const std::vector<Vec3> load = pressure_loads(shape, shape.nodes);
  const std::vector<double> share = shares_of_nodes(shape);
  for (int i = 0; i < shape.boundary_nodes; ++i) {
    const double ratio = entry(load, i).dot(node_of(shape, i).normalized()) / entry(share, i);
    EXPECT_GT(ratio, 0.7) << i;
    EXPECT_LT(ratio, 1.15) << i;
  }
}

TEST(SmoothSurface, OfASphereHasTheSymmetriesOfTheCube) {
  const Shape shape = shape_of(SphereShape{2}, 3, 1);
  const std::vector<Vec3> points = surface_points_of(shape, shape.nodes);
  const auto has_point = [&](const Vec3& p) {
    return std::ranges::any_of(points, [&](const Vec3& q) { return (q - p).norm() < 1e-9; });
  };
  for (const Vec3& p : points) {
    EXPECT_TRUE(has_point({p.y(), p.z(), p.x()}));
    EXPECT_TRUE(has_point({p.y(), p.x(), p.z()}));
    EXPECT_TRUE(has_point({-p.x(), p.y(), p.z()}));
  }
}

}  // namespace
}  // namespace pulvis::space
