#include "scenes/packing/packing_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/language/csv_table.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/language/units.hpp"
#include "scenes/packing/place.hpp"

namespace pulvis {
namespace {

// ---- what differs by dimension -----------------------------------------------------------------------
constexpr double of_length_1 = 1e-14;  // a packing's own quaternions are kept bit for bit

std::vector<double> numbers(const csv::Table& table, const char* name, const char* unit) {
  return csv::numbers(table, csv::column_at(table, name), unit);
}

// Products summed sequentially: identical bits on every machine.
double length_of(const Rotation& q) {
  return std::sqrt(q.w() * q.w() + q.x() * q.x() + q.y() * q.y() + q.z() * q.z());
}

Rotation unit_rotation(const csv::Table& table, std::size_t row, const Rotation& q) {
  const double length = length_of(q);
  if (length < 1e-6)
    csv::refuse(table, row, csv::column_at(table, "qw"),
                "the quaternion is 0, allowed: a non-zero one; 1 0 0 0 for no rotation");
  if (std::abs(length - 1) <= of_length_1) return q;
  return Rotation(q.w() / length, q.x() / length, q.y() / length, q.z() / length);
}

std::vector<BodySpec> outlines_in(const csv::Table& table) {
  csv::only(table, {"class", "x", "y", "angle", "scale"});
  const std::vector<double> x = numbers(table, "x", "m"), y = numbers(table, "y", "m"),
                            angle = numbers(table, "angle", "rad");
  std::vector<BodySpec> bodies(table.rows.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].position = Vec3(x[i], y[i], 0);
    bodies[i].angle = angle[i];
  }
  return bodies;
}

std::vector<BodySpec> solids_in(const csv::Table& table) {
  csv::only(table, {"class", "x", "y", "z", "qw", "qx", "qy", "qz", "scale"});
  const std::vector<double> x = numbers(table, "x", "m"), y = numbers(table, "y", "m"),
                            z = numbers(table, "z", "m");
  const std::vector<double> w = numbers(table, "qw", ""), u = numbers(table, "qx", ""),
                            v = numbers(table, "qy", ""), t = numbers(table, "qz", "");
  std::vector<BodySpec> bodies(table.rows.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].position = Vec3(x[i], y[i], z[i]);
    bodies[i].rotation = unit_rotation(table, i, Rotation(w[i], u[i], v[i], t[i]));
  }
  return bodies;
}

const char* columns_of(const Scene& scene) {
  return scene.in_space() ? "x [m],y [m],z [m],qw,qx,qy,qz" : "x [m],y [m],angle [rad]";
}

std::string place_text(const Scene& scene, const BodySpec& body) {
  const Vec3& p = body.position;
  const Rotation& q = body.rotation;
  if (!scene.in_space()) return fmt::format("{},{},{}", p.x(), p.y(), body.angle);
  return fmt::format("{},{},{},{},{},{},{}", p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
}

// ---- the same for both -------------------------------------------------------------------------------
int class_in(const csv::Table& table, std::size_t row, std::size_t column, const Scene& scene) {
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

// 1 if the table has none.
std::vector<double> scales_in(const csv::Table& table) {
  if (!csv::has_column(table, "scale")) return std::vector<double>(table.rows.size(), 1);
  const std::size_t column = csv::column_at(table, "scale");
  const std::vector<double> scale = csv::numbers(table, column, "");
  for (std::size_t i = 0; i < scale.size(); ++i)
    if (scale[i] < 1e-6 || scale[i] > 1e6)
      csv::refuse(table, i, column, fmt::format("{:g}, allowed: from 1e-06 to 1e+06", scale[i]));
  return scale;
}

// m, of `# top: 0.1 m`.
std::optional<double> top_in(const csv::Table& table) {
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

// The class name in the scene; for classes of one size, that of the class that was scaled.
const std::string& name_of_class(const Scene& scene, const ParticleSpec& own) {
  return own.class_of < 0 ? own.name : scene.particles[static_cast<std::size_t>(own.class_of)].name;
}

std::string header(const Scene& scene) {
  std::string text =
      fmt::format("# Packing of {}, seed {}\n", scene.file.filename().string(), scene.seed);
  for (const PackingSpec& packing : scene.packings) {
    if (packing.kind != PackingSpec::Kind::random) continue;
    const PackingReached& r = packing.reached;
    text += fmt::format(
        "# random: {} particles, relative density {:.6f}, mean gap {:.4f} diameters, smallest gap "
        "{:.3g} m, {}\n",
        packing.placed.size(), r.density, r.mean_gap, r.min_gap, container_text(scene, packing, 9));
  }
  if (!scene.packings.empty()) text += fmt::format("# top: {} m\n", top_of_packings(scene));
  return text;
}

}  // namespace

std::string container_text(const Scene& scene, const PackingSpec& packing, int digits) {
  const ContainerSpec& in = packing.container;
  const double height = packing.top - in.corner[scene.dimension - 1];
  if (!scene.in_space())
    return fmt::format("die {:.{}g} m x {:.{}g} m", in.width, digits, height, digits);
  if (in.kind == ContainerSpec::Kind::cylinder)
    return fmt::format("cylindrical die {:.{}g} m, height {:.{}g} m", in.diameter, digits, height,
                       digits);
  return fmt::format("box {:.{}g} m x {:.{}g} m x {:.{}g} m", in.width, digits, in.depth, digits,
                     height, digits);
}

FiledPacking read_packing(const std::filesystem::path& file, const Scene& scene) {
  const csv::Table table = csv::read(file);
  const std::vector<BodySpec> bodies = scene.in_space() ? solids_in(table) : outlines_in(table);
  const std::size_t names = csv::column_at(table, "class");
  const std::vector<double> scale = scales_in(table);
  FiledPacking packing;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    packing.particles.push_back({bodies[i], scale[i]});
    packing.particles.back().body.particle = class_in(table, i, names, scene);
  }
  packing.top = top_in(table);
  return packing;
}

std::string packing_text(const Scene& scene, const std::vector<BodySpec>& bodies) {
  const bool scales = std::ranges::any_of(
      bodies, [&](const BodySpec& body) { return scene.class_of(body).class_of >= 0; });
  std::string text = header(scene);
  text += fmt::format("class,{}{}\n", columns_of(scene), scales ? ",scale" : "");
  for (const BodySpec& body : bodies) {
    const ParticleSpec& own = scene.class_of(body);
    text += fmt::format("{},{}", name_of_class(scene, own), place_text(scene, body));
    text += scales ? fmt::format(",{}\n", own.scale) : "\n";
  }
  return text;
}

}  // namespace pulvis
