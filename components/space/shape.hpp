// Shapes of particles in three dimensions: what all particles of a class share. The chunk and lane of each particle are in
// Bodies (components/shape.hpp), as in two dimensions.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "components/entities.hpp"
#include "components/inerter_chains.hpp"
#include "engine/chunk_lane.hpp"
#include "engine/entry.hpp"

namespace pulvis::space {

using Point = std::array<double, 3>;
using Tensor = std::array<double, 9>;  // row-major

// The undeformed mesh of one particle class and its smooth surface, in the particle's local frame (centroid at the
// origin).
//
// Hexahedra: node order of VTK and Abaqus C3D8: (-,-,-) (+,-,-) (+,+,-) (-,+,-) in (xi, eta, zeta), then the
// same at zeta = +.
//
// The surface consists of faces: four-sided bicubic Bezier patches x(u, v) = sum_ij B_i(u) B_j(v) p_(4 j + i),
// 0 <= u, v <= 1, whose points are linear in the surface nodes (points = terms * net, net = its terms * nodes; a point of
// the net for each node). Outward normal: x_u cross x_v.
struct Shape {
  static constexpr int gauss_points = 16;  // per face: 4 x 4, u first

  // The modes of a hexahedron: x_I = 1/8 (sum of all + sum_m mode_sign(m, I) X_m) with X_m = sum_I mode_sign(m, I) x_I,
  // m: xi, eta, zeta, eta zeta, zeta xi, xi eta, xi eta zeta.
  static constexpr int modes = 7, stretches = 3, hourglasses = 4;

  // Constants of an element's kinematics (scenes/meshes/hexahedra/element_constants.cpp). a_1, a_2, a_3 are the columns of
  // dX/d(xi, eta, zeta) at the centre: half its edges.
  struct Element {
    // 1/m: the mean of dN_I/dX over the undeformed element is sum_m mode_sign(m, I) gradient[m]; F = sum_m X_m gradient[m].
    std::array<Point, modes> gradient{};
    double volume = 0;  // m^3
    // 1/m: rows a_i / (8 |a_i|^2). Times an hourglass mode X: its components along the edges, relative to half an edge.
    Tensor fibre{};
    std::array<Point, hourglasses> natural{};  // fibre * X of the undeformed element
    // Upper bound on the change of the gradient at a Gauss point, squared, by hourglass modes of unit norm (components
    // along the edges; systems/space/body/inversion_barrier_kernel.hpp).
    double hourglass_reach2 = 0;
    // For the planes 23, 31, 12: |a_j|/|a_k| and its inverse, the cosine c of the angle between both, 1/(1 - c^2) and its
    // square root.
    struct Plane {
      double ratio = 1, inv_ratio = 1, cosine = 0, inv_sine2 = 1, inv_sine = 1;
    };
    std::array<Plane, 3> plane{};
    // 1/m^2, xx yy zz xy yz zx: volume * sum_I b_I b_I^T / V_I with b_I the mean gradient and V_I the part of the nodal
    // volume that belongs to this element: bounds its frequencies (systems/space/body/time_step_kernel.hpp).
    std::array<double, 6> spread{};
    double hourglass_spread = 0;  // 1/m^2: the same for the hourglass modes
    double overlap = 0;  // -, squared cosine of the smallest angle between the two kinds of modes
    // For the springs and dashpots on its faces, with the undeformed face area: 1/m^2 times k K and 1/m times
    // sqrt(k K rho) are rho omega^2 and rho gamma.
    double contact_frequency = 0, contact_drag = 0;
  };
  // At the 2 x 2 x 2 Gauss points (+-1/sqrt 3), xi first: for fully integrated elements.
  struct GaussPoint {
    Tensor inverse_jacobian;  // 1/m
    double volume;            // m^3, of the integration point
  };
  struct Term {  // weight of a surface node in a net point, or of a net point in a Bezier point
    Row<BoundaryNode> row;
    double weight;
  };
  struct Terms {
    std::vector<std::int32_t> begin{0};  // [points + 1] into all
    std::vector<Term> all;

