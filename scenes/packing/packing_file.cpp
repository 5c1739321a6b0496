#include "scenes/packing/packing_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/language/csv_table.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/language/units.hpp"
#include "scenes/packing/place.hpp"

namespace pulvis {
namespace {

int class_of(const csv::Table& table, std::size_t row, std::size_t column, const Scene& scene) {
  std::vector<std::string> names;
  for (const ParticleSpec& particle : scene.particles)
    if (particle.class_of < 0) names.push_back(particle.name);
  const std::string& name = table.rows[row][column].text;
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    csv::refuse(table, row, column,
                fmt::format("no particle is called '{}'{}, allowed: {}", name,
                            suggestion(name, names), listed(names)));
  return static_cast<int>(found - names.begin());
}

std::optional<double> top_of(const csv::Table& table) {
  constexpr std::string_view key = "top:";
  for (const csv::Comment& comment : table.comments) {
    if (!comment.text.starts_with(key)) continue;
    try {
      return parse_quantity(comment.text.substr(key.size()), "m");
    } catch (const UnitError& error) {
      csv::refuse(table, comment,
                  fmt::format("{}, allowed: # top: and a quantity in m", error.what()));
    }
  }
  return std::nullopt;
}

bool any_scaled(const Scene& scene, const std::vector<BodySpec>& bodies) {
  return std::ranges::any_of(bodies, [&](const BodySpec& body) {
    return scene.particles[static_cast<std::size_t>(body.particle)].class_of >= 0;
  });
}

std::string header(const Scene& scene) {
  std::string text =
      fmt::format("# Packing of {}, seed {}\n", scene.file.filename().string(), scene.seed);
  for (const PackingSpec& packing : scene.packings) {
    if (packing.kind != PackingSpec::Kind::random) continue;
    const PackingReached& r = packing.reached;
    text += fmt::format(
        "# random: {} particles, relative density {:.6f}, mean gap {:.4f} "
        "diameters, smallest gap {:.3g} m, die {:.9g} m x {:.9g} m\n",
        packing.placed.size(), r.density, r.mean_gap, r.min_gap, packing.width,
        packing.top - packing.corner.y());
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
  std::vector<double> scale(table.rows.size(), 1);
  if (csv::has_column(table, "scale")) scale = column("scale", "");
  FiledPacking packing;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (scale[i] < 1e-6 || scale[i] > 1e6)
      csv::refuse(table, i, csv::column_at(table, "scale"),
                  fmt::format("{:g}, allowed: from 1e-06 to 1e+06", scale[i]));
    packing.particles.push_back(
        {class_of(table, i, names, scene), scale[i], Vec2(x[i], y[i]), angle[i]});
  }
  packing.top = top_of(table);
  return packing;
}

std::string packing_text(const Scene& scene, const std::vector<BodySpec>& bodies) {
  const bool scales = any_scaled(scene, bodies);
  std::string text = header(scene);
  text += fmt::format("class,x [m],y [m],angle [rad]{}\n", scales ? ",scale" : "");
  for (const BodySpec& body : bodies) {
    const ParticleSpec& own = scene.particles[static_cast<std::size_t>(body.particle)];
    const std::string& name =
        own.class_of < 0 ? own.name : scene.particles[static_cast<std::size_t>(own.class_of)].name;
    text += fmt::format("{},{},{},{}", name, body.position.x(), body.position.y(), body.angle);
    text += scales ? fmt::format(",{}\n", own.scale) : "\n";
  }
  return text;
}

}  // namespace pulvis
