// Rigid tools in three dimensions against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "scenes/tools/surfaces/tool_shapes.hpp"
#include "scenes/tools/surfaces/triangle_mesh.hpp"
#include "systems/space/contact/tool_search.hpp"
#include "systems/space/tools/tool_projection.hpp"
#include "tests/systems/space/contact/touching_bodies.hpp"

namespace pulvis::space {
namespace {

VectorLanes everywhere_at(const Vec3& p) { return everywhere({p.x(), p.y(), p.z()}); }
Vec3 normal_of(const SurfaceGap& s) { return {s.normal.x[0], s.normal.y[0], s.normal.z[0]}; }

struct RandomPoints {
  std::mt19937_64 random{1};
  Vec3 operator()(double size) {
    std::uniform_real_distribution<double> in(-size, size);
    return {in(random), in(random), in(random)};
  }
};

TEST(SpaceTools, ADieIsTheInsideOfACylinder) {
  RandomPoints points;
  const Vec3 axis = Vec3(1, 2, -0.5).normalized();
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = points(2);
    const Vec3 arm = p - p.dot(axis) * axis;
    const SurfaceGap s = in_hole(1.5, {axis.x(), axis.y(), axis.z()}, everywhere_at(p));
    EXPECT_NEAR(s.gap[0], arm.norm() - 1.5, 1e-14);
    EXPECT_LT((normal_of(s) + arm.normalized()).norm(), 1e-13);
  }
}

ToolSpec die_with_mouth(double radius, double height, double rounding) {
  ToolSpec tool;
  tool.normal = Vec3::UnitZ();
  tool.shape = ToolSpec::Shape::die;
  tool.diameter = 2 * radius;
  tool.height = height;
  tool.rounding = rounding;
  return tool;
}

// The solid outside a hole and below its mouth, whose edge is a quarter of a torus.
TEST(SpaceTools, ADieEndsAtItsMouth) {
  constexpr double radius = 1.5, height = 0.4, rounding = 0.25;
  Scene scene;
  scene.tools = {die_with_mouth(radius, height, rounding)};
  const ToolShapes shapes = tool_shapes(scene);
  RandomPoints points;
  int at_edge = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = points(2.5);
    const double r = std::hypot(p.x(), p.y());
    const double out = r - radius, up = p.z() - height;  // from the sharp edge
    const double u = out - rounding, v = up + rounding;  // from the centre of the arc
    const bool arc = u < 0 && v > 0;
    // Outside the solid, or nearer to one of its sides than the other: inside, the nearest part of the surface.
    const double side = v < 0 ? out : 1e30, face = u > 0 ? -up : 1e30;
    const double gap =
        arc ? rounding - std::hypot(u, v) : (std::abs(side) < std::abs(face) ? side : face);
    const SurfaceGap s = on_revolution(shapes.of_tool[0].meridian, {0, 0, 1}, everywhere_at(p), 10);
    EXPECT_NEAR(s.gap[0], gap, 1e-12) << p.transpose();
    if (arc) {
      const Vec3 outward(p.x() / r, p.y() / r, 0);
      const Vec3 normal = (u * outward + v * Vec3::UnitZ()).normalized();
      EXPECT_LT((normal_of(s) - normal).norm(), 1e-11);
      ++at_edge;
    }
  }
  EXPECT_GT(at_edge, 100);
}

ToolSpec punch(std::vector<Vec2> profile) {
  ToolSpec tool;
  tool.normal = Vec3::UnitZ();
  tool.shape = ToolSpec::Shape::punch;
  tool.diameter = 2;
  tool.profile = std::move(profile);
  return tool;
}

TEST(SpaceTools, APunchThatFillsItsDieIsFlatBeyondItsRim) {
  RandomPoints points;
  const ToolSurface meridian = punch_meridian(punch({}), true);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = points(1.9);
    const SurfaceGap s = on_revolution(meridian, {0, 0, 1}, everywhere_at(p), 10);
    EXPECT_NEAR(s.gap[0], -p.z(), 1e-14);
    EXPECT_LT((normal_of(s) - Vec3::UnitZ()).norm(), 1e-13);
  }
}