    int points() const { return static_cast<int>(begin.size()) - 1; }
    std::span<const Term> of(int point) const {
      return {&all[0] + entry(begin, point), &all[0] + entry(begin, point + 1)};
    }
    void close() { begin.push_back(static_cast<std::int32_t>(all.size())); }
  };
  // A side of a face: 0: v = 0, 1: u = 1, 2: v = 1, 3: u = 0, each traversed counter-clockwise (seen from outside).
  struct Neighbour {
    int face = 0;  // adjacent face across that side
    int side = 0;  // side of that face where it is entered
  };
  struct Face {
    std::array<std::int32_t, 16> point{};       // Bezier points, numbered within the particle
    std::array<std::int32_t, 16> number{};      // 3 * point, set by complete_points()
    std::array<Row<BoundaryNode>, 4> corner{};  // nodes at (u, v) = (0,0) (1,0) (1,1) (0,1)
    std::array<Neighbour, 4> neighbour{};
    int element = 0;       // the element behind it
    double size = 0;       // m: square root of its undeformed area
    double stiffness = 0;  // 1/m: of its contact springs, k K times this per area
    double thickness = 0;  // m: volume of the element behind it over the undeformed area
    std::array<double, gauss_points> weight{};  // m^2: undeformed area of each Gauss point
  };

  // A surface node and the point of the smooth surface that belongs to it (systems/space/contact/node_springs.hpp).
  struct SurfaceNode {
    std::int32_t point = 0;  // Bezier point
    double size = 0;         // m: of the largest face at the node
    double slack = 0;        // m: how far apart they may be
    double stiffness = 0;    // m: area of the node over the thickness of its faces
  };

  std::string name;
  std::vector<Point> nodes;  // m; surface nodes first
  int boundary_nodes = 0;    // on the surface
  InerterChains chains;
  std::vector<std::array<Row<Node>, 8>> hexahedra;
  std::vector<Element> element;                  // [elements]
  std::vector<std::array<GaussPoint, 8>> gauss;  // [elements]
  std::vector<double> nodal_volume;              // m^3, lumped: times density gives the nodal mass
  std::vector<Face> faces;
  std::vector<SurfaceNode> surface_node;  // [surface nodes]
  std::vector<std::int32_t> node_at;      // [Bezier points]: the surface node of this point, or -1
  Terms net;                              // [surface nodes], in terms of surface nodes
  // [Bezier points], in terms of the net; in face order, padded to a multiple of eight by complete_points().
  Terms points;
  double mean_face_stiffness = 0;  // 1/m: of its faces, weighted by area
  double volume = 0;               // m^3, of the mesh
  double true_volume = 0;          // m^3, of the exact shape that it approximates
  double surface_error = 0;        // m, largest distance of the smooth surface from the exact one
  double surface_bulge = 0;        // m, largest outward deviation
  double area = 0;                 // m^2, of the surface
  double radius = 0;               // m, of the bounding sphere about the origin

  static constexpr double mode_sign(int mode, int corner) {
    const bool plus[3] = {corner % 4 == 1 || corner % 4 == 2, corner % 4 >= 2, corner >= 4};
    constexpr int factors[modes] = {1, 2, 4, 6, 5, 3, 7};  // bits: xi, eta, zeta
    double sign = 1;
    for (int k = 0; k < 3; ++k)
      if (factors[mode] >> k & 1) sign *= plus[k] ? 1 : -1;
    return sign;
  }
  // Volume of a node, and of an integration point. (In two dimensions: area)
  double size_of_node(int node) const { return entry(nodal_volume, node); }
  template <int Points>
  double size_of_point(int of_element, int point) const {
    if constexpr (Points == 1)
      return entry(element, of_element).volume;
    else
      return entry(entry(gauss, of_element), point).volume;
  }
  int elements() const { return static_cast<int>(hexahedra.size()); }
  int surface_points() const { return points.points(); }
  // Call when all faces and points are known. Pads the points to a multiple of eight with copies of the last one: kernels
  // process eight at a time, and may read one number beyond.
  void complete_points() {
    for (Face& face : faces)
      for (std::size_t p = 0; p < face.point.size(); ++p) face.number[p] = 3 * face.point[p];
    const std::vector<Term> last(points.of(surface_points() - 1).begin(),
                                 points.of(surface_points() - 1).end());
    do {
      points.all.insert(points.all.end(), last.begin(), last.end());
      points.close();
    } while (surface_points() % lane_count != 0);
    node_at.assign(static_cast<std::size_t>(surface_points()), -1);
  }
};

// Shapes by number Bodies::Slot::shape. Bodies::shapes, the two-dimensional shapes, is then empty.
struct Shapes {
  static constexpr const char* resource_name = "shapes";
  static constexpr bool fixed = true;
  std::vector<Shape> list;
};

}  // namespace pulvis::space
