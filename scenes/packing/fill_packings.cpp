#include "scenes/packing/fill_packings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <type_traits>

#include "engine/activity.hpp"
#include "scenes/packing/die_filling.hpp"
#include "scenes/packing/mixture.hpp"
#include "scenes/packing/packed_outlines.hpp"
#include "scenes/packing/packed_solids.hpp"
#include "scenes/packing/packing_file.hpp"
#include "scenes/packing/place.hpp"

namespace pulvis {
namespace {

template <class D>
using Packed = std::conditional_t<D::axes == 2, PackedOutlines, space::PackedSolids>;

// The class of particles whose size differs from that of their own class; one class per size.
template <class D>
int class_of_size(std::vector<ParticleSpec>& particles, int particle, double scale) {
  if (scale == 1) return particle;
  int number = 1;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    if (particles[p].class_of != particle) continue;
    if (particles[p].scale == scale) return static_cast<int>(p);
    ++number;
  }
  ParticleSpec spec = particles[static_cast<std::size_t>(particle)];
  spec.class_of = particle;
  spec.scale = scale;
  Packed<D>::resize(spec, scale);
  spec.name += fmt::format("#{}", number);  // a character that names in scenes cannot contain
  particles.push_back(spec);
  return static_cast<int>(particles.size()) - 1;
}

struct Side {
  const char* key;
  double width;  // m
};
Side narrowest_side(const ContainerSpec& in) {
  if (in.kind == ContainerSpec::Kind::cylinder) return {".diameter", in.diameter};
  const bool is_deep = in.depth == 0 || in.width <= in.depth;  // 0: in two dimensions
  return is_deep ? Side{".width", in.width} : Side{".depth", in.depth};
}

template <class D>
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
    const double floor = Packed<D>::container(scene_, packing_.container, 1).floor();
    const Mixture mixture = mixture_wanted(floor);
    if (mixture.count == 0) return;
    unit_ = Packed<D>::mean_diameter(mixture.content, mixture.count);
    for (const MixtureSize& size : mixture.sizes) add(size);
    order_.container = Packed<D>::container(scene_, packing_.container, unit_);
    if (!everything_fits()) return;
    const double full = mixture.content / floor;  // height at a density of 1
    if (packing_.density) order_.min_height = full / *packing_.density / unit_;
    if (packing_.height) order_.min_height = *packing_.height / unit_;
    order_.shaken = packing_.dense != PackingSpec::Dense::touching;
    const Activity packing(fmt::format("random packing of {} particles", mixture.count));
    const FilledDie<D> die = fill_die(order_);
    if (die.min_gap < 0) return refuse_die();
    if (order_.min_height > 0 && die.height > order_.min_height)
      return refuse_density(full / (order_.min_height * unit_), full / (die.height * unit_));
    place(die);
    packing_.reached = {full / (die.height * unit_), die.mean_gap, die.min_gap * unit_,
                        die.touches};
    packing_.top = packing_.container.corner[Packed<D>::up] + die.height * unit_;
    if (scene_.cell) scene_.cell->height = die.height * unit_;
  }

 private:
  const ParticleSpec& particle(int number) const {
    return scene_.particles[static_cast<std::size_t>(number)];
  }

  Mixture mixture_wanted(double floor) {
    const MixtureOrder order{packing_.classes,
                             packing_.count,
                             packing_.density,
                             packing_.height,
                             packing_.dense != PackingSpec::Dense::given,
                             floor,
                             D::axes,
                             scene_.file.parent_path(),
                             [&](const MixtureClass& mixed) {
                               return Packed<D>::measure(particle(mixed.particle),
                                                         mixed.size.kind == SizeLaw::Kind::mono);
                             }};
    return mixture_of(order, path_, origins_, problems_);
  }

  void add(const MixtureSize& size) {
    const int number = class_of_size<D>(scene_.particles, size.particle, size.scale);
    order_.shapes.push_back(Packed<D>::shape(particle(number), unit_));
    classes_.push_back(number);
    order_.shape_of.insert(order_.shape_of.end(), static_cast<std::size_t>(size.count),
                           static_cast<int>(order_.shapes.size()) - 1);
  }

  document::Origin origin(const std::string& key) const {
    const auto found = origins_.find(origins_.contains(path_ + key) ? path_ + key : path_);
    return found == origins_.end() ? document::Origin{{1, 1}, -1} : found->second;
  }

  // A particle must fit through in some orientation.
  bool everything_fits() {
    constexpr double exact = 1 - 1e-12;
    const Side side = narrowest_side(packing_.container);
    for (const int number : classes_) {
      const double least = Packed<D>::least_width(particle(number));
      const bool wide = least >= exact * side.width;
      if (!wide && (!packing_.height || least < *packing_.height)) continue;
      const std::string key = wide ? side.key : ".height";
      problems_.add(
          origin(key), path_ + key,
          fmt::format("'{}' is {:g} m wide and does not fit into the die, allowed: > {:g} m",
                      particle(number).name, least, least));
      return false;
    }
    return true;
  }

  // Some overlapped, however high the die.
  void refuse_die() {
    const bool round = packing_.container.kind == ContainerSpec::Kind::cylinder;
    const std::string key = round ? ".diameter" : ".width";
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

  void place(const FilledDie<D>& die) {
    for (std::size_t i = 0; i < die.poses.size(); ++i) {
      const auto shape = static_cast<std::size_t>(order_.shape_of[i]);
      BodySpec body = Packed<D>::placed(scene_, packing_.container, order_.shapes[shape],
                                        die.poses[i], die.height, unit_);
      body.particle = classes_[shape];
      body.mark = packing_.mark;
      packing_.placed.push_back(body);
    }
  }

  Scene& scene_;
  PackingSpec& packing_;
  std::string path_;
  const schema::Origins& origins_;
  Problems& problems_;
  DieFilling<D> order_;
  std::vector<int> classes_;  // of the shapes
  double unit_ = 1;           // m, the mean diameter
};

