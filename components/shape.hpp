// Shapes and bodies: what all particles of a class share (mesh, contact curve), and the chunk and lane of
// each particle. Resources: fixed once the scene is built.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "components/body.hpp"
#include "components/inerter_chains.hpp"
#include "engine/chunk_lane.hpp"
#include "engine/entry.hpp"

namespace pulvis {

using Point = std::array<double, 2>;
using Point3 = std::array<double, 3>;  // of tools; z = 0 in two dimensions

// The undeformed mesh of one particle class, in its local frame (centre of the outline at the origin).
struct Shape {
  static constexpr int no_edge = -1;

  struct GaussPoint {
    std::array<double, 4> inverse_jacobian;  // d(xi,eta)/d(X,Y): xi_X xi_Y eta_X eta_Y, 1/m
    double determinant;                      // of dX/dxi, m^2: area of the integration point
  };
  // For one-point elements: natural components of h in x = centre + a xi + b eta + h xi eta, the
  // skewness a.b / a.a, a.b / b.b, and the ratio of det dX/d(xi,eta) at the centre to that at each of the
  // four Gauss points.
  struct Hourglass {
    std::array<double, 2> natural;
    std::array<double, 2> skew;
    std::array<double, 4> inv_determinant;
  };
  struct CurveTerm {  // weight of a boundary node in a control point
    Row<BoundaryNode> node;
    double weight;
  };
  struct Edge {  // of the contact curve, from one boundary node to the next, counter-clockwise
    int first_control = 0;   // its four control points are first_control .. +3
    int previous = no_edge;  // no_edge if the outline has a corner there
    int next = no_edge;
    double length = 0;               // m, undeformed
    double stiffness = 0;            // 1/m: edge length / area of the element behind it
    int element = 0;                 // the element behind it
    std::array<Row<Node>, 2> ends;   // nodes, counter-clockwise
    std::array<double, 4> weight{};  // m: length of each of its Gauss points
  };

  // D = V sum_I dN_I/dxi dN_I/dxi^T / a_I at the centre of an element of area V, a_I the part of node I's
  // area that belongs to the element: bounds its frequencies (systems/body/time_step_kernel).
  struct CornerMoment {
    double xixi, xieta, etaeta;
  };

  std::string name;
  std::vector<Point> nodes;                      // m; outline nodes first
  std::vector<std::array<Row<Node>, 4>> quads;   // counter-clockwise
  std::vector<std::array<GaussPoint, 4>> gauss;  // [elements]
  // [elements]: one point for the whole element; its inverse_jacobian refers to the fourfold map
  // (kernels::FourfoldMap) used by one-point elements.
  std::vector<std::array<GaussPoint, 1>> centre;
  std::vector<Hourglass> hourglass;  // [elements]
  std::vector<double> nodal_area;    // m^2: a quarter of every adjacent element
  int boundary_nodes = 0;
  InerterChains chains;
  std::vector<std::int32_t> curve_begin;  // [control points + 1] into curve_terms
  std::vector<CurveTerm> curve_terms;
  std::vector<Edge> edges;
  std::vector<std::int32_t>
      edge_from;  // [control points]: the edge that starts with it
  std::vector<CornerMoment> corner_moment;  // [elements]
  std::vector<double>
      contact_frequency;           // 1/m^2, [elements]: rho omega^2 / (k K) of its edge springs
  double mean_edge_stiffness = 0;  // 1/m: of its edges, weighted by length
  double area = 0;                 // m^2, of the exact outline

