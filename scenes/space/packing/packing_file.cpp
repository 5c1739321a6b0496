#include "scenes/space/packing/packing_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "scenes/packing/packing_table.hpp"
#include "scenes/packing/place.hpp"

namespace pulvis::space {
namespace {

constexpr double of_length_1 = 1e-14;  // a packing's own quaternions are kept bit for bit

std::string described(const PackingSpec& packing) {
  const ContainerSpec& die = packing.container;
  const double height = packing.top - die.corner.z();
  if (die.kind == ContainerSpec::Kind::cylinder)
    return fmt::format("round die {:.9g} m, height {:.9g} m", die.diameter, height);
  return fmt::format("box {:.9g} m x {:.9g} m x {:.9g} m", die.width, die.depth, height);
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
        packing.placed.size(), r.density, r.mean_gap, r.min_gap, described(packing));
  }
  if (!scene.packings.empty()) text += fmt::format("# top: {} m\n", top_of_packings(scene));
  return text;
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

}  // namespace

FiledPacking read_packing(const std::filesystem::path& file, const Scene& scene) {
  const csv::Table table = csv::read(file);
  csv::only(table, {"class", "x", "y", "z", "qw", "qx", "qy", "qz", "scale"});
  const auto column = [&](const char* name, const char* unit) {
    return csv::numbers(table, csv::column_at(table, name), unit);
  };
  const std::size_t names = csv::column_at(table, "class");
  const std::vector<double> x = column("x", "m"), y = column("y", "m"), z = column("z", "m");
  const std::vector<double> w = column("qw", ""), u = column("qx", ""), v = column("qy", ""),
                            t = column("qz", "");
  const std::vector<double> scale = scales_in(table);
  FiledPacking packing;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    packing.particles.push_back({class_in(table, i, names, scene.particles), scale[i],
                                 Vec3(x[i], y[i], z[i]),
                                 unit_rotation(table, i, Rotation(w[i], u[i], v[i], t[i]))});
  packing.top = top_in(table);
  return packing;
}

std::string packing_text(const Scene& scene, const std::vector<BodySpec>& bodies) {
  const std::vector<ParticleSpec>& particles = scene.particles;
  const bool scales = any_scaled(particles, bodies);
  std::string text = header(scene);
  text += fmt::format("class,x [m],y [m],z [m],qw,qx,qy,qz{}\n", scales ? ",scale" : "");
  for (const BodySpec& body : bodies) {
    const ParticleSpec& own = particles[static_cast<std::size_t>(body.particle)];
    const Vec3& p = body.position;
    const Rotation& q = body.rotation;
    text += fmt::format("{},{},{},{},{},{},{},{}", name_of_class(particles, own), p.x(), p.y(),
                        p.z(), q.w(), q.x(), q.y(), q.z());
    text += scales ? fmt::format(",{}\n", own.scale) : "\n";
  }
  return text;
}

}  // namespace pulvis::space
