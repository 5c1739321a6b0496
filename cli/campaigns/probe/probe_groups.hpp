// Results of a probe pooled over the seeds of a path at a density.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "cli/campaigns/probe/probe_results.hpp"

namespace pulvis {

struct Criterion {
  const char* name;
  std::vector<YieldPoint> ProbeSurface::*points;
  std::vector<FittedModel> ProbeSurface::*models;
};
inline constexpr std::array criteria{
    Criterion{"offset_strain", &ProbeSurface::offset, &ProbeSurface::offset_models},
    Criterion{"dissipation", &ProbeSurface::dissipation, &ProbeSurface::dissipation_models}};
// Of the keyword blocks: where a powder comes apart, plastic strain grows but nothing is dissipated.
inline constexpr const Criterion& by_dissipation = criteria[1];

// All surfaces of a path at a density: one per seed.
class ProbeGroup {
 public:
  ProbeGroup(std::string path, double asked, std::vector<const ProbeSurface*> surfaces);

  const std::string& path() const { return path_; }
  double asked() const { return asked_; }  // -, relative density
  const std::vector<const ProbeSurface*>& surfaces() const { return surfaces_; }
  double mean(const std::function<double(const ProbeSurface&)>& of) const;
  double density() const;
  bool in_space() const { return surfaces_.front()->state->in_space(); }
  std::vector<YieldPoint> pooled(const Criterion& criterion) const;
  const std::vector<FittedModel>& fits(const Criterion& criterion) const;  // to the pooled points

 private:
  std::string path_;
  double asked_;
  std::vector<const ProbeSurface*> surfaces_;
  std::array<std::vector<FittedModel>, criteria.size()> models_ = {};
};

std::vector<ProbeGroup> groups_of(const Probe& probe, const std::vector<ProbeSurface>& surfaces);

}  // namespace pulvis
