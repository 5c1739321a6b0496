#include "scenes/meshes/hexahedra/extruded_disc.hpp"

#include <cmath>
#include <numbers>

#include "scenes/meshes/mesh_outlines.hpp"

namespace pulvis::space {
namespace {

// Boundary nodes first, as many as the outermost ring has quads; quads of that ring first, each with its side on the
// boundary as its first.
pulvis::Shape disc_of(double diameter, const HexMeshSpec& mesh) {
  pulvis::Shape disc;
  disc.area = std::numbers::pi / 4 * diameter * diameter;
  DiscMesh of;
  of.boundary_edges = 4 * mesh.divisions;
  of.rings = mesh.rings;
  of.core = DiscMesh::Core::even;
  mesh_outline(DiscOutline{diameter}, of, 0, disc);
  return disc;
}

class Extrusion {
 public:
  Extrusion(const pulvis::Shape& disc, int layers)
      : disc_(disc), layers_(layers), numbers_(disc.nodes.size() * (layers + std::size_t{1})) {
    number(true);
    surface_nodes_ = static_cast<int>(places_.size());
    number(false);
  }

  int surface_nodes() const { return surface_nodes_; }

  std::vector<Vec3> nodes(const CylinderShape& cylinder, const StarSurface& surface) const {
    std::vector<Vec3> nodes;
    for (const Place& at : places_) {
      const auto& p = entry(disc_.nodes, at.node);
      Vec3 x(p[0], p[1], 0);
      // The boundary of a disc's mesh lies slightly outside the circle, so that the areas are equal.
      if (at.node < disc_.boundary_nodes) x *= cylinder.diameter / 2 / x.norm();
      x.z() = cylinder.height * (static_cast<double>(at.level) / layers_ - 0.5);
      nodes.push_back(on_surface(at) ? surface.point(x.normalized()) : x);
    }
    return nodes;
  }

  std::vector<std::array<int, 4>> quads() const {
    std::vector<std::array<int, 4>> quads;
    for (const auto& q : disc_.quads) {
      quads.push_back({node(q[3], 0), node(q[2], 0), node(q[1], 0), node(q[0], 0)});
      quads.push_back(
          {node(q[0], layers_), node(q[1], layers_), node(q[2], layers_), node(q[3], layers_)});
    }
    for (int level = 0; level < layers_; ++level)
      for (int i = 0; i < disc_.boundary_nodes; ++i) {
        const Row<Node> a(i), b((i + 1) % disc_.boundary_nodes);
        quads.push_back({node(a, level), node(b, level), node(b, level + 1), node(a, level + 1)});
      }
    return quads;
  }

  std::vector<Hexahedron> hexahedra() const {
    std::vector<Hexahedron> hexahedra;
    for (int level = 0; level < layers_; ++level)
      for (const auto& q : disc_.quads) {
        Hexahedron& h = hexahedra.emplace_back();
        for (std::size_t c = 0; c < 4; ++c) {
          h[c] = Row<Node>(node(q[c], level));
          h[c + 4] = Row<Node>(node(q[c], level + 1));
        }
      }
    return hexahedra;
  }

 private:
  struct Place {
    int node, level;
  };
  bool on_surface(const Place& at) const {
    return at.level == 0 || at.level == layers_ || at.node < disc_.boundary_nodes;
  }
  std::size_t place(int node, int level) const {
    return static_cast<std::size_t>(level) * disc_.nodes.size() + static_cast<std::size_t>(node);
  }
  int node(Row<Node> of_disc, int level) const { return numbers_[place(of_disc.value, level)]; }

  void number(bool of_surface) {
    for (int level = 0; level <= layers_; ++level)
      for (int i = 0; i < static_cast<int>(disc_.nodes.size()); ++i) {
        if (on_surface({i, level}) != of_surface) continue;
        numbers_[place(i, level)] = static_cast<int>(places_.size());
        places_.push_back({i, level});
      }
  }

  const pulvis::Shape& disc_;
  int layers_, surface_nodes_ = 0;
  std::vector<int> numbers_;   // [level][node of the disc]
  std::vector<Place> places_;  // [node]
};

}  // namespace

ExtrudedDisc extruded_disc(const CylinderShape& cylinder, const HexMeshSpec& mesh,
                           const StarSurface& surface) {
  const pulvis::Shape disc = disc_of(cylinder.diameter, mesh);
  const Extrusion extrusion(disc, mesh.axial());
  return {extrusion.nodes(cylinder, surface), extrusion.surface_nodes(), extrusion.quads(),
          extrusion.hexahedra()};
}

}  // namespace pulvis::space
