#include "scenes/checks/checks.hpp"
#include "scenes/checks/cell_checks.hpp"
#include "scenes/checks/process_checks.hpp"
#include "scenes/outlines/points_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <type_traits>

#include "scenes/meshes/mesh.hpp"
#include "scenes/meshes/mesh_rounded_rectangle.hpp"
#include "scenes/meshes/mesh_size.hpp"
#include "scenes/outlines/outline.hpp"
#include "scenes/outlines/outline_checks.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/results/observe.hpp"
#include "scenes/spec/material_checks.hpp"
#include "scenes/tools/drawn_face.hpp"
#include "scenes/tools/tool_checks.hpp"

namespace pulvis {
namespace {

constexpr std::int64_t max_particles = 1'000'000;
constexpr std::int64_t max_quads_a_particle = 1'000'000;
constexpr int max_edges_without_rings = 20;
constexpr int min_edges_of_a_ring = 8;
constexpr double min_sine = 0.2;                 // at an element's corners: 12 degrees
constexpr std::int64_t max_quads = 200'000'000;  // at 600 bytes each: 120 GB

class Checks {
 public:
  Checks(Scene& scene, const schema::Origins& origins, Problems& problems)
      : scene_(scene), origins_(origins), problems_(problems) {}

  void run() {
    something_is_there();
    check_materials(scene_, refusal());
    points_files();
    outlines();
    counts();
    packings();
    check_stages(scene_, refusal());
    frictions();
    bonds();
    everything_is_used();
  }

 private:
  document::Origin origin(const std::string& path) const {
    const auto found = origins_.find(path);
    return found == origins_.end() ? document::Origin{{1, 1}, -1} : found->second;
  }

  // A default has no source location: report that of its table, or of the table above.
  document::Origin nearest_origin(std::string path) const {
    while (origins_.count(path) == 0 && path.find('.') != std::string::npos)
      path.erase(path.rfind('.'));
    return origin(path);
  }

  void refuse(const std::string& path, const std::string& message) {
    problems_.add(nearest_origin(path), path, message);
  }

  Refuse refusal() {
    return [this](const std::string& path, const std::string& message) { refuse(path, message); };
  }

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

  // A file is read once for all particles that need its outline.
  void points_files() {
    for (std::size_t i = 0; i < scene_.particles.size(); ++i)
      if (auto* outline = std::get_if<PointsOutline>(&scene_.particles[i].outline))
        for (const OutlineFault& fault : read_points(scene_.file.parent_path(), *outline))
          refuse(fmt::format("particle[{}].{}", i, fault.key), fault.message);
  }

  void outlines() {
    for (std::size_t i = 0; i < scene_.particles.size(); ++i) {
      ParticleSpec& particle = scene_.particles[i];
      const std::string path = fmt::format("particle[{}].", i);
      if (!std::visit([&](const auto& outline) { return is_good(path, outline); },
                      particle.outline))
        continue;
      if (particle.grains) {
        grains(path, particle);
        continue;
      }
      if (!size_alone(path, particle)) continue;
      mesh_of_size(particle);
      std::visit([&](const auto& outline) { check(path, outline, particle.mesh); },
                 particle.outline);
    }
  }

  template <class AnyOutline>
  bool is_good(const std::string& path, const AnyOutline& outline) {
    if constexpr (std::is_same_v<AnyOutline, PointsOutline>)
      if (outline.points.empty()) return false;  // its file has already been refused
    if constexpr (requires { faults_of(outline); }) {
      const std::vector<OutlineFault> faults = faults_of(outline);
      for (const OutlineFault& fault : faults) refuse(path + fault.key, fault.message);
      return faults.empty();
    }
    return true;
  }

  void grains(const std::string& path, const ParticleSpec& particle) {
    if (particle.grains->number.has_value() == particle.grains->size.has_value())
      refuse(path + "grains", "neither or both of number and size are given, allowed: one of them");
    if (std::holds_alternative<RingOutline>(particle.outline))
      refuse(path + "grains",
             "a ring cannot be divided into grains, allowed: an outline without a hole");
    const auto* disc = std::get_if<DiscMesh>(&particle.mesh);
    if (disc != nullptr && disc->refinement != 1)
      refuse(path + "mesh.refinement", "has no effect on grains, allowed: 1");
    if (particle.random_mesh_phase || particle.mesh_phase != 0)
      refuse(path + "mesh.phase", "has no effect on grains, allowed: 0 deg");
  }

  // The requested size determines the counts.
  bool size_alone(const std::string& path, const ParticleSpec& particle) {
    if (!particle.mesh_size) return true;
    for (const char* count : {"boundary_edges", "rings", "columns", "rows"})
      if (const auto found = origins_.find(path + "mesh." + count); found != origins_.end()) {
        refuse(found->first, "has no effect together with size, allowed: only one of them");
        return false;
      }
    return true;
  }

