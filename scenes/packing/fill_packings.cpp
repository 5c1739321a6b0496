#include "scenes/packing/fill_packings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "engine/activity.hpp"
#include "scenes/outlines/outline.hpp"
#include "scenes/outlines/outline_reach.hpp"
#include "scenes/outlines/portable.hpp"
#include "scenes/outlines/scaled_outline.hpp"
#include "scenes/packing/class_of_size.hpp"
#include "scenes/packing/die_filling.hpp"
#include "scenes/packing/mixture.hpp"
#include "scenes/packing/packing_file.hpp"
#include "scenes/packing/place.hpp"

namespace pulvis {
namespace {

using portable::V2;

constexpr double outline_deviation = 1e-3;  // of a particle's size, unless it is a rounded polygon

int sized_class(Scene& scene, int particle, double scale) {
  return class_of_size(scene.particles, particle, scale, [](ParticleSpec& spec, double factor) {
    spec.outline = scaled(spec.outline, factor);
  });
}

// The sieve size is the minimum width of the outline.
ParticleMeasure measure_of(const Scene& scene, const MixtureClass& mixed) {
  const Outline& outline = scene.particles[static_cast<std::size_t>(mixed.particle)].outline;
  const double area = outline_area(outline);
  if (mixed.size.kind == SizeLaw::Kind::mono) return {1, area};
  const double length = std::sqrt(area);
  return {length * rigid_shape(outline, length, length / 1000).min_width, area};
}

class RandomPacking {
 public:
  RandomPacking(Scene& scene, std::size_t number, const schema::Origins& origins,
                Problems& problems)
      : scene_(scene),
        packing_(scene.packings[number]),
        path_(fmt::format("packing[{}]", number)),
        origins_(origins),
        problems_(problems) {
    order_.seed = scene.seed + 0x9e3779b97f4a7c15U * number;
  }

  void run() {
    const Mixture mixture =
        mixture_of({packing_.classes, packing_.count, packing_.density, packing_.height,
                    packing_.dense != PackingSpec::Dense::given, packing_.container.width, 2,
                    scene_.file.parent_path(),
                    [&](const MixtureClass& mixed) { return measure_of(scene_, mixed); }},
                   path_, origins_, problems_);
    if (mixture.count == 0) return;
    unit_ = 2 * std::sqrt(mixture.content / mixture.count / std::numbers::pi);
    for (const MixtureSize& size : mixture.sizes) add(size);
    order_.width = packing_.container.width / unit_;
    order_.periodic = scene_.cell.has_value();
    if (!everything_fits()) return;
    const double full = mixture.content / packing_.container.width;  // height at a density of 1
    if (packing_.density) order_.min_height = full / *packing_.density / unit_;
    if (packing_.height) order_.min_height = *packing_.height / unit_;
    order_.time_to_shake = packing_.dense == PackingSpec::Dense::touching ? 0 : 1;
    const Activity packing(fmt::format("random packing of {} particles", mixture.count));
    const FilledDie die = fill_die(order_);
    if (die.min_gap < 0) return refuse_die();
    if (order_.min_height > 0 && die.height > order_.min_height)
      return refuse_density(full / (order_.min_height * unit_), full / (die.height * unit_));
    place(die);
    packing_.reached = {full / (die.height * unit_), die.mean_gap, die.min_gap * unit_,
                        die.touches};
    packing_.top = packing_.container.corner.y() + die.height * unit_;
    if (scene_.cell) scene_.cell->height = die.height * unit_;
  }

 private:
  void add(const MixtureSize& size) {
    const int particle = sized_class(scene_, size.particle, size.scale);
    const ParticleSpec& spec = scene_.particles[static_cast<std::size_t>(particle)];
    const double deviation = outline_deviation * std::sqrt(outline_area(spec.outline));
    order_.shapes.push_back(rigid_shape(spec.outline, unit_, deviation));
    classes_.push_back(particle);
    order_.shape_of.insert(order_.shape_of.end(), static_cast<std::size_t>(size.count),
                           static_cast<int>(order_.shapes.size()) - 1);
  }

  document::Origin origin(const std::string& key) const {
    const auto found = origins_.find(origins_.contains(path_ + key) ? path_ + key : path_);
    return found->second;
  }

  bool everything_fits() {
    for (std::size_t s = 0; s < order_.shapes.size(); ++s) {
      const double width = order_.shapes[s].min_width;
      const bool wide = width >= order_.width;
      if (!wide && (!packing_.height || width * unit_ < *packing_.height)) continue;
      const std::string key = wide ? ".width" : ".height";
      problems_.add(
          origin(key), path_ + key,
          fmt::format("'{}' is {:g} m wide and does not fit into the die, allowed: > {:g} m",
                      scene_.particles[static_cast<std::size_t>(classes_[s])].name, width * unit_,
                      width * unit_));
      return false;
    }
    return true;
  }

  // Some overlapped, however high the die.
  void refuse_die() {
    const std::string key = ".width";
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
    const double turn = scene_.cell ? scene_.cell->angle : 0;
    const portable::Turn turned{portable::cos(turn), portable::sin(turn)};
    for (std::size_t i = 0; i < die.poses.size(); ++i) {
      const auto shape = static_cast<std::size_t>(order_.shape_of[i]);
      const RigidPose& pose = die.poses[i];
      const V2 in_cell = home(pose.at, die.height) - pose.turn * order_.shapes[shape].centroid;
      const V2 at = turn == 0 ? in_cell : turned * in_cell;
      BodySpec body;
      body.particle = classes_[shape];
      body.position = packing_.container.corner + unit_ * Vec3(at.x, at.y, 0);
      body.angle = portable::atan2(pose.turn.s, pose.turn.c) + turn;
      body.mark = packing_.mark;
      packing_.placed.push_back(body);
    }
  }
  V2 home(const V2& at, double height) const {
    if (!order_.periodic) return at;
    return {at.x - std::floor(at.x / order_.width) * order_.width,
            at.y - std::floor(at.y / height) * height};
  }

  Scene& scene_;
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
  std::map<int, OutlineReach> reaches;  // by class
  for (const BodySpec& body : bodies) {
    const OutlineReach& reach =
        reaches.try_emplace(body.particle, scene.class_of(body).outline).first->second;
    highest = std::max(highest, body.position.y() + reach.along(body.angle, Vec2::UnitY()));
  }
  return highest;
}

void read_file(Scene& scene, PackingSpec& packing) {
  const FiledPacking filed = read_packing(scene.file.parent_path() / packing.file, scene);
  for (const FiledParticle& particle : filed.particles) {
    BodySpec body;
    body.particle = sized_class(scene, particle.particle, particle.scale);
    body.position = in_space(particle.position);
    body.angle = particle.angle;
    body.mark = packing.mark;
    packing.placed.push_back(body);
  }
  packing.top = filed.top ? *filed.top : highest_point(scene, packing.placed);
}

void put_tools_on(Scene& scene, const schema::Origins& origins, Problems& problems) {
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    if (!scene.tools[t].on_packing) continue;
    if (scene.packings.empty()) {
      const std::string key = fmt::format("tool[{}].point", t);
      problems.add(origins.at(key), key,
                   "there is no packing to rest on, allowed: a [[packing]], "
                   "or a quantity in m");
      continue;
    }
    ToolSpec& tool = scene.tools[t];
    const double rise = top_of_packings(scene) - tool.point.y();
    for (Vec2& p : tool.points) p.y() += rise;  // for a drawn one
    tool.point.y() += rise;
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

}  // namespace pulvis
