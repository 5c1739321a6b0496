// Meshes of all shapes: volume, elements that are not folded, symmetry, evenness.
#include "scenes/meshes/hexahedra/mesh.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "scenes/meshes/hexahedra/thinnest.hpp"
#include "tests/scenes/meshes/hexahedra/shape_cases.hpp"

namespace pulvis::space {
namespace {

const std::vector<std::array<int, 2>> mesh_sizes{{1, 1}, {1, 3}, {2, 1}, {3, 2},
                                                 {4, 4}, {5, 2}, {7, 1}};

struct MeshCase {
  std::string name;
  ParticleShape true_shape;
  int divisions, rings;
  Shape shape;
};
const std::vector<MeshCase>& mesh_cases() {
  static const std::vector<MeshCase> cases = [] {
    std::vector<MeshCase> made;
    for (const ShapeCase& c : shape_cases())
      for (const auto& [n, rings] : mesh_sizes)
        made.push_back(
            {c.name + ", " + std::to_string(n) + " divisions, " + std::to_string(rings) + " rings",
             c.shape, n, rings, shape_of(c.shape, n, rings)});
    return made;
  }();
  return cases;
}

TEST(SpaceMesh, HasTheCountsOfACubedSphere) {
  for (const auto& [name, true_shape, n, rings, shape] : mesh_cases()) {
    SCOPED_TRACE(name);
    EXPECT_EQ(shape.elements(), n * n * n + 6 * n * n * rings);
    EXPECT_EQ(shape.boundary_nodes, 6 * n * n + 2);
    EXPECT_EQ(static_cast<int>(shape.nodes.size()),
              rings * (6 * n * n + 2) + (n + 1) * (n + 1) * (n + 1));
  }
  EXPECT_EQ(shape_of(SphereShape{1}, 1, 1).elements(), 7);
  EXPECT_EQ(shape_of(SphereShape{1}, 4, 4).elements(), 448);
}

// Round-off of some thousand sums.
TEST(SpaceMesh, HasTheVolumeOfTheTrueShape) {
  for (const auto& [name, true_shape, n, rings, shape] : mesh_cases()) {
    SCOPED_TRACE(name);
    const double wanted = star_surface(true_shape)->volume();
    EXPECT_NEAR(mesh_volume(shape), wanted, 1e-12 * wanted);
    EXPECT_NEAR(shape.volume, wanted, 1e-12 * wanted);
    EXPECT_EQ(shape.true_volume, wanted);
  }
}

TEST(SpaceMesh, HasNoFoldedElement) {
  for (const auto& [name, true_shape, n, rings, shape] : mesh_cases()) {
    SCOPED_TRACE(name);
    double least = 1;
    for (int e = 0; e < shape.elements(); ++e)
      for (int g = 0; g < 27; ++g)  // corners, middles of edges and sides, middle
        least = std::min(least, jacobian(shape, e, Vec3(g % 3 - 1, g / 3 % 3 - 1, g / 9 - 1)) * 8 /
                                    entry(shape.element, e).volume);
    EXPECT_GT(least, 0.02);
  }
}

// Along z: as many elements as are as long there as across.
TEST(SpaceMesh, OfALongShapeHasElementsAsLongAsWide) {
  struct Case {
    ParticleShape shape;
    int divisions, rings, axial;
  };
  const Case cases[] = {{CylinderShape{6.4e-3, 32.4e-3, 0.1e-3}, 4, 2, 36},
                        {CylinderShape{12e-3, 4e-3, 0.5e-3}, 6, 2, 2},
                        {EllipsoidShape{Vec3(1, 1, 5)}, 3, 2, 20},
                        {SuperquadricShape{Vec3(1, 1, 4), 8, 4}, 2, 1, 7}};
  for (const auto& [form, n, rings, m] : cases) {
    SCOPED_TRACE(m);
    const Shape shape = shape_of(form, n, rings, m), cubic = shape_of(form, n, rings);
    EXPECT_EQ(shape.elements(), n * n * m + (2 * n * n + 4 * n * m) * rings);
    EXPECT_EQ(static_cast<int>(shape.faces.size()), 2 * n * n + 4 * n * m);
    EXPECT_NEAR(shape.volume, star_surface(form)->volume(), 1e-12 * shape.volume);
    for (int e = 0; e < shape.elements(); ++e)
      for (int g = 0; g < 27; ++g)
        EXPECT_GT(jacobian(shape, e, Vec3(g % 3 - 1, g / 3 % 3 - 1, g / 9 - 1)) * 8,
                  0.02 * entry(shape.element, e).volume);
    const auto slenderness = [](const Shape& of) {
      return std::cbrt(of.volume / of.elements()) / thinnest_part(of);
    };
    EXPECT_LT(slenderness(shape), 0.8 * slenderness(cubic));
  }
}

// Layers of a disc of n * n + 4 n rings, as many faces at either end, 4 n around each layer.
TEST(SpaceMesh, ExtrudedHasTheCountsOfADiscInLayers) {
  for (const auto& [n, rings, m] : {std::array{4, 3, 30}, {2, 1, 2}, {5, 2, 3}}) {
    SCOPED_TRACE(m);
    const Shape shape = extruded({1, 1, 0}, n, rings, m);
    const int disc = n * n + 4 * n * rings;
    ParticleSpec particle;
    particle.hex_mesh = {n, rings, m, HexMeshSpec::Grid::extruded};
    EXPECT_EQ(shape.elements(), disc * m);
    EXPECT_EQ(particle.hex_mesh.hexahedra(), shape.elements());
    EXPECT_EQ(particle.hex_mesh.faces(), static_cast<std::int64_t>(shape.faces.size()));
    EXPECT_EQ(particle.hex_mesh.surface_nodes(), shape.boundary_nodes);
    EXPECT_EQ(particle.hex_mesh.nodes(), static_cast<std::int64_t>(shape.nodes.size()));
    EXPECT_EQ(static_cast<int>(shape.faces.size()), 2 * disc + 4 * n * m);
    EXPECT_EQ(shape.boundary_nodes, static_cast<int>(shape.faces.size()) + 2);  // Euler
  }
}

TEST(SpaceMesh, ExtrudedHasTheVolumeOfTheCylinderAndEvenElements) {
  for (const auto& [name, shape] : extruded_cases()) {
    SCOPED_TRACE(name);
    EXPECT_NEAR(mesh_volume(shape), shape.true_volume, 1e-12 * shape.true_volume);
    const double mean = shape.volume / shape.elements();
    for (int e = 0; e < shape.elements(); ++e) {
      EXPECT_GT(entry(shape.element, e).volume, 0.4 * mean);
      for (int g = 0; g < 27; ++g)
        EXPECT_GT(jacobian(shape, e, Vec3(g % 3 - 1, g / 3 % 3 - 1, g / 9 - 1)) * 8,
                  0.2 * entry(shape.element, e).volume);
    }
  }
}

// The smallest element sets the time step of all.
TEST(SpaceMesh, OfASphereHasElementsOfSimilarSize) {
  for (const auto& [divisions, rings] : mesh_sizes) {
    const Shape shape = shape_of(SphereShape{1}, divisions, rings);
    const double mean = shape.volume / shape.elements();
    for (const Shape::Element& element : shape.element) EXPECT_GT(element.volume, 0.3 * mean);
    if (rings <= 2) {
      EXPECT_GT(thinnest_part(shape), 0.45 * std::cbrt(mean));
    }
  }
}

TEST(SpaceMesh, OfASphereHasTheSymmetriesOfTheCube) {
  const Shape shape = shape_of(SphereShape{2}, 4, 2);
  const auto has_node = [&](const Vec3& p) {
    return std::ranges::any_of(shape.nodes, [&](const Point& q) {
      return (Vec3(q[0], q[1], q[2]) - p).norm() <
             1e-9;  // sums in another order, over 200 steps of descent
    });
  };
  for (int i = 0; i < static_cast<int>(shape.nodes.size()); ++i) {
    const Vec3 p = node_of(shape, i);
    EXPECT_TRUE(has_node({p.y(), p.z(), p.x()})) << i;
    EXPECT_TRUE(has_node({p.y(), p.x(), p.z()})) << i;
    EXPECT_TRUE(has_node({-p.x(), p.y(), p.z()})) << i;
  }
}

TEST(SpaceMesh, IsTheSameInMicrometresAndInMetres) {
  const Shape small = shape_of(CylinderShape{2e-6, 1e-6, 0.2e-6}, 3, 2);
  const Shape large = shape_of(CylinderShape{2, 1, 0.2}, 3, 2);
  for (int i = 0; i < static_cast<int>(small.nodes.size()); ++i)
    EXPECT_LT((1e6 * node_of(small, i) - node_of(large, i)).norm(), 1e-6);
}

// Frequency of each boundary node on its contact springs, squared, the highest over the lowest; `stiffness` of a face.
template <class Stiffness>
double range_of_contact_frequencies(const Shape& shape, const Stiffness& stiffness) {
  std::vector<double> spring(static_cast<std::size_t>(shape.boundary_nodes), 0);
  for (const Shape::Face& face : shape.faces)
    for (const auto corner : face.corner)
      entry(spring, corner) += 0.25 * face.size * face.size * stiffness(face);
  double lowest = std::numeric_limits<double>::infinity(), highest = 0;
  for (int i = 0; i < shape.boundary_nodes; ++i) {
    const double square = entry(spring, i) / entry(shape.nodal_volume, i);
    lowest = std::min(lowest, square);
    highest = std::max(highest, square);
  }
  return highest / lowest;
}

// No node of a sphere is much faster on its contact springs than the others, and these are as stiff on average as those of
// the elements behind.
TEST(SpaceMesh, HasContactSpringsInProportionToTheMassOfItsNodes) {
  const Shape shape = shape_of(SphereShape{2}, 7, 1);
  const auto of_element = [](const Shape::Face& face) { return 1 / face.thickness; };
  EXPECT_GT(range_of_contact_frequencies(shape, of_element), 3);
  EXPECT_LT(range_of_contact_frequencies(shape, [](const auto& face) { return face.stiffness; }),
            1.8);
  double stiffness = 0;
  for (const Shape::Face& face : shape.faces)
    stiffness += face.size * face.size * of_element(face) / shape.area;
  EXPECT_NEAR(shape.mean_face_stiffness / stiffness, 1, 1e-12);
}

TEST(SpaceMesh, KnowsItsMeasures) {
  const Shape shape = shape_of(SphereShape{2}, 5, 2);
  EXPECT_NEAR(shape.area, 4 * std::numbers::pi, 2e-3 * shape.area);
  for (int i = 0; i < static_cast<int>(shape.nodes.size()); ++i)
    EXPECT_LE(node_of(shape, i).norm(), shape.radius);
  double faces = 0, stiffness = 0;
  for (const Shape::Face& face : shape.faces) {
    double area = 0;
    for (const double weight : face.weight) area += weight;
    EXPECT_NEAR(face.size * face.size, area, 1e-14);
    EXPECT_NEAR(face.thickness * area, entry(shape.element, face.element).volume, 1e-14);
    faces += area;
    stiffness += area * face.stiffness;
  }
  EXPECT_NEAR(faces, shape.area, 1e-12);
  EXPECT_NEAR(stiffness / faces, shape.mean_face_stiffness, 1e-12 * shape.mean_face_stiffness);
}

// Base: a rhomboid of width 1 along y.
TEST(ThinnestPart, IsTheWidthOfABrick) {
  Shape shape;
  for (const double z : {0.0, 0.5})
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {2.0, 0.0}, {3.0, 1.0}, {1.0, 1.0}})
      shape.nodes.push_back({x, y, z});
  shape.hexahedra.emplace_back();
  for (int i = 0; i < 8; ++i) entry(shape.hexahedra[0], i) = Row<Node>(i);
  EXPECT_NEAR(thinnest_part(shape), 0.5, 1e-15);
  for (Point& p : shape.nodes) p[2] *= 10;
  EXPECT_NEAR(thinnest_part(shape), 1, 1e-15);  // of the rhomboid, not its edge, which is sqrt 2
}

