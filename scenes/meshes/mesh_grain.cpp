// The mesh of a grain: equally spaced nodes on every face, so that the grains on both sides have the same.
#include <cmath>

#include "scenes/meshes/contact_curve.hpp"
#include "scenes/meshes/mesh_outlines.hpp"
#include "scenes/meshes/star_grid.hpp"
#include "scenes/outlines/star.hpp"

namespace pulvis {
namespace {

// Where the contact curve should follow the particle's outline, nodes lie two thirds of an edge's sagitta outside,
// as on every smooth outline.
Vec2 node_on_outline(const OutlineCurve& particle, double s, double edge) {
  const double round = particle.length();
  const auto at = [&](double place) { return particle.at(std::fmod(place + round, round)); };
  const auto here = at(s);
  if (particle.sharp()) return here.at;
  const Vec2 chord = (at(s - edge / 2).at + at(s + edge / 2).at) / 2;
  return here.at + 2.0 / 3 * (here.at - chord).dot(here.normal) * here.normal;
}

// In the particle's frame, with the indices of the nodes where faces begin.
struct Outside {
  std::vector<Vec2> nodes;
  std::vector<int> corners;
};

// Corners lie where the faces meet: the contact curve ends in them.
Outside nodes_of_faces(const GrainOutline& grain) {
  Outside outside;
  for (std::size_t f = 0; f < grain.faces.size(); ++f) {
    const auto &face = grain.faces[f], &next = grain.faces[(f + 1) % grain.faces.size()];
    outside.corners.push_back(static_cast<int>(outside.nodes.size()));
    outside.nodes.push_back(face.from);
    const double length = face.end - face.begin;
    for (int i = 1; i < face.edges; ++i) {
      const double share = static_cast<double>(i) / face.edges;
      outside.nodes.push_back(
          face.on_outline()
              ? node_on_outline(*grain.particle, face.begin + share * length, length / face.edges)
              : Vec2(face.from + share * (next.from - face.from)));
    }
  }
  return outside;
}

}  // namespace

void mesh_outline(const GrainOutline& grain, const OutlineCurve& curve, const StarMesh& mesh,
                  Shape& shape) {
  const Outside outside = nodes_of_faces(grain);
  const Vec2 origin = grain.faces[0].from - curve.at(0).at;
  std::vector<Point> nodes;
  std::vector<Vec2> polygon;
  for (const Vec2& p : outside.nodes) {
    polygon.emplace_back(p - origin);
    nodes.push_back({polygon.back().x(), polygon.back().y()});
  }
  const Vec2 centre = star_centre(polygon).value_or(Vec2::Zero());
  StarGrid grid = star_grid(nodes, {centre.x(), centre.y()}, mesh.rings);
  shape.nodes = std::move(grid.nodes);
  shape.quads = std::move(grid.quads);
  shape.boundary_nodes = static_cast<int>(nodes.size());
  cornered_curve(shape, outside.corners);
}

}  // namespace pulvis