  // Without rings, the two edges next to a core corner lie on the outline, and their element has an
  // angle of nearly 180 degrees there.
  void check(const std::string& path, const DiscOutline&, const MeshSpec& spec) {
    const auto& mesh = std::get<DiscMesh>(spec);
    if (mesh.core == DiscMesh::Core::coarse) {
      if (mesh.boundary_edges % 12 != 0)
        refuse(path + "mesh.boundary_edges",
               fmt::format("{} edges do not match a coarse core, allowed: a multiple of 12",
                           mesh.boundary_edges));
      if (mesh.refinement > 1)
        refuse(path + "mesh.refinement", "a refined outline needs a uniform core, allowed: 1");
      return;
    }
    if (mesh.rings == 0 && mesh.boundary_edges > max_edges_without_rings)
      refuse(
          path + "mesh.rings",
          fmt::format("{} boundary edges without a ring make elements with a corner of nearly 180 "
                      "degrees, allowed: 0 with at most {} boundary edges, otherwise >= 1",
                      mesh.boundary_edges, max_edges_without_rings));
  }
  void check(const std::string&, const RectangleOutline&, const MeshSpec&) {}
  void check(const std::string& path, const RoundedRectangleOutline& outline,
             const MeshSpec& spec) {
    const auto& mesh = std::get<RoundedRectangleMesh>(spec);
    if (mesh.rings == 0)
      refuse(path + "mesh.rings",
             "a rounded rectangle needs a ring around its core, allowed: >= 1");
    const double maximum = std::min(outline.width, outline.height) / 2;
    if (outline.radius > maximum) {
      refuse(path + "radius",
             fmt::format("{:g} m is more than half of the shorter side, allowed: <= {:g} m",
                         outline.radius, maximum));
    } else if (mesh.boundary_edges < 4096 &&
               share_edges(outline, mesh.boundary_edges).growth > max_edge_growth) {
      refuse(path + "mesh.boundary_edges",
             fmt::format("{} edges are too few for corners this sharp: neighbouring edges would "
                         "differ too much in length, allowed: >= {}",
                         mesh.boundary_edges, fewest_edges(outline)));
    }
  }
  void check(const std::string& path, const RingOutline& outline, const MeshSpec& spec) {
    if (outline.hole >= outline.diameter)
      refuse(path + "hole", fmt::format("{:g} m leaves no wall, allowed: < {:g} m", outline.hole,
                                        outline.diameter));
    if (std::get<RingMesh>(spec).boundary_edges < min_edges_of_a_ring)
      refuse(path + "mesh.boundary_edges",
             fmt::format("too few for a ring, allowed: >= {}", min_edges_of_a_ring));
    if (std::get<RingMesh>(spec).rings == 0)
      refuse(path + "mesh.rings", "a ring needs at least one ring of elements, allowed: >= 1");
  }

  // Only if the counts are valid: the mesh is generated to check the quality of its elements.
  template <class CurvedOutline>
  void check(const std::string& path, const CurvedOutline& outline, const MeshSpec& spec) {
    const auto& mesh = std::get<StarMesh>(spec);
    const int fewest = fewest_boundary_edges(outline);
    if (mesh.rings == 0) {
      refuse(path + "mesh.rings", "needs a ring around its core, allowed: >= 1");
    } else if (mesh.boundary_edges < fewest) {
      refuse(path + "mesh.boundary_edges",
             fmt::format("{} edges are too few for an outline that turns this sharply, allowed: >= "
                         "{}",
                         mesh.boundary_edges, fewest));
    } else if (quads(spec) <= max_quads_a_particle) {
      const double sine = min_corner_sine(make_shape({"", 0, outline, mesh, false, 0, {}}));
      if (!(sine >= min_sine))
        refuse(path + "mesh",
               fmt::format("the worst corner of the mesh has a sine of {:.2g}, allowed: >= {:g}; "
                           "more edges, more rounding or a less slender outline help",
                           sine, min_sine));
    }
  }

  // For the disc and the rounded rectangle: of all cores with equal rim, the square has most quads.
  static std::int64_t with_core(int boundary_edges, int rings) {
    const std::int64_t side = boundary_edges / 4;
    return side * side + std::int64_t{rings} * boundary_edges;
  }
  static std::int64_t count(const DiscMesh& mesh) {
    if (mesh.core == DiscMesh::Core::even) return with_core(mesh.boundary_edges, mesh.rings);
    return with_core(mesh.boundary_edges / 3, 4) + std::int64_t{mesh.rings} * mesh.boundary_edges;
  }
  static std::int64_t count(const RectangleMesh& mesh) {
    return std::int64_t{mesh.columns} * mesh.rows;
  }
  static std::int64_t count(const RoundedRectangleMesh& mesh) {
    return with_core(mesh.boundary_edges, mesh.rings);
  }
  static std::int64_t count(const StarMesh& mesh) {
    return with_core(mesh.boundary_edges, mesh.rings);
  }
  static std::int64_t count(const RingMesh& mesh) {
    return std::int64_t{mesh.rings} * mesh.boundary_edges;
  }
  static std::int64_t quads(const MeshSpec& mesh) {
    return std::visit([](const auto& m) { return count(m); }, mesh);
  }

