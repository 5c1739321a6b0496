#include "scenes/results/solids/space_parts.hpp"

#include "components/body.hpp"
#include "components/contact.hpp"
#include "scenes/results/parts/visit_particles.hpp"
#include "scenes/results/solids/tool_sheets.hpp"
#include "scenes/spec/scene.hpp"
#include "scenes/tools/powder.hpp"

namespace pulvis::space {
namespace {

Eigen::AlignedBox3d box_of_nodes(const World& world) {
  Eigen::AlignedBox3d box;
  const std::vector<double> nodes = node_values<ThreeD, Position<ThreeD>>(world);
  for (std::size_t i = 0; i < nodes.size(); i += 3) box.extend(Vec3(Vec3::Map(&nodes[i])));
  return box;
}

class SpaceParts : public ResultParts {
 public:
  SpaceParts(const Scene& scene, const World& world, std::vector<ParticleTag> tags)
      : world_(world),
        volume_(volume_of_particles(world)),
        tags_(std::move(tags)),
        sheets_(scene, box_of_nodes(world)) {
    visit_particles<ThreeD>(
        world, [&](std::size_t, int, const Shape& shape) { elements_ += shape.elements(); });
  }

  RunMesh mesh() const override {
    RunMesh mesh;
    std::int32_t particle = 0, first_node = 0;
    visit_particles<ThreeD>(world_, [&](std::size_t, int, const Shape& shape) {
      for (const auto& hexahedron : shape.hexahedra) {
        for (const Row<Node> n : hexahedron) mesh.hexahedra.push_back(first_node + n.value);
        mesh.cell_particle.push_back(particle);
      }
      mesh.node_particle.insert(mesh.node_particle.end(), shape.nodes.size(), particle);
      first_node += static_cast<std::int32_t>(shape.nodes.size());
      particle += 1;
    });
    mesh.reference = node_values<ThreeD, Position<ThreeD>>(world_);
    mesh.tags = tags_;
    mesh.tool_faces = sheets_.faces();
    return mesh;
  }

  std::optional<FieldInfo> tool_field() const override {
    if (sheets_.faces().names.empty()) return std::nullopt;
    return ToolSheets::field();
  }
  std::vector<double> tool_points() const override {
    const auto& places = world_.column<ToolPosition>();
    return sheets_.points({places.values(), tool_axes * places.table.rows});
  }

  double powder() const override { return volume_; }
  double volume() const override { return volume_; }
  std::int64_t elements() const override { return elements_; }

 private:
  const World& world_;
  double volume_ = 0;
  std::int64_t elements_ = 0;
  std::vector<ParticleTag> tags_;
  ToolSheets sheets_;
};

}  // namespace

std::unique_ptr<ResultParts> result_parts(const Scene& scene, const World& world,
                                          std::vector<ParticleTag> tags) {
  return std::make_unique<SpaceParts>(scene, world, std::move(tags));
}

}  // namespace pulvis::space