// Outside: the distance of the whole solid cylinder; inside: to the nearer of face and side.
TEST(SpaceTools, APunchAloneHasASide) {
  RandomPoints points;
  const ToolSurface meridian = punch_meridian(punch({}), false);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = points(1.9);
    const double out = std::hypot(p.x(), p.y()) - 1, up = p.z();
    const double expected = out > 0 && up > 0 ? std::hypot(out, up) : std::max(out, up);
    EXPECT_NEAR(on_revolution(meridian, {0, 0, 1}, everywhere_at(p), 10).gap[0], -expected, 1e-13);
  }
}

// A cone with its tip up: the distance to its mantle, or to its tip where that is nearer.
TEST(SpaceTools, APunchWithAProfile) {
  RandomPoints points;
  const double slope = 0.5;
  const ToolSurface meridian = punch_meridian(punch({Vec2(0, 0), Vec2(1, -slope)}), false);
  int at_tip = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = 0.3 * points(1);
    const double r = std::hypot(p.x(), p.y()), z = p.z();
    const double along = (r - slope * z) / std::hypot(1, slope);
    const double mantle = (z + slope * r) / std::hypot(1, slope);
    const bool tip = along < 0 && mantle > 0;
    at_tip += tip ? 1 : 0;
    EXPECT_NEAR(on_revolution(meridian, {0, 0, 1}, everywhere_at(p), 10).gap[0],
                -(tip ? p.norm() : mantle), 1e-13);
  }
  EXPECT_GT(at_tip, 10);
}

// Two triangles a side, normals outward.
std::vector<std::array<Vec3, 3>> cube(double half) {
  std::vector<std::array<Vec3, 3>> triangles;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const auto corner = [&](double a, double b) {
        Vec3 p;
        p[axis] = side * half;
        p[(axis + 1) % 3] = half * (side > 0 ? a : b);
        p[(axis + 2) % 3] = half * (side > 0 ? b : a);
        return p;
      };
      triangles.push_back({corner(-1, -1), corner(1, -1), corner(1, 1)});
      triangles.push_back({corner(-1, -1), corner(1, 1), corner(-1, 1)});
    }
  return triangles;
}
double outside_cube(const Vec3& p, double half) {
  const Vec3 q = p.cwiseAbs() - Vec3::Constant(half);
  return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
}

TEST(SpaceTools, AMeshIsTheSignedDistanceToItsTriangles) {
  RandomPoints points;
  const TriangleMesh mesh = triangle_mesh(cube(1));
  ASSERT_EQ(mesh.triangles.size(), 12U);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = points(1.8), q = p + Vec3::Constant(1e-6);
    std::vector<std::int32_t> near;
    const Point at{p.x(), p.y(), p.z()};
    triangles_near(mesh, Box{at, at}, 4, near);
    const SurfaceGap s = on_mesh(mesh, near, everywhere_at(p), 4);
    EXPECT_NEAR(s.gap[0], -outside_cube(p, 1), 1e-12);
    // The normal is the slope of the distance.
    const double moved = outside_cube(q, 1) - outside_cube(p, 1);
    EXPECT_NEAR(normal_of(s).dot(q - p), moved, 1e-9);
  }
}

