#include "scenes/checks/overlaps.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>

#include "scenes/checks/far_away.hpp"
#include "scenes/checks/outline_overlaps.hpp"
#include "scenes/checks/solids/solid_overlaps.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/packing/particle_size.hpp"
#include "scenes/spec/dimension_words.hpp"
#include "scenes/tools/cell.hpp"

namespace pulvis {
namespace {

constexpr std::size_t most_reports = 20;  // a packing that is too dense overlaps everywhere

class Report {
 public:
  // `count` particles, followed by all their images.
  Report(const Scene& scene, const std::vector<BodySpec>& bodies, std::size_t count)
      : scene_(scene), bodies_(bodies), count_(count) {}

  void particles(const std::vector<Overlap>& overlaps) {
    for (const Overlap& overlap : overlaps) {
      if (overlap.other >= count_) continue;  // two images
      add(overlap,
          fmt::format("{} overlaps {} by {:.6g} m, allowed: particles that touch or are apart",
                      described(overlap.particle), described(overlap.other), overlap.depth));
    }
  }

  void tools(const Overlaps& found) {
    std::vector<bool> reported(scene_.tools.size());
    for (const Overlap& overlap : found.with_tools) {
      if (!found.reversed[overlap.other]) {
        with_tool(overlap);
      } else if (!reported[overlap.other]) {
        turned_away(overlap.other);
        reported[overlap.other] = true;
      }
    }
  }

  void throw_if_any() const {
    if (!problems_.empty()) throw SceneError(problems_);
  }

 private:
  void turned_away(std::size_t number) {
    const ToolSpec& tool = scene_.tools[number];
    const bool plane = tool.shape == ToolSpec::Shape::plane;
    problems_.push_back(
        {scene_.file_of(tool.mark).string(), tool.mark.line, tool.mark.column, "",
         fmt::format("tool[{}].{}", number, plane ? "normal" : "points"),
         plane
             ? fmt::format("tool '{}' faces away from the powder: every particle lies behind it, "
                           "allowed: a normal that points from the tool into the powder, [{}]",
                           tool.name, vector_text(-tool.normal))
             : fmt::format("tool '{}' faces away from the powder: every particle lies inside it, "
                           "allowed: the points in the opposite order, with the powder to the left",
                           tool.name)});
  }

  void with_tool(const Overlap& overlap) {
    const ToolSpec& tool = scene_.tools[overlap.other];
    add(overlap,
        is_solid(tool)
            ? fmt::format("{} reaches {:.6g} m into tool '{}', allowed: particles outside of every "
                          "tool",
                          described(overlap.particle), overlap.depth, tool.name)
            : fmt::format("{} is outside the die: it reaches {:.6g} m behind tool '{}', allowed: "
                          "particles in front of every tool",
                          described(overlap.particle), overlap.depth, tool.name));
  }

  void add(const Overlap& overlap, const std::string& message) {
    if (problems_.size() > most_reports) return;
    const BodySpec& body = bodies_[overlap.particle];
    const bool last = problems_.size() == most_reports;
    problems_.push_back({scene_.file_of(body.mark).string(), body.mark.line, body.mark.column, "",
                         last ? "scene" : key_of(body),
                         last ? "there are more overlaps that are not listed" : message});
  }

  // All particles of a packing share its mark, so the mark identifies the source of a particle.
  std::string key_of(const BodySpec& body) const {
    for (std::size_t i = 0; i < scene_.packings.size(); ++i)
      if (scene_.packings[i].mark == body.mark) return fmt::format("packing[{}]", i);
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i)
      if (scene_.bodies[i].mark == body.mark) return fmt::format("body[{}].position", i);
    return "particle";
  }

  std::string described(std::size_t i) const {
    const BodySpec& body = bodies_[i];
    return fmt::format("{}particle {} ('{}' at ({}) m)", i < count_ ? "" : "the image of ",
                       i % count_, scene_.class_of(body).name, vector_text(body.position));
  }

  std::string vector_text(const Vec3& v) const {
    const Vec3 no_minus_zero = v + Vec3::Zero();
    return fmt::format("{:.6g}", fmt::join(components_of(scene_, no_minus_zero.data()), ", "));
  }

  const Scene& scene_;
  const std::vector<BodySpec>& bodies_;
  std::size_t count_;
  std::vector<SceneProblem> problems_;
};

// The bodies, followed by their images across the cell boundaries.
std::vector<BodySpec> with_images(const Scene& scene, const std::vector<BodySpec>& bodies) {
  std::vector<BodySpec> all = bodies;
  if (!scene.cell) return all;
  const std::vector<Vec3> vectors = cell_vectors(*scene.cell);
  const int across = scene.in_space() ? 1 : 0;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      for (int k = -across; k <= across; ++k) {
        if (i == 0 && j == 0 && k == 0) continue;
        Vec3 shift = i * vectors[0] + j * vectors[1];
        if (across != 0) shift += k * vectors[2];
        for (const BodySpec& body : bodies) {
          all.push_back(body);
          all.back().position += shift;
        }
      }
  return all;
}

}  // namespace

std::size_t check_overlaps(const Scene& scene, const std::vector<BodySpec>& bodies) {
  if (bodies.empty()) return 0;
  check_distance(scene, bodies, [&](const BodySpec& body) { return size_of(scene, body); });
  const std::vector<BodySpec> all = with_images(scene, bodies);
  const Overlaps found =
      scene.in_space() ? space::solid_overlaps(scene, all) : outline_overlaps(scene, all);
  Report report(scene, all, bodies.size());
  report.tools(found);
  report.particles(found.between_particles);
  report.throw_if_any();
  return found.pairs;
}

}  // namespace pulvis
