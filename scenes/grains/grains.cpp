#include "scenes/grains/grains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "scenes/grains/cut_cells.hpp"
#include "scenes/meshes/mesh.hpp"
#include "scenes/meshes/mesh_outlines.hpp"
#include "scenes/outlines/curve_of.hpp"
#include "scenes/outlines/outline.hpp"
#include "scenes/outlines/star.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/spec/rotation.hpp"

namespace pulvis {
namespace {

using std::numbers::pi;

constexpr double least_side = 0.5;    // of the mesh's edge length: shorter faces are removed
constexpr double least_sine = 0.2;    // minimum sine of a mesh corner
constexpr double least_share = 0.05;  // of the mean area
constexpr int attempts = 40;
constexpr int max_grains = 4096;  // of a particle

std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
  std::uint64_t x = a * 0x9e3779b97f4a7c15U + b + 0x632be59bd9b4e019U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

GrainOutline outline_of(const GrainMap& map, const std::vector<GrainMap::Side>& grain,
                        const std::shared_ptr<const OutlineCurve>& particle) {
  GrainOutline outline{{}, particle};
  for (std::size_t i = 0; i < grain.size(); ++i) {
    const auto& from = map.vertices[static_cast<std::size_t>(grain[i].vertex)];
    GrainOutline::Face face{from.at, 0, 0, grain[i].edges};
    if (grain[i].neighbour == GrainMap::outside) {
      face.begin = from.s;
      face.end = from.s + side_length(map, grain, i, particle->length());
    }
    outline.faces.push_back(face);
  }
  return outline;
}

bool is_star(const GrainMap& map, const std::vector<GrainMap::Side>& grain) {
  std::vector<Vec2> polygon;
  for (const GrainMap::Side& side : grain)
    polygon.push_back(map.vertices[static_cast<std::size_t>(side.vertex)].at);
  return star_centre(polygon).has_value();
}

// Of the elements' corners; no more of the grain's shape is made than that takes.
double worst_sine(const GrainOutline& outline, const OutlineCurve& curve, const StarMesh& mesh) {
  Shape shape;
  shape.area = curve.area();
  mesh_outline(outline, curve, mesh, shape);
  return min_corner_sine(shape);
}

class Cutter {
 public:
  Cutter(Scene& scene, ParticleSpec& particle)
      : scene_(scene),
        particle_(particle),
        curve_(std::make_shared<const OutlineCurve>(any_curve(particle.outline))) {}

  // From the diameter of the circle with the mean grain's area.
  static int number_of(const GrainsSpec& grains, double area) {
    if (grains.number) return *grains.number;
    return static_cast<int>(std::clamp(std::round(4 * area / (pi * *grains.size * *grains.size)),
                                       0.0, max_grains + 1.0));
  }

  // False if no tessellation that can be meshed was found.
  bool add_variant(int variant) {
    const GrainsSpec& grains = *particle_.grains;
    const int number = number_of(grains, curve_->area());
    const double mean = curve_->area() / number,
                 edge = particle_.mesh_size.value_or(std::sqrt(4 * pi * mean) / grains.edges);
    Tessellation wanted{number, grains.relaxation, grains.aspect_ratio, grains.direction};
    for (int attempt = 0; attempt < attempts; ++attempt) {
      wanted.seed = mixed(mixed(scene_.seed, static_cast<std::uint64_t>(variant)),
                          static_cast<std::uint64_t>(attempt));
      GrainMap map = tessellate(*curve_, wanted);
      join_short_sides(map, least_side * edge, *curve_);
      divide_sides(map, edge, curve_->length());
      if (auto cuts = cuts_of(map, mean, variant)) {
        add(*cuts);
        return true;
      }
    }
    return false;
  }

 private:
  struct Cut {
    ParticleSpec spec;
    Vec2 at;  // m, of the grain's centre, in the particle's frame
  };

