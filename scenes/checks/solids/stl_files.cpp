#include "scenes/checks/solids/stl_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "engine/portable_math.hpp"
#include "scenes/checks/solids/stl_bodies.hpp"
#include "scenes/language/units.hpp"
#include "scenes/meshes/hexahedra/stl.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::space {
namespace {

using Triangles = std::vector<std::array<Vec3, 3>>;

// In m; empty, with a problem reported, if the file or its unit is wrong.
std::optional<Triangles> triangles_in(const Scene& scene, const std::string& file,
                                      const std::string& unit, const std::string& path,
                                      const Refuse& refuse) {
  double metre = 0;
  try {
    metre = parse_quantity("1 " + unit, "m");
  } catch (const UnitError& error) {
    refuse(path + ".unit", fmt::format("{}, allowed: a unit of length, \"mm\"", error.what()));
    return std::nullopt;
  }
  try {
    Triangles triangles = read_stl((scene.file.parent_path() / file).string());
    refuse_touching_bodies(triangles);
    for (auto& triangle : triangles)
      for (Vec3& corner : triangle) corner *= metre;
    return triangles;
  } catch (const BadStl& bad) {
    refuse(path + ".file", bad.what());
    return std::nullopt;
  }
}

// Centred at their centre of volume, with the volume of a sphere of `diameter` if given.
void set_in_place(Triangles& triangles, const std::optional<double>& diameter) {
  const Vec3 centre = centre_of_volume(triangles);
  const double scale =
      diameter ? *diameter * portable::cbrt(std::numbers::pi / 6 / volume_of(triangles)) : 1;
  for (auto& triangle : triangles)
    for (Vec3& corner : triangle) corner = scale * (corner - centre);
}

}  // namespace

void read_stl_files(Scene& scene, const Refuse& refuse) {
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    auto* shape = std::get_if<StlShape>(&scene.particles[i].shape);
    if (shape == nullptr) continue;
    const std::string path = fmt::format("particle[{}]", i);
    auto triangles = triangles_in(scene, shape->file, shape->unit, path, refuse);
    if (!triangles) continue;
    if (const auto why = why_not_star_shaped(*triangles))
      refuse(path + ".file",
             fmt::format("{}, allowed: a surface that is star-shaped about its centre of volume",
                         *why));
    set_in_place(*triangles, shape->diameter);
    shape->triangles = std::move(*triangles);
  }
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    ToolSpec& tool = scene.tools[t];
    if (tool.shape != ToolSpec::Shape::stl) continue;
    if (auto triangles =
            triangles_in(scene, tool.file, tool.unit, fmt::format("tool[{}]", t), refuse))
      tool.triangles = std::move(*triangles);
  }
}

}  // namespace pulvis::space
