#include "scenes/results/plane_parts.hpp"

#include "components/body.hpp"
#include "scenes/results/parts/visit_particles.hpp"

namespace pulvis {

PlaneParts::PlaneParts(const Scene& scene, const World& world, std::vector<ParticleTag> tags)
    : world_(world),
      tags_(std::move(tags)),
      outlines_(scene, world, node_values<TwoD, Position<TwoD>>(world)) {
  visit_particles<TwoD>(world, [&](std::size_t, int, const Shape& shape) {
    particle_area_ += shape.area;
    elements_ += shape.elements();
  });
}

std::optional<FieldInfo> PlaneParts::tool_field() const {
  if (outlines_.empty()) return std::nullopt;
  return ToolOutlines::field();
}

RunMesh PlaneParts::mesh() const {
  RunMesh mesh;
  std::size_t nodes = 0;
  visit_particles<TwoD>(world_,
                        [&](std::size_t, int, const Shape& shape) { nodes += shape.nodes.size(); });
  const auto cells = static_cast<std::size_t>(elements_);
  mesh.quads.reserve(4 * cells);
  mesh.cell_particle.reserve(cells);
  mesh.node_particle.reserve(nodes);
  std::int32_t particle = 0, first_node = 0;
  visit_particles<TwoD>(world_, [&](std::size_t, int, const Shape& shape) {
    for (const auto& quad : shape.quads) {
      for (const Row<Node> n : quad) mesh.quads.push_back(first_node + n.value);
      mesh.cell_particle.push_back(particle);
    }
    mesh.node_particle.insert(mesh.node_particle.end(), shape.nodes.size(), particle);
    first_node += static_cast<std::int32_t>(shape.nodes.size());
    particle += 1;
  });
  mesh.reference = node_values<TwoD, Position<TwoD>>(world_);
  mesh.tags = tags_;
  mesh.tools = outlines_.lines();
  return mesh;
}

double PlaneParts::volume() const { return particle_area_ * world_.resource<Bodies>().thickness; }

}  // namespace pulvis
