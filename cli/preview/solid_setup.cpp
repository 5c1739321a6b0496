#include "cli/preview/solid_setup.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "cli/preview/powder_setup.hpp"
#include "cli/preview/tool_setup.hpp"
#include "components/body.hpp"
#include "components/contact.hpp"
#include "components/space/bond.hpp"
#include "engine/access.hpp"
#include "scenes/packing/solids/rigid_shape.hpp"
#include "scenes/results/parts/visit_particles.hpp"
#include "scenes/results/solids/tool_sheets.hpp"
#include "scenes/tools/constraints.hpp"
#include "scenes/tools/contact_rules.hpp"

namespace pulvis {
namespace {

using nlohmann::json;

constexpr std::array<const char*, 6> shape_names{"sphere",   "ellipsoid",  "superquadric",
                                                 "cylinder", "polyhedron", "STL surface"};
static_assert(shape_names.size() == std::variant_size_v<ParticleShape>);

json triple(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

// x, y, z, x, ... of the surface nodes; four per face, counter-clockwise from outside.
json particle_surface(const World& world, std::size_t first, int lane, const space::Shape& shape) {
  json nodes = json::array(), faces = json::array();
  const Lane* x = world.column<Position<ThreeD>>().lanes() + 3 * first;
  for (int n = 0; n < shape.boundary_nodes; ++n)
    for (int k = 0; k < 3; ++k) nodes.push_back(x[3 * n + k][lane]);
  for (const auto& face : shape.faces) {
    json corners = json::array();
    for (const auto& corner : face.corner) corners.push_back(corner.value);
    faces.push_back(std::move(corners));
  }
  return {{"nodes", nodes}, {"faces", faces}};
}

json particles_in_space(const Scene& scene, const std::vector<BodySpec>& bodies,
                        const World& world) {
  json out = json::array();
  visit_particles<ThreeD>(world, [&](std::size_t first, int lane, const space::Shape& shape) {
    const BodySpec& body = bodies.at(out.size());
    const ParticleSpec& spec = base_of(scene, body);
    json one = particle_surface(world, first, lane, shape);
    one["class"] = spec.name;
    one["material"] = scene.materials[static_cast<std::size_t>(spec.material)].name;
    one["elements"] = shape.elements();
    one["volume"] = shape.true_volume;
    if (body.velocity.norm() > 0) one["velocity"] = triple(body.velocity);
    if (body.angular_velocity.norm() > 0) one["angular_velocity"] = triple(body.angular_velocity);
    out.push_back(std::move(one));
  });
  return out;
}

Eigen::AlignedBox3d box_of(const json& particles) {
  Eigen::AlignedBox3d box;
  for (const json& one : particles) {
    const auto nodes = one["nodes"].get<std::vector<double>>();
    for (std::size_t i = 0; i < nodes.size(); i += 3) box.extend(Vec3(Vec3::Map(&nodes[i])));
  }
  return box;
}

json touching_tool(const Scene& scene, const ToolSpec& tool) {
  json friction = json::object();
  for (const MaterialSpec& m : scene.materials)
    friction[m.name] = friction_of(scene, m.name, tool.name).coefficient;
  return {{"shape", tool_shape_names[tool.shape]},
          {"normal", triple(tool.normal)},
          {"friction", friction}};
}

json tools_in_space(const Scene& scene, const json& particles, const World& world) {
  if (scene.tools.empty()) return json::array();
  const space::ToolSheets sheets(scene, box_of(particles));
  const ToolFaces& faces = sheets.faces();
  const std::vector<double> xyz =
      sheets.points({world.column<ToolPosition>().values(), tool_axes * scene.tools.size()});
  json out = json::array();
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    const ToolSpec& tool = scene.tools[t];
    json one = is_constraint(tool) ? constraint_setup(scene, world, static_cast<int>(t))
                                   : touching_tool(scene, tool);
    one["name"] = tool.name;
    one["pieces"] = json::array();
    out.push_back(std::move(one));
  }
  for (std::size_t i = 0; i < faces.corners.size(); i += 4) {
    json piece = json::array();
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        piece.push_back(xyz[3 * static_cast<std::size_t>(faces.corners[i + k]) + axis]);
    out[sheets.number_of(faces.tool[i / 4])]["pieces"].push_back(std::move(piece));
  }
  return out;
}

// How many faces are bonded at the start; both sides of a pair count.
template <class At>
std::ptrdiff_t bonded_faces(const World& world) {
  if (!world.has<space::BondedPoints<At>>()) return 0;
  const auto& points = world.column<space::BondedPoints<At>>();
  std::ptrdiff_t faces = 0;
  for (std::size_t r = 0; r < points.table.rows; ++r) faces += points.values()[2 * r] != 0;
  return faces;
}

}  // namespace

json solid_class(const ParticleSpec& particle) {
  return {{"shape", shape_names[particle.shape.index()]}};
}

ClassSize solid_size(const ParticleSpec& particle) {
  ClassSize size{space::diameter_of(particle.shape), {}, {}};
  if (const auto* cylinder = std::get_if<CylinderShape>(&particle.shape)) {
    size.width = cylinder->diameter;
    size.height = cylinder->height;
  }
  return size;
}

json solid_setup(const Scene& scene, const std::vector<BodySpec>& particles, const World& world) {
  const std::ptrdiff_t faces =
      bonded_faces<FaceContact>(world) + bonded_faces<FaceToolContact>(world);
  json setup{{"dimension", 3},
             {"particles", particles_in_space(scene, particles, world)},
             {"bonds", {{"edges", json::array()}, {"faces", faces}}}};
  setup["tools"] = tools_in_space(scene, setup["particles"], world);
  setup["cell"] = cell_setup(world);
  return setup;
}

}  // namespace pulvis
