#include "scenes/packing/packing_file.hpp"

#include <fmt/format.h>

#include "scenes/packing/packing_table.hpp"
#include "scenes/packing/place.hpp"

namespace pulvis {
namespace {

std::string header(const Scene& scene) {
  std::string text =
      fmt::format("# Packing of {}, seed {}\n", scene.file.filename().string(), scene.seed);
  for (const PackingSpec& packing : scene.packings) {
    if (packing.kind != PackingSpec::Kind::random) continue;
    const PackingReached& r = packing.reached;
    text += fmt::format(
        "# random: {} particles, relative density {:.6f}, mean gap {:.4f} "
        "diameters, smallest gap {:.3g} m, die {:.9g} m x {:.9g} m\n",
        packing.placed.size(), r.density, r.mean_gap, r.min_gap, packing.container.width,
        packing.top - packing.container.corner.y());
  }
  if (!scene.packings.empty()) text += fmt::format("# top: {} m\n", top_of_packings(scene));
  return text;
}

}  // namespace

FiledPacking read_packing(const std::filesystem::path& file, const Scene& scene) {
  const csv::Table table = csv::read(file);
  csv::only(table, {"class", "x", "y", "angle", "scale"});
  const auto column = [&](const char* name, const char* unit) {
    return csv::numbers(table, csv::column_at(table, name), unit);
  };
  const std::size_t names = csv::column_at(table, "class");
  const std::vector<double> x = column("x", "m"), y = column("y", "m");
  const std::vector<double> angle = column("angle", "rad");
  const std::vector<double> scale = scales_in(table);
  FiledPacking packing;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    packing.particles.push_back(
        {class_in(table, i, names, scene.particles), scale[i], Vec2(x[i], y[i]), angle[i]});
  packing.top = top_in(table);
  return packing;
}

std::string packing_text(const Scene& scene, const std::vector<BodySpec>& bodies) {
  const bool scales = any_scaled(scene.particles, bodies);
  std::string text = header(scene);
  text += fmt::format("class,x [m],y [m],angle [rad]{}\n", scales ? ",scale" : "");
  for (const BodySpec& body : bodies) {
    const ParticleSpec& own = scene.particles[static_cast<std::size_t>(body.particle)];
    text += fmt::format("{},{},{},{}", name_of_class(scene.particles, own), body.position.x(),
                        body.position.y(), body.angle);
    text += scales ? fmt::format(",{}\n", own.scale) : "\n";
  }
  return text;
}

}  // namespace pulvis
