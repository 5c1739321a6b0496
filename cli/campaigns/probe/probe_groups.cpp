#include "cli/campaigns/probe/probe_groups.hpp"

namespace pulvis {

ProbeGroup::ProbeGroup(std::string path, double asked, std::vector<const ProbeSurface*> surfaces)
    : path_(std::move(path)), asked_(asked), surfaces_(std::move(surfaces)) {
  const auto n = static_cast<double>(surfaces_.size());
  ProbedPowder powder = surfaces_.front()->powder();
  powder.relative_density = density();
  powder.loaded.setZero();
  powder.centre.setZero();
  for (const ProbeSurface* surface : surfaces_) {
    powder.loaded += surface->state->stress / n;
    powder.centre += surface->centre / n;
  }
  for (std::size_t i = 0; i < criteria.size(); ++i)
    models_[i] = fit_caps(pooled(criteria[i]), powder);
}

double ProbeGroup::mean(const std::function<double(const ProbeSurface&)>& of) const {
  double sum = 0;
  for (const ProbeSurface* surface : surfaces_) sum += of(*surface);
  return sum / static_cast<double>(surfaces_.size());
}

double ProbeGroup::density() const {
  return mean([](const ProbeSurface& s) { return s.state->density; });
}

std::vector<YieldPoint> ProbeGroup::pooled(const Criterion& criterion) const {
  std::vector<YieldPoint> all;
  for (const ProbeSurface* surface : surfaces_)
    all.insert(all.end(), (surface->*criterion.points).begin(), (surface->*criterion.points).end());
  return all;
}

const std::vector<FittedModel>& ProbeGroup::fits(const Criterion& criterion) const {
  return models_[static_cast<std::size_t>(&criterion - criteria.data())];
}

std::vector<ProbeGroup> groups_of(const Probe& probe, const std::vector<ProbeSurface>& surfaces) {
  std::vector<ProbeGroup> groups;
  for (const std::string& history : probe.histories)
    for (const double density : probe.spec.densities) {
      std::vector<const ProbeSurface*> mine;
      for (const ProbeSurface& surface : surfaces)
        if (surface.state->loading->history == history && surface.state->asked == density &&
            surface.moduli.known())
          mine.push_back(&surface);
      if (!mine.empty()) groups.emplace_back(history, density, std::move(mine));
    }
  return groups;
}

}  // namespace pulvis
