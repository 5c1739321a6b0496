#include "scenes/scene_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "scenes/checks/cell_checks.hpp"
#include "scenes/checks/outline_particles.hpp"
#include "scenes/checks/process_checks.hpp"
#include "scenes/checks/solids/solid_particles.hpp"
#include "scenes/outlines/outline.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/results/observe.hpp"
#include "scenes/spec/dimension_words.hpp"
#include "scenes/spec/material_checks.hpp"
#include "scenes/tools/drawn_face.hpp"
#include "scenes/tools/tool_checks.hpp"

namespace pulvis {
namespace {

constexpr std::int64_t max_particles = 1'000'000;
constexpr std::int64_t max_quads = 200'000'000;      // at 600 bytes each: 120 GB
constexpr std::int64_t max_hexahedra = 100'000'000;  // at 1.5 kB each: 150 GB

class Checks {
 public:
  Checks(Scene& scene, const schema::Origins& origins, Problems& problems)
      : scene_(scene), origins_(origins), problems_(problems) {}

  void run() {
    something_is_there();
    check_materials(scene_, refusal());
    if (scene_.in_space())
      space::complete_solids(scene_, refusal());
    else
      complete_outlines(scene_, origins_, refusal());
    counts();
    packings();
    check_stages(scene_, refusal());
    check_frictions(scene_, names_of_tools(), refusal());
    bonds();
    everything_is_used();
  }

 private:
  // A default has no source location: report that of its table, or of the table above.
  document::Origin nearest_origin(std::string path) const {
    while (!origins_.contains(path) && path.find('.') != std::string::npos)
      path.erase(path.rfind('.'));
    const auto found = origins_.find(path);
    return found == origins_.end() ? document::Origin{{1, 1}, -1} : found->second;
  }

  void refuse(const std::string& path, const std::string& message) {
    problems_.add(nearest_origin(path), path, message);
  }

  Refuse refusal() {
    return [this](const std::string& path, const std::string& message) { refuse(path, message); };
  }

  bool given(const std::string& path) const { return origins_.contains(path); }

  const ParticleSpec& particle(int number) const {
    return scene_.particles[static_cast<std::size_t>(number)];
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

  std::int64_t elements_of(int number) const {
    return scene_.in_space() ? particle(number).hex_mesh.hexahedra() : quads_of(particle(number));
  }

  void counts() {
    std::int64_t particles = static_cast<std::int64_t>(scene_.bodies.size()), total = 0;
    for (const BodySpec& body : scene_.bodies) total += elements_of(body.particle);
    for (std::size_t i = 0; i < scene_.packings.size(); ++i) {
      const PackingSpec& packing = scene_.packings[i];
      if (!is_lattice(packing)) continue;
      particles += particle_count(packing);
      if (particles > max_particles)  // the product below could overflow
        return refuse(fmt::format("packing[{}]", i),
                      fmt::format("the scene has {} particles up to here, allowed: at most {}",
                                  particles, max_particles));
      total += particle_count(packing) * elements_of(packing.particle);
    }
    const std::int64_t most = scene_.in_space() ? max_hexahedra : max_quads;
    if (total > most)
      problems_.add({{1, 1}, -1}, "particle",
                    fmt::format("all meshes together have {} {}, allowed: at most {}", total,
                                words_of(scene_).elements, most));
  }

  void packings() {
    for (std::size_t i = 0; i < scene_.packings.size(); ++i) {
      PackingSpec& packing = scene_.packings[i];
      const std::string path = fmt::format("packing[{}]", i);
      const bool random = packing.kind == PackingSpec::Kind::random;
      if (!random && !packing.classes.empty())
        refuse(path + ".class[0]",
               "has no effect with this kind, allowed: classes of kind = \"random\"");
      if (random && scene_.in_space()) container(packing, path);
      if (!is_lattice(packing)) continue;
      if (packing.kind == PackingSpec::Kind::hexagonal && !scene_.in_space() &&
          packing.cells[0] == 1)
        refuse(path + ".columns",
               "every second row would be empty, allowed: >= 2 with kind = \"hexagonal\"");
      if (!given(path + ".spacing")) spacing(packing, path);
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
    if (const auto diameter = round_diameter(particle(packing.particle)))
      packing.spacing = touching_spacing(packing.kind) * *diameter;
    else
      refuse(path + ".spacing",
             fmt::format("required key is missing: only {} have a default spacing, allowed: a "
                         "quantity in m",
                         words_of(scene_).round));
  }

  // m, of discs, rings and spheres.
  std::optional<double> round_diameter(const ParticleSpec& of) const {
    if (scene_.in_space()) {
      const auto* sphere = std::get_if<SphereShape>(&of.shape);
      return sphere == nullptr ? std::nullopt : std::optional(sphere->diameter);
    }
    const auto box = rounded_box(of.outline);
    return box && box->half.isZero(0) ? std::optional(2 * box->radius) : std::nullopt;
  }

  std::vector<std::string> names_of_tools() const {
    std::vector<std::string> names;
    for (const ToolSpec& tool : scene_.tools) names.push_back(tool.name);
    return names;
  }

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
