#include "scenes/space/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "scenes/checks/process_checks.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/space/results/observe.hpp"
#include "scenes/space/shape_checks.hpp"
#include "scenes/space/stl_files.hpp"
#include "scenes/tools/tool_checks.hpp"

namespace pulvis::space {
namespace {

constexpr std::int64_t max_particles_in_space = 1'000'000;
constexpr std::int64_t max_hexahedra = 100'000'000;  // at 1.5 kB each: 150 GB
// Of a particle. Its nodes are smoothed all at once, in some ten seconds; the cache of shapes has room for two of them.
constexpr std::int64_t max_hexahedra_of_one = 100'000;

class SpaceChecks {
 public:
  SpaceChecks(Scene& scene, const schema::Origins& origins, Problems& problems)
      : scene_(scene), origins_(origins), problems_(problems) {}

  void run() {
    something_is_there();
    check_materials(scene_, refusal());
    read_stl_files(scene_, refusal());
    for (std::size_t i = 0; i < scene_.particles.size(); ++i) particle(i);
    counts();
    packings();
    check_stages(scene_, refusal());
    check_frictions(scene_, names_of_tools(), refusal());
    check_bonds(scene_, names_of_tools(), refusal());
    check_tools(scene_, origins_, problems_);
    output();
    everything_is_used();
  }

 private:
  // A default has no source location: report that of its table, or of the table above.
  document::Origin nearest_origin(std::string path) const {
    while (origins_.count(path) == 0 && path.find('.') != std::string::npos)
      path.erase(path.rfind('.'));
    const auto found = origins_.find(path);
    return found == origins_.end() ? document::Origin{{1, 1}, -1} : found->second;
  }
  Refuse refusal() {
    return [this](const std::string& path, const std::string& message) {
      problems_.add(nearest_origin(path), path, message);
    };
  }
  void refuse(const std::string& path, const std::string& message) { refusal()(path, message); }
  bool given(const std::string& path) const { return origins_.contains(path); }

  void refuse_missing(const std::string& key, const std::string& what) {
    problems_.add({{1, 1}, -1}, key, fmt::format("none is declared, allowed: {}", what));
  }

  void something_is_there() {
    if (scene_.materials.empty()) refuse_missing("material", "at least one [[material]]");
    if (scene_.particles.empty()) refuse_missing("particle", "at least one [[particle]]");
    if (scene_.bodies.empty() && scene_.packings.empty())
      refuse_missing("body", "at least one [[body]] or [[packing]]");
    if (scene_.stages.empty()) refuse_missing("stage", "at least one [[stage]]");
  }

  void particle(std::size_t i) {
    const ParticleSpec& of = scene_.particles[i];
    const std::string path = fmt::format("particle[{}]", i);
    check_shape(of.shape, path, refusal());
    // Either there is a four-face node between two corners of the cube, or on none of its edges.
    if (of.hex_mesh.axial_divisions && of.hex_mesh.divisions < 2)
      refuse(path + ".mesh.axial_divisions", "needs divisions of at least 2");
    if (of.hex_mesh.hexahedra() > max_hexahedra_of_one)
      refuse(path + ".mesh.divisions",
             fmt::format("the mesh has {} elements with rings = {}, and takes too long to make, "
                         "allowed: at most {}, as with divisions = 24 and rings = 24",
                         of.hex_mesh.hexahedra(), of.hex_mesh.rings, max_hexahedra_of_one));
    const auto* cylinder = std::get_if<CylinderShape>(&of.shape);
    if (cylinder != nullptr && of.hex_mesh.grid == HexMeshSpec::Grid::extruded)
      check_extruded(*cylinder, of.hex_mesh, path, refusal());
  }

  std::vector<std::string> names_of_tools() const {
    std::vector<std::string> names;
    for (const ToolSpec& tool : scene_.tools) names.push_back(tool.name);
    return names;
  }

  std::int64_t hexahedra_of(int particle) const {
    return scene_.particles[static_cast<std::size_t>(particle)].hex_mesh.hexahedra();
  }

