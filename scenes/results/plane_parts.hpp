// Results in two dimensions.
#pragma once

#include <optional>

#include "engine/world.hpp"
#include "scenes/results/parts/result_parts.hpp"
#include "scenes/results/tool_outlines.hpp"
#include "scenes/spec/scene.hpp"
#include "scenes/tools/die_cell.hpp"

namespace pulvis {

class PlaneParts : public ResultParts {
 public:
  PlaneParts(const Scene& scene, const World& world);

  RunMesh mesh() const override;
  std::vector<FieldInfo> fields() const override;
  std::vector<FieldInfo> tool_fields() const override;
  void append_frame(Fields& fields) const override;
  void append_tool_frame(Fields& fields) const override;
  void append_tools(const Energies& energies, std::vector<double>& row) const override;
  void append_contacts(std::vector<double>& row) const override;
  void append_observed(std::vector<double>& row) const override;
  std::vector<double> momentum() const override;
  double volume() const override;
  std::int64_t elements() const override { return elements_; }

 private:
  Vec2 die_size() const;  // m, width and height between the tools; only with a cell
  void append_positions(std::vector<double>& row) const;
  void append_density(std::vector<double>& row) const;
  void append_cell(const Energies& energies, std::vector<double>& row) const;
  double enclosed_area() const;

  const World& world_;
  std::optional<DieCell> cell_;
  std::optional<double> yield_stress_;  // where all particles share one value
  double particle_area_ = 0;
  std::int64_t elements_ = 0;
  std::vector<ParticleTag> tags_;
  ToolOutlines outlines_;
  std::vector<FieldInfo> fields_;
};

}  // namespace pulvis