Rotation some_turn() { return Rotation(0.5, 0.7, -0.3, 0.4).normalized(); }

PolyhedronShape turned_by(const Rotation& turn, PolyhedronShape shape) {
  for (Vec3& corner : shape.corners) corner = turn * corner;
  return shape;
}

// However it lies in its file: as near to the true surface as along its own axes, but for what the search leaves open.
TEST(SpaceMesh, OfAPolyhedronIsLaidAlongTheShape) {
  for (const auto& [size, rounding] : {std::pair(Vec3(1, 1, 3), 0.1), {Vec3(3, 2, 1), 0.1}})
    for (const int n : {2, 4, 7}) {
      const PolyhedronShape straight = box_shape(size, rounding);
      const Shape along = shape_of(straight, n, 1),
                  askew = shape_of(turned_by(some_turn(), straight), n, 1);
      SCOPED_TRACE(std::to_string(n) + " divisions");
      EXPECT_LT(askew.surface_error, 1.2 * along.surface_error);
      EXPECT_LT(askew.surface_bulge, 1.2 * along.surface_bulge);
    }
}

// The edges of a tetrahedron are sharp bends, of which few divisions cut off much. (Nodes that make up for all of it stand
// off by 0.23 to 0.38 mean radii.)
TEST(SpaceMesh, OfASharpShapeHasNoSpikes) {
  const PolyhedronShape sharp{{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}, 0.05};
  const auto surface = star_surface(sharp);
  const double radius = std::cbrt(0.75 / std::numbers::pi * surface->volume());
  for (const int n : {4, 7}) {
    const Shape shape = shape_of(sharp, n, 1);
    for (int i = 0; i < shape.boundary_nodes; ++i) {
      const Vec3 at = node_of(shape, i);
      const Vec3 along = at.normalized();
      const double off = (at.norm() - surface->radius(along)) * along.dot(surface->normal(along));
      EXPECT_LT(off, 0.2 * radius) << n << " divisions, node " << i;
    }
  }
}

double seconds_to_make(const ParticleSpec& particle) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(space::make_shape(particle).elements(), 16 * 16 * 16 + 6 * 16 * 16 * 16);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// A scene asks for each of its shapes some ten times.
TEST(SpaceMesh, AFineMeshIsMadeOnce) {
  ParticleSpec particle;
  particle.shape = SphereShape{1};
  particle.hex_mesh.divisions = particle.hex_mesh.rings = 16;
  const double first = seconds_to_make(particle);
  EXPECT_LT(seconds_to_make(particle), first / 5);
}

}  // namespace
}  // namespace pulvis::space