  std::optional<std::vector<Cut>> cuts_of(const GrainMap& map, double mean, int variant) const {
    std::vector<Cut> cuts;
    for (const auto& grain : map.grains) {
      if (!is_star(map, grain)) return {};
      ParticleSpec spec;
      spec.name = fmt::format("{}#{}.{}", particle_.name, variant + 1, cuts.size() + 1);
      spec.material = particle_.material;
      spec.mark = particle_.mark;
      const GrainOutline outline = outline_of(map, grain, curve_);
      int edges = 0;
      for (const auto& face : outline.faces) edges += face.edges;
      spec.outline = outline;
      const StarMesh mesh{edges, 1};
      spec.mesh = mesh;
      const OutlineCurve curve = curve_of(outline);
      if (curve.area() < least_share * mean) return {};
      if (!(worst_sine(outline, curve, mesh) >= least_sine)) return {};
      cuts.push_back({std::move(spec), outline.faces[0].from - curve.at(0).at});
    }
    return cuts;
  }

  void add(std::vector<Cut>& cuts) {
    auto& places = particle_.tessellations.emplace_back();
    for (Cut& cut : cuts) {
      places.push_back({static_cast<int>(scene_.grains.size()), cut.at});
      scene_.grains.push_back(std::move(cut.spec));
    }
  }

  Scene& scene_;
  ParticleSpec& particle_;
  std::shared_ptr<const OutlineCurve> curve_;
};

// Particles of a class get random variants; a single particle gets the first.
std::size_t variant_of(const Scene& scene, const ParticleSpec& particle, std::size_t number) {
  return mixed(scene.seed, number) % particle.tessellations.size();
}

}  // namespace

void make_grains(Scene& scene, const schema::Origins& origins, Problems& problems) {
  if (std::ranges::none_of(scene.particles, [](const auto& p) { return p.grains.has_value(); }))
    return;
  const std::vector<BodySpec> particles = place_bodies(scene);
  for (std::size_t p = 0; p < scene.particles.size(); ++p) {
    ParticleSpec& particle = scene.particles[p];
    if (!particle.grains) continue;
    const std::size_t declared =
        particle.class_of < 0 ? p : static_cast<std::size_t>(particle.class_of);
    const auto refuse = [&](const char* key, const std::string& message) {
      const std::string table = fmt::format("particle[{}].grains", declared);
      const std::string path = fmt::format("{}.{}", table, key);
      const auto at = origins.find(origins.contains(path) ? path : table);
      problems.add(at->second, path, message);
    };
    const double area = outline_area(particle.outline);
    const int number = Cutter::number_of(*particle.grains, area);
    if (number < 2 || number > max_grains) {
      refuse("size", fmt::format("it gives {} for an area of {:.4g} m^2, allowed: 2 to {} grains: "
                                 "a size of {:.4g} to {:.4g} m",
                                 number > max_grains ? fmt::format("more than {}", max_grains)
                                                     : fmt::format("{} grains", number),
                                 area, max_grains, std::sqrt(4 * area / pi / max_grains),
                                 std::sqrt(4 * area / pi / 2)));
      continue;
    }
    Cutter cutter(scene, particle);
    const auto placed = std::ranges::count(particles, static_cast<int>(p), &BodySpec::particle);
    const int variants =
        static_cast<int>(std::min<std::ptrdiff_t>(particle.grains->variants, placed));
    for (int variant = 0; variant < variants; ++variant) {
      if (cutter.add_variant(variant)) continue;
      refuse("relaxation",
             fmt::format("{} tessellations had grains too thin for a mesh, allowed: more "
                         "relaxation, more edges, or fewer grains",
                         attempts));
      break;
    }
  }
}

std::vector<BodySpec> grains_of(const Scene& scene, const std::vector<BodySpec>& particles) {
  std::vector<BodySpec> bodies;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    BodySpec body = particles[i];
    body.parent = static_cast<int>(i);
    const ParticleSpec& particle = scene.class_of(body);
    if (particle.tessellations.empty()) {
      bodies.push_back(body);
      continue;
    }
    for (const GrainPlace& grain : particle.tessellations[variant_of(scene, particle, i)]) {
      const Vec2 arm = rotation(body.angle) * grain.at;
      BodySpec part = body;
      part.particle = static_cast<int>(scene.particles.size()) + grain.grain;
      part.position.head<2>() += arm;
      part.velocity.head<2>() += body.angular_velocity.z() * Vec2(-arm.y(), arm.x());
      bodies.push_back(part);
    }
  }
  return bodies;
}

}  // namespace pulvis