template <class D>
double highest_point(const Scene& scene, const std::vector<BodySpec>& bodies) {
  double highest = std::numeric_limits<double>::lowest();
  std::map<int, typename Packed<D>::Reach> reaches;  // by class
  for (const BodySpec& body : bodies) {
    const auto& reach = reaches.try_emplace(body.particle, scene.class_of(body)).first->second;
    highest = std::max(highest, body.position[Packed<D>::up] + reach.upwards(body));
  }
  return highest;
}

template <class D>
void read_file(Scene& scene, PackingSpec& packing) {
  const FiledPacking filed = read_packing(scene.file.parent_path() / packing.file, scene);
  for (const FiledParticle& particle : filed.particles) {
    BodySpec body = particle.body;
    body.particle = class_of_size<D>(scene.particles, body.particle, particle.scale);
    body.mark = packing.mark;
    packing.placed.push_back(body);
  }
  packing.top = filed.top ? *filed.top : highest_point<D>(scene, packing.placed);
}

template <class D>
void put_tools_on(Scene& scene, const schema::Origins& origins, Problems& problems) {
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    if (!scene.tools[t].on_packing) continue;
    if (scene.packings.empty()) {
      const std::string key = fmt::format("tool[{}].point", t);
      problems.add(origins.at(key), key,
                   "there is no packing to rest on, allowed: a [[packing]], or a quantity in m");
      continue;
    }
    Packed<D>::put_on(scene.tools[t], top_of_packings(scene));
  }
}

template <class D>
void fill(Scene& scene, const schema::Origins& origins, Problems& problems) {
  for (std::size_t i = 0; i < scene.packings.size(); ++i) {
    PackingSpec& packing = scene.packings[i];
    if (packing.kind == PackingSpec::Kind::random)
      RandomPacking<D>(scene, i, origins, problems).run();
    else if (packing.kind == PackingSpec::Kind::csv)
      read_file<D>(scene, packing);
    else
      packing.top = top_of_lattice(packing);
  }
  put_tools_on<D>(scene, origins, problems);
}

}  // namespace

void fill_packings(Scene& scene, const schema::Origins& origins, Problems& problems) {
  scene.in_space() ? fill<ThreeD>(scene, origins, problems) : fill<TwoD>(scene, origins, problems);
}

}  // namespace pulvis
