#include "scenes/space/packing/fill_packings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "engine/activity.hpp"
#include "engine/portable_math.hpp"
#include "scenes/packing/class_of_size.hpp"
#include "scenes/packing/mixture.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/space/packing/die_filling.hpp"
#include "scenes/space/packing/packing_file.hpp"
#include "scenes/space/packing/widths.hpp"

namespace pulvis::space {
namespace {

int sized_class(Scene& scene, int particle, double scale) {
  return class_of_size(scene.particles, particle, scale, [](ParticleSpec& spec, double factor) {
    spec.shape = scaled(spec.shape, factor);
  });
}

ParticleMeasure measure_of(const ParticleShape& shape) {
  return {widths_of(shape).middle, volume_of(shape)};
}

Rotation rotation_of(const Turn& q) { return Rotation(q.w, q.x, q.y, q.z); }

class RandomPacking {
 public:
  RandomPacking(Scene& scene, std::size_t number, const schema::Origins& origins,
                Problems& problems)
      : scene_(scene),
        folder_(scene.file.parent_path()),
        packing_(scene_.packings[number]),
        path_(fmt::format("packing[{}]", number)),
        origins_(origins),
        problems_(problems) {
    order_.seed = scene.seed + 0x9e3779b97f4a7c15U * number;
  }

  void run() {
    Mixture mixture = mixture_wanted();
    if (mixture.count == 0) return;
    unit_ = portable::cbrt(6 / std::numbers::pi * mixture.content / mixture.count);
    for (const MixtureSize& size : mixture.sizes) add(size);
    order_.container = container(unit_);
    if (!everything_fits()) return;
    const double full = mixture.content / container(1).floor_area();  // height at a density of 1
    if (packing_.density) order_.min_height = full / *packing_.density / unit_;
    if (packing_.height) order_.min_height = *packing_.height / unit_;
    order_.shaken = packing_.dense != PackingSpec::Dense::touching;
    const Activity packing(fmt::format("random packing of {} particles", mixture.count));
    const FilledDie die = fill_die(order_);
    if (die.min_gap < 0) return refuse_die();
    if (order_.min_height > 0 && die.height > order_.min_height)
      return refuse_density(full / (order_.min_height * unit_), full / (die.height * unit_));
    place(die);
    packing_.reached = {full / (die.height * unit_), die.mean_gap, die.min_gap * unit_,
                        die.touches};
    packing_.top = packing_.container.corner.z() + die.height * unit_;
  }

 private:
  Container container(double unit) const {
    const ContainerSpec& given = packing_.container;
    return {given.kind, given.width / unit, given.depth / unit, given.diameter / 2 / unit};
  }

  Mixture mixture_wanted() {
    const MixtureOrder order{
        packing_.classes,
        packing_.count,
        packing_.density,
        packing_.height,
        packing_.dense != PackingSpec::Dense::given,
        container(1).floor_area(),
        3,
        folder_,
        [&](const MixtureClass& mixed) {
          return measure_of(scene_.particles[static_cast<std::size_t>(mixed.particle)].shape);
        }};
    return mixture_of(order, path_, origins_, problems_);
  }

  void add(const MixtureSize& size) {
    const int particle = sized_class(scene_, size.particle, size.scale);
    order_.shapes.push_back(
        contact_shape(scene_.particles[static_cast<std::size_t>(particle)], unit_));
    classes_.push_back(particle);
    order_.shape_of.insert(order_.shape_of.end(), static_cast<std::size_t>(size.count),
                           static_cast<int>(order_.shapes.size()) - 1);
  }

  document::Origin origin(const std::string& key) const {
    const auto found = origins_.find(origins_.contains(path_ + key) ? path_ + key : path_);
    return found == origins_.end() ? document::Origin{{1, 1}, -1} : found->second;
  }

  // A particle must fit through in some orientation.
  bool everything_fits() {
    const ContainerSpec& in = packing_.container;
    const bool round = in.kind == ContainerSpec::Kind::cylinder;
    const double width = round ? in.diameter : std::min(in.width, in.depth);
    for (const int particle : classes_) {
      const ParticleSpec& spec = scene_.particles[static_cast<std::size_t>(particle)];
      const double least = widths_of(spec.shape).least;
      const bool wide = least >= width;
      if (!wide && (!packing_.height || least < *packing_.height)) continue;
      const std::string key = !wide                  ? ".height"
                              : round                ? ".diameter"
                              : in.width <= in.depth ? ".width"
                                                     : ".depth";
      problems_.add(
          origin(key), path_ + key,
          fmt::format("'{}' is {:g} m wide and does not fit into the die, allowed: > {:g} m",
                      spec.name, least, least));
      return false;
    }
    return true;
  }