  std::int64_t quads_of(int particle) const {
    const ParticleSpec& spec = scene_.particles[static_cast<std::size_t>(particle)];
    return spec.grains ? 0 : quads(spec.mesh);  // the number of grains is limited
  }

  void counts() {
    for (std::size_t i = 0; i < scene_.particles.size(); ++i)
      if (!scene_.particles[i].grains && quads(scene_.particles[i].mesh) > max_quads_a_particle)
        refuse(fmt::format("particle[{}].mesh", i),
               fmt::format("the mesh has {} quads, allowed: at most {}",
                           quads(scene_.particles[i].mesh), max_quads_a_particle));
    std::int64_t particles = static_cast<std::int64_t>(scene_.bodies.size());
    std::int64_t total = 0;
    for (const BodySpec& body : scene_.bodies) total += quads_of(body.particle);
    for (std::size_t i = 0; i < scene_.packings.size(); ++i) {
      const std::string path = fmt::format("packing[{}]", i);
      if (!is_lattice(scene_.packings[i])) continue;
      particles += particle_count(scene_.packings[i]);
      if (particles > max_particles) {
        refuse(path, fmt::format("the scene has {} particles up to here, allowed: at most {}",
                                 particles, max_particles));
        return;  // the product below could overflow
      }
      total += particle_count(scene_.packings[i]) * quads_of(scene_.packings[i].particle);
    }
    if (total > max_quads)
      problems_.add(
          {{1, 1}, -1}, "particle",
          fmt::format("all meshes together have {} quads, allowed: at most {}", total, max_quads));
  }

  void packings() {
    for (std::size_t i = 0; i < scene_.packings.size(); ++i) {
      PackingSpec& packing = scene_.packings[i];
      const std::string path = fmt::format("packing[{}]", i);
      if (packing.kind != PackingSpec::Kind::random && !packing.classes.empty())
        refuse(path + ".class[0]",
               "has no effect with this kind, allowed: classes of kind = \"random\"");
      if (!is_lattice(packing)) continue;
      if (packing.kind == PackingSpec::Kind::hexagonal && packing.cells[0] == 1)
        refuse(path + ".columns",
               "every second row would be empty, allowed: >= 2 with kind = \"hexagonal\"");
      if (origins_.count(path + ".spacing") != 0) continue;
      const Outline& outline = scene_.particles[static_cast<std::size_t>(packing.particle)].outline;
      if (const auto box = rounded_box(outline); box && box->half.isZero(0))
        packing.spacing = 2 * box->radius;
      else
        problems_.add(origin(path), path + ".spacing",
                      "required key is missing: only discs and rings have a default spacing, "
                      "allowed: a quantity in m");
    }
  }

  bool is_tool(const std::string& name) const {
    return std::any_of(scene_.tools.begin(), scene_.tools.end(),
                       [&](const ToolSpec& tool) { return tool.name == name; });
  }

  std::vector<std::string> names_of_tools() const {
    std::vector<std::string> names;
    for (const ToolSpec& tool : scene_.tools) names.push_back(tool.name);
    return names;
  }

  void frictions() { check_frictions(scene_, names_of_tools(), refusal()); }

  void bonds() {
    for (std::size_t i = 0; i < scene_.bonds.size(); ++i)
      for (const ToolSpec& tool : scene_.tools)
        if (tool.shape == ToolSpec::Shape::constraint &&
            (tool.name == scene_.bonds[i].first || tool.name == scene_.bonds[i].second))
          refuse(fmt::format("bond[{}].between", i),
                 fmt::format(
                     "the constraint '{}' has no contact, allowed: tools that are not constraints",
                     tool.name));
    check_bonds(scene_, names_of_tools(), refusal());
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
      if (materials.count(static_cast<int>(i)) == 0)
        refuse_unused(fmt::format("material[{}]", i), scene_.materials[i].name, "[[particle]]",
                      refusal());
    for (std::size_t i = 0; i < scene_.particles.size(); ++i)
      if (particles.count(static_cast<int>(i)) == 0)
        refuse_unused(fmt::format("particle[{}]", i), scene_.particles[i].name,
                      "[[body]] or [[packing]]", refusal());
  }

  Scene& scene_;
  const schema::Origins& origins_;
  Problems& problems_;
};

}  // namespace

void complete_and_check(Scene& scene, const schema::Origins& origins, Problems& problems) {
  Checks(scene, origins, problems).run();
  read_drawn_faces(scene, origins, problems);
  check_tools(scene, origins, problems);
  check_cell(scene, origins, problems);
  check_output(scene, origins, problems);
}

}  // namespace pulvis
