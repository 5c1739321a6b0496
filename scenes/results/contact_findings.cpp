#include "scenes/results/contact_findings.hpp"

#include <algorithm>
#include <cmath>

#include "components/contact.hpp"
#include "scenes/spec/elastic_response.hpp"

namespace pulvis {
namespace {

constexpr double stiffest = 100;    // largest value that a scene may have
constexpr double hard = 1000;       // largest hardness that a scene may have: nothing indents
constexpr double min_force = 1e-3;  // of the largest: below it an approach has no meaning

// y at x, of a curve with ascending xs; 0 before its start.
double value_at(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  const auto after = std::ranges::lower_bound(xs, x);
  if (after == xs.begin() || after == xs.end()) return after == xs.end() ? ys.back() : 0;
  const auto i = static_cast<std::size_t>(after - xs.begin());
  return ys[i - 1] + (ys[i] - ys[i - 1]) * (x - xs[i - 1]) / (xs[i] - xs[i - 1]);
}

}  // namespace

ContactLoading::ContactLoading(const Scene& scene)
    : in_space_(scene.in_space()),
      indents_(scene.contact.hardness && *scene.contact.hardness < hard),
      stiffness_(scene.contact.stiffness) {
  using Kind = StageSpec::Kind;
  bool loads = true;
  for (const StageSpec& stage : scene.stages) {
    loads &= stage.kind == Kind::settle || stage.kind == Kind::compact || stage.kind == Kind::hold;
    loads_.push_back(loads);
  }
}

bool ContactLoading::loads(const World& world) const {
  if (!world.has<ToolProgram>() || !world.has<ContactQuality>()) return false;
  const std::size_t stage = world.resource<ToolProgram>().stage_at(world.resource<Clock>().time);
  return stage < loads_.size() ? loads_[stage] : loads_.back();
}

void ContactLoading::sample(const Results& results, const World& world) {
  if (!loads(world)) return;
  const ContactQuality& now = world.resource<ContactQuality>();
  if (now.force > heaviest_.force) heaviest_ = now;
  if (!world.has<ToolForce>() || world.column<ToolForce>().table.rows == 0) return;
  const double penetration_work = in_space_ ? 2 * results.energies().contact : now.penetration_work;
  const double work = results.energies().external - work_, force = results.load();
  work_ = results.energies().external;
  const double mean = force_.empty() ? force : 0.5 * (force + force_.back());
  const double before = approach_.empty() ? 0 : approach_.back();
  approach_.push_back(before + (mean > 0 ? std::max(work, 0.0) / mean : 0));
  force_.push_back(force);
  sunk_.push_back(force > 0 ? penetration_work / force : 0);
}

std::optional<double> ContactLoading::force_error() const {
  if (force_.empty()) return std::nullopt;
  const auto peak = static_cast<std::size_t>(std::ranges::max_element(force_) - force_.begin());
  if (!(force_[peak] > 0) || peak == 0) return std::nullopt;
  // The tools did not do this work: bodies with initial velocity did.
  if (!(approach_[peak] > sunk_[peak])) return std::nullopt;
  std::vector<double> approaches, forces;
  for (std::size_t i = 0; i <= peak; ++i) {
    if (force_[i] < min_force * force_[peak]) continue;
    if (!approaches.empty() && approach_[i] <= approaches.back()) continue;
    approaches.push_back(approach_[i]);
    forces.push_back(force_[i]);
  }
  return value_at(approaches, forces, approach_[peak] - sunk_[peak]) / force_[peak] - 1;
}

ContactFindings ContactLoading::findings() const {
  ContactFindings found;
  found.stiffness = stiffness_;
  found.indents = indents_;
  found.force_error = force_error();
  if (!(heaviest_.force > 0)) return found;
  found.narrow_share = heaviest_.narrow_force / heaviest_.force;
  if (!(heaviest_.narrow_force > 0)) return found;
  found.narrow_edges = heaviest_.narrow_edges / heaviest_.narrow_force;
  found.edge_to_do = heaviest_.narrow_width / heaviest_.narrow_force / ContactQuality::min_edges;
  return found;
}

// Penetrations are proportional to 1/stiffness.
double ContactFindings::stiffness_to_do() const {
  return std::min(std::max(stiff_contacts, 4 * stiffness), stiffest);
}

}  // namespace pulvis
