#include "cli/preview/space_setup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cli/preview/powder_setup.hpp"
#include "cli/preview/stage_setup.hpp"
#include "cli/preview/tool_setup.hpp"
#include "components/body.hpp"
#include "components/contact.hpp"
#include "components/space/bond.hpp"
#include "engine/access.hpp"
#include "scenes/results/parts/visit_particles.hpp"
#include "scenes/space/results/tool_sheets.hpp"
#include "scenes/space/tools/drives.hpp"
#include "scenes/tools/constraints.hpp"
#include "scenes/tools/contact_rules.hpp"

namespace pulvis {
namespace {

using nlohmann::json;

constexpr std::array<const char*, 6> shape_names{"sphere",   "ellipsoid",  "superquadric",
                                                 "cylinder", "polyhedron", "STL surface"};
static_assert(shape_names.size() == std::variant_size_v<ParticleShape>);

const ParticleSpec& class_of_body(const Scene& scene, const BodySpec& body) {
  const auto& spec = scene.particles[static_cast<std::size_t>(body.particle)];
  return spec.class_of < 0 ? spec : scene.particles[static_cast<std::size_t>(spec.class_of)];
}

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
    const ParticleSpec& spec = class_of_body(scene, body);
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

// Diameters are those of spheres of the same volume; cylinders have their own as width.
json classes_in_space(const Scene& scene, const std::vector<BodySpec>& bodies,
                      const json& particles) {
  json out = json::array();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const ParticleSpec& spec = class_of_body(scene, bodies[i]);
    const double diameter = std::cbrt(6 / std::numbers::pi * particles[i]["volume"].get<double>());
    auto one = std::ranges::find_if(out, [&](const json& c) { return c["name"] == spec.name; });
    if (one == out.end()) {
      out.push_back({{"name", spec.name},
                     {"material", particles[i]["material"]},
                     {"shape", shape_names[spec.shape.index()]},
                     {"count", 0}});
      one = out.end() - 1;
    }
    (*one)["count"] = (*one)["count"].get<int>() + 1;
    widen((*one)["diameter"], diameter);
    const auto& sized = scene.particles[static_cast<std::size_t>(bodies[i].particle)].shape;
    if (const auto* cylinder = std::get_if<CylinderShape>(&sized)) {
      widen((*one)["width"], cylinder->diameter);
      widen((*one)["height"], cylinder->height);
    }
  }
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

json bonds_in_space(const Scene& scene, const World& world) {
  return {{"laws", bond_laws(scene)},
          {"edges", json::array()},
          {"faces", bonded_faces<FaceContact>(world) + bonded_faces<FaceToolContact>(world)}};
}

}  // namespace

json space_setup(const Scene& scene, const std::vector<BodySpec>& bodies, const World& world) {
  json setup{{"family", "particles"},
             {"dimension", 3},
             {"friction", pairs_setup(scene)},
             {"materials", materials_setup(scene)},
             {"particles", particles_in_space(scene, bodies, world)},
             {"count", bodies.size()},
             {"stages", stage_setup(scene)},
             {"bonds", bonds_in_space(scene, world)}};
  setup["classes"] = classes_in_space(scene, bodies, setup["particles"]);
  setup["tools"] = tools_in_space(scene, setup["particles"], world);
  return setup;
}

}  // namespace pulvis
