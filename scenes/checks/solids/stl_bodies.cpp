#include "scenes/checks/solids/stl_bodies.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/distance.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <utility>

#include "engine/portable_math.hpp"
#include "scenes/meshes/hexahedra/stl.hpp"
#include "scenes/tools/surfaces/flat_triangles.hpp"

namespace pulvis::space {
namespace {

constexpr double single_precision = 1e-6;  // of the largest coordinate: binary files have floats

using Corner3 = std::array<double, 3>;
Corner3 corner_of(const Vec3& p) { return {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0}; }  // -0 is 0

std::string place_of(const Vec3& p) {
  return fmt::format("({:g}, {:g}, {:g})", p.x(), p.y(), p.z());
}

constexpr const char* allowed =
    "allowed: bodies with gaps between them; parts that touch must be one body";

// Connected triangles.
struct Shell {
  std::vector<Triangle> triangles;
  Eigen::AlignedBox3d box;
  double turns(const Vec3& around) const;  // of the surface: 1 in its inside, if it faces outwards
};

// Van Oosterom & Strackee 1983: the solid angle of a triangle.
double Shell::turns(const Vec3& around) const {
  if (!box.contains(around)) return 0;
  double sum = 0;
  for (const Triangle& t : triangles) {
    const Vec3 a = t[0] - around, b = t[1] - around, c = t[2] - around;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += portable::atan2(a.dot(b.cross(c)),
                           la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (2 * std::numbers::pi);
}

// Triangles that share an edge belong to the same shell.
class Shells {
 public:
  explicit Shells(const std::vector<Triangle>& triangles) : parent_(triangles.size()) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) join(t, triangles[t][k], triangles[t][(k + 1) % 3]);
    std::map<std::size_t, std::size_t> number;  // by first triangle
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto [found, fresh] = number.try_emplace(root(t), list.size());
      if (fresh) list.emplace_back();
      Shell& shell = list[found->second];
      shell.triangles.push_back(triangles[t]);
      for (const Vec3& p : triangles[t]) shell.box.extend(p);
    }
  }
  std::vector<Shell> list;

 private:
  struct Edge {
    std::size_t first;
    int count = 0;
  };
  std::size_t root(std::size_t t) {
    while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
    return t;
  }
  void join(std::size_t t, const Vec3& from, const Vec3& to) {
    Edge& edge =
        edges_.try_emplace(std::minmax(corner_of(from), corner_of(to)), Edge{t}).first->second;
    if (++edge.count > 2)
      throw BadStl(
          fmt::format("more than two triangles meet at the edge from {} to {}: bodies "
                      "touch there, or a surface is given twice, {}",
                      place_of(from), place_of(to), allowed));
    parent_[root(t)] = root(edge.first);
  }

  std::vector<std::size_t> parent_;
  std::map<std::pair<Corner3, Corner3>, Edge> edges_;
};

using Model = fcl::BVHModel<fcl::OBBRSSd>;

// In units of `size`, as distances of this library have absolute tolerances.
std::shared_ptr<Model> model_of(const Shell& shell, double size) {
  auto model = std::make_shared<Model>();
  model->beginModel(static_cast<int>(shell.triangles.size()));
  for (const Triangle& t : shell.triangles)
    model->addTriangle(t[0] / size, t[1] / size, t[2] / size);
  model->endModel();
  return model;
}

class Bodies {
 public:
  explicit Bodies(std::vector<Shell> shells) : shells_(std::move(shells)) {
    for (const Shell& shell : shells_)
      size_ = std::max(
          {size_, shell.box.min().cwiseAbs().maxCoeff(), shell.box.max().cwiseAbs().maxCoeff()});
    std::ranges::sort(shells_, {}, [](const Shell& shell) { return shell.box.min().x(); });
    models_.resize(shells_.size());
  }

  void run() {
    const Vec3 margin = Vec3::Constant(single_precision * size_);
    for (std::size_t i = 0; i < shells_.size(); ++i) {
      const Eigen::AlignedBox3d wide(shells_[i].box.min() - margin, shells_[i].box.max() + margin);
      for (std::size_t k = i + 1; k < shells_.size() && shells_[k].box.min().x() <= wide.max().x();
           ++k)
        if (wide.intersects(shells_[k].box)) apart(i, k);
    }
    for (std::size_t i = 0; i < shells_.size(); ++i) in_its_place(i);
  }

 private:
  Model* model(std::size_t i) {
    if (!models_[i]) models_[i] = model_of(shells_[i], size_);
    return models_[i].get();
  }
  void apart(std::size_t i, std::size_t k) {
    const fcl::Transform3d here = fcl::Transform3d::Identity();
    const fcl::DistanceRequestd request(true);
    fcl::DistanceResultd result;
    if (fcl::distance(model(i), here, model(k), here, request, result) > single_precision) return;
    throw BadStl(fmt::format("two bodies touch or overlap at the triangle at {}, {}",
                             place_of(shells_[i].triangles[static_cast<std::size_t>(result.b1)][0]),
                             allowed));
  }
  // A surface of a body lies outside of the others, the wall of a cavity inside one of them.
  void in_its_place(std::size_t i) const {
    const Vec3& corner = shells_[i].triangles[0][0];
    double around = 0;
    for (std::size_t k = 0; k < shells_.size(); ++k)
      if (k != i) around += shells_[k].turns(corner);
    const bool outwards = volume_of(shells_[i].triangles) > 0;
    if (std::abs(around - (outwards ? 0 : 1)) < 0.5) return;
    throw BadStl(fmt::format(
        "the surface at {} {}, {}", place_of(corner),
        outwards ? "lies inside another body" : "faces inwards, but is not the wall of a cavity",
        allowed));
  }

  std::vector<Shell> shells_;
  std::vector<std::shared_ptr<Model>> models_;
  double size_ = 0;
};

}  // namespace

void refuse_touching_bodies(const std::vector<std::array<Vec3, 3>>& triangles) {
  Bodies(Shells(without_flat_triangles(triangles)).list).run();
}

}  // namespace pulvis::space
