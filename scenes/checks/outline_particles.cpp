#include "scenes/checks/outline_particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

#include "scenes/meshes/mesh.hpp"
#include "scenes/meshes/mesh_rounded_rectangle.hpp"
#include "scenes/meshes/mesh_size.hpp"
#include "scenes/outlines/outline.hpp"
#include "scenes/outlines/outline_checks.hpp"
#include "scenes/outlines/points_file.hpp"

namespace pulvis {
namespace {

constexpr std::int64_t max_quads_a_particle = 1'000'000;
constexpr int max_edges_without_rings = 20;
constexpr int min_edges_of_a_ring = 8;
constexpr double min_sine = 0.2;  // at an element's corners: 12 degrees

// For the disc and the rounded rectangle: of all cores with equal rim, the square has most quads.
std::int64_t with_core(int boundary_edges, int rings) {
  const std::int64_t side = boundary_edges / 4;
  return side * side + std::int64_t{rings} * boundary_edges;
}
std::int64_t count(const DiscMesh& mesh) {
  if (mesh.core == DiscMesh::Core::even) return with_core(mesh.boundary_edges, mesh.rings);
  return with_core(mesh.boundary_edges / 3, 4) + std::int64_t{mesh.rings} * mesh.boundary_edges;
}
std::int64_t count(const RectangleMesh& mesh) { return std::int64_t{mesh.columns} * mesh.rows; }
std::int64_t count(const RoundedRectangleMesh& mesh) {
  return with_core(mesh.boundary_edges, mesh.rings);
}
std::int64_t count(const StarMesh& mesh) { return with_core(mesh.boundary_edges, mesh.rings); }
std::int64_t count(const RingMesh& mesh) { return std::int64_t{mesh.rings} * mesh.boundary_edges; }
std::int64_t quads(const MeshSpec& mesh) {
  return std::visit([](const auto& m) { return count(m); }, mesh);
}

class OutlineChecks {
 public:
  OutlineChecks(Scene& scene, const schema::Origins& origins, const Refuse& refuse)
      : scene_(scene), origins_(origins), refuse_(refuse) {}

  void run() {
    points_files();
    outlines();
    for (std::size_t i = 0; i < scene_.particles.size(); ++i)
      if (quads_of(scene_.particles[i]) > max_quads_a_particle)
        refuse(fmt::format("particle[{}].mesh", i),
               fmt::format("the mesh has {} quads, allowed: at most {}",
                           quads_of(scene_.particles[i]), max_quads_a_particle));
  }

 private:
  void refuse(const std::string& path, const std::string& message) { refuse_(path, message); }

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

  Scene& scene_;
  const schema::Origins& origins_;
  const Refuse& refuse_;
};

}  // namespace

std::int64_t quads_of(const ParticleSpec& particle) {
  return particle.grains ? 0 : quads(particle.mesh);  // the number of grains is limited
}

void complete_outlines(Scene& scene, const schema::Origins& origins, const Refuse& refuse) {
  OutlineChecks(scene, origins, refuse).run();
}

}  // namespace pulvis