  // Some overlapped, however high the die.
  void refuse_die() {
    const std::string key = order_.container.round() ? ".diameter" : ".width";
    problems_.add(
        origin(key), path_ + key,
        "the particles cannot be placed in this die without overlap, allowed: a wider one");
  }

  void refuse_density(double wanted, double reached) {
    const std::string key = packing_.density ? ".density" : ".height";
    const double rounded = std::floor(reached * 1e4) / 1e4;
    problems_.add(
        origin(key), path_ + key,
        fmt::format("a relative density of {:.4f} cannot be reached: pressing and shaking these "
                    "particles in this die ended at {:.4f}, allowed: at most {:.4f} with this seed",
                    wanted, rounded, rounded));
  }

  void place(const FilledDie& die) {
    for (std::size_t i = 0; i < die.poses.size(); ++i) {
      const RigidPose& pose = die.poses[i];
      BodySpec body;
      body.particle = classes_[static_cast<std::size_t>(order_.shape_of[i])];
      body.position = packing_.container.corner + unit_ * Vec3(pose.at.x, pose.at.y, pose.at.z);
      body.rotation = rotation_of(pose.turn);
      body.mark = packing_.mark;
      packing_.placed.push_back(body);
    }
  }

  Scene& scene_;
  std::filesystem::path folder_;
  PackingSpec& packing_;
  std::string path_;
  const schema::Origins& origins_;
  Problems& problems_;
  DieFilling order_;
  std::vector<int> classes_;  // of the shapes
  double unit_ = 1;           // m, the mean diameter
};

double highest_point(const Scene& scene, const std::vector<BodySpec>& bodies) {
  double highest = std::numeric_limits<double>::lowest();
  std::map<int, RigidShape> shapes;  // by class
  for (const BodySpec& body : bodies) {
    const ParticleSpec& particle = scene.particles[static_cast<std::size_t>(body.particle)];
    const auto found = shapes.find(body.particle);
    const RigidShape& shape =
        found != shapes.end()
            ? found->second
            : shapes.emplace(body.particle, rigid_shape(particle.shape, 1)).first->second;
    const V3 up = turned_back(turn_of(body.rotation), {0, 0, 1});
    highest = std::max(highest, body.position.z() + dot(shape.support(up), up));
  }
  return highest;
}

void read_file(Scene& scene, PackingSpec& packing) {
  const FiledPacking filed = space::read_packing(scene.file.parent_path() / packing.file, scene);
  for (const FiledParticle& particle : filed.particles) {
    BodySpec body;
    body.particle = sized_class(scene, particle.particle, particle.scale);
    body.position = particle.position;
    body.rotation = particle.rotation;
    body.mark = packing.mark;
    packing.placed.push_back(body);
  }
  packing.top = filed.top ? *filed.top : highest_point(scene, packing.placed);
}

double lowest_place(const std::vector<std::array<Vec3, 3>>& triangles) {
  double lowest = std::numeric_limits<double>::max();
  for (const auto& triangle : triangles)
    for (const Vec3& corner : triangle) lowest = std::min(lowest, corner.z());
  return lowest;
}

// m, how far below its point a tool that rests on the packing reaches.
double foremost_place(const ToolSpec& tool) {
  if (!tool.triangles.empty()) return -lowest_place(tool.triangles);
  if (tool.shape != ToolSpec::Shape::punch || tool.profile.empty() || !(tool.normal.z() < 0))
    return 0;
  return std::ranges::max(tool.profile, {}, [](const Vec2& place) { return place.y(); }).y();
}

void put_tools_on(Scene& scene, const schema::Origins& origins, Problems& problems) {
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    if (!scene.tools[t].on_packing) continue;
    if (scene.packings.empty()) {
      const std::string key = fmt::format("tool[{}].point", t);
      problems.add(origins.at(key), key,
                   "there is no packing to rest on, allowed: a [[packing]], or a quantity in m");
      continue;
    }
    ToolSpec& tool = scene.tools[t];
    tool.point.z() = top_of_packings(scene) + foremost_place(tool);
  }
}

}  // namespace

void fill_packings(Scene& scene, const schema::Origins& origins, Problems& problems) {
  for (std::size_t i = 0; i < scene.packings.size(); ++i) {
    PackingSpec& packing = scene.packings[i];
    if (packing.kind == PackingSpec::Kind::random)
      RandomPacking(scene, i, origins, problems).run();
    else if (packing.kind == PackingSpec::Kind::csv)
      read_file(scene, packing);
    else
      packing.top = top_of_lattice(packing);
  }
  put_tools_on(scene, origins, problems);
}

}  // namespace pulvis::space
