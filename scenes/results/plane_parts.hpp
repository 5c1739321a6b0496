// Results in two dimensions.
#pragma once

#include "engine/world.hpp"
#include "scenes/results/parts/result_parts.hpp"
#include "scenes/results/tool_outlines.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis {

class PlaneParts : public ResultParts {
 public:
  // `tags`: scenes/results/particle_tags.hpp
  PlaneParts(const Scene& scene, const World& world, std::vector<ParticleTag> tags);

  RunMesh mesh() const override;
  std::optional<FieldInfo> tool_field() const override;
  std::vector<double> tool_points() const override { return outlines_.points(world_); }
  double powder() const override { return particle_area_; }
  double volume() const override;
  std::int64_t elements() const override { return elements_; }

 private:
  const World& world_;
  double particle_area_ = 0;
  std::int64_t elements_ = 0;
  std::vector<ParticleTag> tags_;
  ToolOutlines outlines_;
};

}  // namespace pulvis