  // Area of a node, and of an integration point. (In three dimensions: volume)
  double size_of_node(int node) const { return entry(nodal_area, node); }
  template <int Points>
  double size_of_point(int element, int point) const {
    if constexpr (Points == 1)
      return entry(centre, element)[0].determinant;
    else
      return entry(entry(gauss, element), point).determinant;
  }
  int control_points() const { return static_cast<int>(curve_begin.size()) - 1; }
  int elements() const { return static_cast<int>(quads.size()); }
  // The terms of control point c.
  std::span<const CurveTerm> terms_of(int c) const {
    return {&curve_terms[0] + entry(curve_begin, c), &curve_terms[0] + entry(curve_begin, c + 1)};
  }
};

// Particles by slot (engine/chunk_lane.hpp). An empty slot has number -1; it is computed like
// the others (at rest, undeformed) but ignored by contact, energies and results.
//
// A single process holds all particles. One of several ranks (components/ranks.hpp) holds the chunks that it owns, and
// the outlines of nearby particles of other ranks: its border. Slots and rows are numbered alike on all ranks; those
// a rank does not hold are never accessed, and take no memory.
struct Bodies {
  static constexpr const char* resource_name = "bodies";
  static constexpr int empty_slot = -1;
  enum class Held : std::uint8_t { absent, border, own };

  struct Slot {
    int number = empty_slot;  // particle number in the scene, from 0
    int shape = 0;            // position in `shapes`
    int material = 0;         // material number in the scene
    int first_control = 0;    // row of its first control point
    int parent = empty_slot;  // position of its particle in the order of placement
  };

  double thickness = 0;  // m
  Formulation formulation = Formulation::one_point;
  std::vector<Shape> shapes;
  std::vector<Slot> slots;          // [lane_count * chunks]
  std::vector<int> slot_of_number;  // [particles]
  std::vector<Held> held;           // [slots]; absent if there is no particle
  std::vector<int> own_chunks;      // ascending
  std::vector<int> own_slots;       // slots of its own particles, ordered by particle number
  std::vector<int> present_slots;   // own and border, ascending

  // Hold the chunks where `owns_chunk` is true, and no border.
  void hold(const std::vector<bool>& owns_chunk) {
    held.assign(slots.size(), Held::absent);
    own_chunks.clear();
    own_slots.clear();
    for (int c = 0; c < chunks(); ++c)
      if (owns_chunk[static_cast<std::size_t>(c)]) own_chunks.push_back(c);
    for (const int slot : slot_of_number) {
      if (!owns_chunk[static_cast<std::size_t>(slot / lane_count)]) continue;
      own_slots.push_back(slot);
      entry(held, slot) = Held::own;
    }
    list_present();
  }
  void hold_all() { hold(std::vector<bool>(static_cast<std::size_t>(chunks()), true)); }
  // Replaces the current border; only slots that it does not own.
  void set_border(const std::vector<int>& border) {
    for (const int slot : present_slots)
      if (!owns(slot)) entry(held, slot) = Held::absent;
    for (const int slot : border) entry(held, slot) = Held::border;
    list_present();
  }
  // All lanes of its chunks, including empty ones.
  template <class Visit>
  void for_own_lanes(const Visit& visit) const {
    for (const int chunk : own_chunks)
      for (int lane = 0; lane < lane_count; ++lane) visit(chunk * lane_count + lane);
  }
  bool owns(int slot) const { return entry(held, slot) == Held::own; }
  bool is_present(int slot) const { return entry(held, slot) != Held::absent; }
  bool is_whole() const { return own_slots.size() == slot_of_number.size(); }

  template <class Bytes>
  void state(Bytes&) {}  // a checkpoint covers all ranks

  const Shape& shape_of_chunk(Chunk c) const { return shape_of_slot(ChunkLane(c, 0).slot()); }
  const Shape& shape_of_slot(int slot) const { return entry(shapes, entry(slots, slot).shape); }
  int chunks() const { return static_cast<int>(slots.size()) / lane_count; }
  int particles() const { return static_cast<int>(slot_of_number.size()); }

 private:
  void list_present() {
    present_slots.clear();
    for (int slot = 0; slot < static_cast<int>(slots.size()); ++slot)
      if (is_present(slot)) present_slots.push_back(slot);
  }
};

}  // namespace pulvis