// A wedge along y whose edge, in which its sides meet at `angle`, is at the origin. Extra corners divide the edge of one side
// only: a fan of flat triangles from its corner `apex` joins them to the whole edge of the other.
std::vector<std::array<Vec3, 3>> wedge(double angle, const std::vector<double>& extra,
                                       std::size_t apex) {
  const double x = std::sin(angle / 2), z = -std::cos(angle / 2);
  const Vec3 back(0, 1, 0), front(0, -1, 0), left_back(-x, 1, z), left_front(-x, -1, z),
      right_back(x, 1, z), right_front(x, -1, z);
  std::vector<std::array<Vec3, 3>> triangles{{front, left_front, right_front},
                                             {back, right_back, left_back},
                                             {left_front, left_back, right_back},
                                             {left_front, right_back, right_front},
                                             {front, back, left_back},
                                             {front, left_back, left_front},
                                             {right_front, right_back, back}};
  std::vector<Vec3> edge{front};
  for (const double y : extra) edge.emplace_back(0, y, 0);
  edge.push_back(back);
  for (std::size_t i = 0; i + 1 < edge.size(); ++i)
    triangles.push_back({edge[i], right_front, edge[i + 1]});
  for (std::size_t i = 1; i + 1 < edge.size(); ++i) {
    const auto corner = [&](std::size_t k) { return edge[(apex + k) % edge.size()]; };
    triangles.push_back({corner(0), corner(i), corner(i + 1)});
  }
  return triangles;
}

SurfaceGap on_closed_mesh(const TriangleMesh& mesh, const Vec3& p) {
  std::vector<std::int32_t> near;
  const Point at{p.x(), p.y(), p.z()};
  triangles_near(mesh, Box{at, at}, 4, near);
  return on_mesh(mesh, near, everywhere_at(p), 4);
}

// At any orientation and size: rounding brings corners off the line.
TEST(SpaceTools, FlatTrianglesDoNotChangeTheDistance) {
  RandomPoints points;
  const Eigen::Matrix3d turn =
      1e-3 * Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (const Eigen::Matrix3d& placed : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), turn})
    for (const double degrees : {40.0, 90.0, 140.0})
      for (const std::size_t apex : {0, 1, 2, 3, 4}) {
        const double size = placed.col(0).norm();
        const auto mesh_of = [&](const std::vector<double>& corners) {
          auto triangles = wedge(degrees * std::numbers::pi / 180, corners, apex);
          for (auto& triangle : triangles)
            for (Vec3& p : triangle) p = placed * p;
          return triangle_mesh(triangles);
        };
        const TriangleMesh plain = mesh_of({}), divided = mesh_of({-0.4, 0.1, 0.5});
        ASSERT_EQ(divided.triangles.size(), 14U);
        EXPECT_LT(on_closed_mesh(plain, placed * Vec3(0, 0, 0.5)).gap[0], -0.4 * size);
        for (int i = 0; i < 500; ++i) {
          const Vec3 p = placed * points(i % 2 == 0 ? 1.3 : 0.1);
          const SurfaceGap a = on_closed_mesh(plain, p), b = on_closed_mesh(divided, p);
          ASSERT_NEAR(b.gap[0], a.gap[0], 1e-12 * size) << degrees << " deg, " << apex;
          ASSERT_LT((normal_of(b) - normal_of(a)).norm(), 1e-9);
        }
      }
}

TEST(SpaceTools, TrianglesNearABoxAreAllThatAre) {
  RandomPoints points;
  std::vector<std::array<Vec3, 3>> triangles;
  for (int i = 0; i < 300; ++i) {
    const Vec3 middle = points(10);
    triangles.push_back({middle, middle + points(1), middle + points(1)});
  }
  const TriangleMesh mesh = triangle_mesh(triangles);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p = points(10);
    const Box box{{p.x(), p.y(), p.z()}, {p.x() + 1, p.y() + 2, p.z() + 0.5}};
    std::vector<std::int32_t> found, expected;
    triangles_near(mesh, box, 0.7, found);
    std::ranges::sort(found);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      Box own{mesh.triangles[t].corner[0], mesh.triangles[t].corner[0]};
      for (const Point& c : mesh.triangles[t].corner) own = joined(own, Box{c, c});
      if (near(own, box, 0.7)) expected.push_back(static_cast<std::int32_t>(t));
    }
    // Triangles come in leaves of up to four, whose common box is looked at.
    EXPECT_TRUE(std::ranges::includes(found, expected));
    EXPECT_LE(found.size(), expected.size() + 60);
  }
}