  void counts() {
    std::int64_t particles = static_cast<std::int64_t>(scene_.bodies.size()), total = 0;
    for (const BodySpec& body : scene_.bodies) total += hexahedra_of(body.particle);
    for (std::size_t i = 0; i < scene_.packings.size(); ++i) {
      const PackingSpec& packing = scene_.packings[i];
      if (!is_lattice(packing)) continue;
      particles += particle_count(packing);
      if (particles > max_particles_in_space)
        return refuse(fmt::format("packing[{}]", i),
                      fmt::format("the scene has {} particles up to here, allowed: at most {}",
                                  particles, max_particles_in_space));
      total += particle_count(packing) * hexahedra_of(packing.particle);
    }
    if (total > max_hexahedra)
      problems_.add({{1, 1}, -1}, "particle",
                    fmt::format("all meshes together have {} hexahedra, allowed: at most {}", total,
                                max_hexahedra));
  }

  void packings() {
    for (std::size_t i = 0; i < scene_.packings.size(); ++i) {
      PackingSpec& packing = scene_.packings[i];
      const std::string path = fmt::format("packing[{}]", i);
      if (packing.kind != PackingSpec::Kind::random && !packing.classes.empty())
        refuse(path + ".class[0]",
               "has no effect with this kind, allowed: classes of kind = \"random\"");
      if (packing.kind == PackingSpec::Kind::random) container(packing, path);
      if (is_lattice(packing) && !given(path + ".spacing")) spacing(packing, path);
    }
  }

  void container(const PackingSpec& packing, const std::string& path) {
    const bool round = packing.container.kind == ContainerSpec::Kind::cylinder;
    const bool box = given(path + ".width");
    if (round && box)
      refuse(path + ".diameter",
             "has no effect together with width, allowed: diameter, or width and depth");
    if (!round && !box)
      refuse(path + ".width",
             "required key is missing, allowed: width and depth of a box, or the diameter of a "
             "cylinder");
  }

  void spacing(PackingSpec& packing, const std::string& path) {
    const ParticleShape& shape = scene_.particles[static_cast<std::size_t>(packing.particle)].shape;
    if (const auto* sphere = std::get_if<SphereShape>(&shape))
      packing.spacing = touching_spacing(packing.kind) * sphere->diameter;
    else
      refuse(
          path + ".spacing",
          "required key is missing: only spheres have a default spacing, allowed: a quantity in m");
  }

  void output() {
    if (scene_.output.contacts && scene_.tools.empty() && scene_.packings.empty() &&
        scene_.bodies.size() < 2)
      refuse("output.contacts",
             "has no effect: nothing can touch the only particle, allowed: with two particles, or "
             "with a tool");
    if (scene_.output.density() && !has_grid_room(scene_))
      refuse(
          "output.density_cells",
          "the tools do not enclose a space for the grid, allowed: with six planes whose normals "
          "are along the axes, or a round die along one axis between two planes or punches");
  }

  void everything_is_used() {
    std::set<int> particles, materials;
    for (const BodySpec& body : scene_.bodies) particles.insert(body.particle);
    for (const PackingSpec& packing : scene_.packings) {
      if (is_lattice(packing)) particles.insert(packing.particle);
      for (const MixtureClass& mixed : packing.classes) particles.insert(mixed.particle);
      if (packing.kind != PackingSpec::Kind::csv) continue;
      for (int p = 0; p < static_cast<int>(scene_.particles.size()); ++p) particles.insert(p);
    }
    for (const ParticleSpec& particle : scene_.particles) materials.insert(particle.material);
    for (std::size_t i = 0; i < scene_.materials.size(); ++i)
      if (!materials.contains(static_cast<int>(i)))
        refuse_unused(fmt::format("material[{}]", i), scene_.materials[i].name, "[[particle]]",
                      refusal());
    for (std::size_t i = 0; i < scene_.particles.size(); ++i)
      if (!particles.contains(static_cast<int>(i)))
        refuse_unused(fmt::format("particle[{}]", i), scene_.particles[i].name,
                      "[[body]] or [[packing]]", refusal());
  }

  Scene& scene_;
  const schema::Origins& origins_;
  Problems& problems_;
};

}  // namespace

void complete_and_check(Scene& scene, const schema::Origins& origins, Problems& problems) {
  SpaceChecks(scene, origins, problems).run();
}

}  // namespace pulvis::space