// A ball that is pressed on a mesh whose surface is a plane, on a flat punch and on a plane bears the same.
TEST(SpaceTools, ToolsWithTheSameSurfaceBearTheSame) {
  constexpr double diameter = 10e-3;
  const Vec3 point(4e-3, -2e-3, 0.3);
  const Shape ball = space::make_shape(sphere_of(diameter));
  std::vector<double> forces;
  for (const auto shape : {ToolSpec::Shape::plane, ToolSpec::Shape::punch, ToolSpec::Shape::stl}) {
    const Vec3 on_top = point + Vec3(0, 0, diameter / 2 - 100e-6);
    TouchingBodies w({ball}, {body_at(on_top)}, [&](Scene& s) {
      ToolSpec tool;
      tool.normal = Vec3::UnitZ();
      tool.name = "tool";
      tool.point = point;
      tool.shape = shape;
      tool.diameter = 1;
      for (auto& triangle : cube(0.05)) {
        for (Vec3& p : triangle) p.z() -= 0.05;
        tool.triangles.push_back(triangle);
      }
      s.tools = {tool};
    });
    w.update();
    forces.push_back(w.force_on(0).z());
    const double* on_tool = w.world.column<ToolForce>().values();
    EXPECT_NEAR(on_tool[2], -forces.back(), 1e-12 * forces.back());
  }
  ASSERT_GT(forces[0], 1e3);
  EXPECT_NEAR(forces[1], forces[0], 1e-11 * forces[0]);
  EXPECT_NEAR(forces[2], forces[0], 1e-11 * forces[0]);
}

void expect_forces_are_the_slope_of_the_energy(const ToolSpec& die) {
  constexpr double diameter = 10e-3, h = 1e-8;
  TouchingBodies w({space::make_shape(sphere_of(diameter))}, {body_at(Vec3(2.15e-3, 0.4e-3, 0))},
                   [&](Scene& s) { s.tools = {die}; });
  w.update();
  const Vec3 force = w.force_on(0);
  ASSERT_GT(force.norm(), 100);
  for (int k = 0; k < 3; ++k) {
    const auto energy_at = [&](double shift) {
      w.move(0, [&](const Vec3& x) { return Vec3(x + shift * Vec3::Unit(k)); });
      w.update();
      return w.energy();
    };
    const double above = energy_at(h), below = energy_at(-2 * h);
    energy_at(h);
    EXPECT_NEAR(-(above - below) / (2 * h), force[k], 1e-5 * force.norm());
  }
}

TEST(SpaceTools, ForcesInADieAreTheSlopeOfTheEnergy) {
  ToolSpec die = die_with_mouth(7e-3, 0, 0);
  die.height.reset();
  expect_forces_are_the_slope_of_the_energy(die);
}

// A ball that bears on the wall, and on the edge of the mouth.
TEST(SpaceTools, ForcesAtTheMouthOfADieAreTheSlopeOfTheEnergy) {
  expect_forces_are_the_slope_of_the_energy(die_with_mouth(7e-3, 1.5e-3, 1e-3));
  expect_forces_are_the_slope_of_the_energy(die_with_mouth(7e-3, 0.6e-3, 1e-3));
}

// Far below its mouth a die acts as one without an end.
TEST(SpaceTools, ADieIsTheSameFarBelowItsMouth) {
  ToolSpec endless = die_with_mouth(7e-3, 0, 0);
  endless.height.reset();
  std::vector<Vec3> forces;
  for (const ToolSpec& die : {endless, die_with_mouth(7e-3, 20e-3, 1e-3)}) {
    TouchingBodies w({space::make_shape(sphere_of(10e-3))}, {body_at(Vec3(2.15e-3, 0.4e-3, 0))},
                     [&](Scene& s) { s.tools = {die}; });
    w.update();
    forces.push_back(w.force_on(0));
  }
  ASSERT_GT(forces[0].norm(), 100);
  EXPECT_LT((forces[1] - forces[0]).norm(), 1e-10 * forces[0].norm());
}

}  // namespace
}  // namespace pulvis::space
