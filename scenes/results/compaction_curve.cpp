#include "scenes/results/compaction_curve.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/tools/contact_rules.hpp"

namespace pulvis {
namespace {

constexpr int pieces = 8;  // of the loading, of equal change of density
constexpr double min_force_share =
    0.01;  // of the largest: before that the punch touches nothing yet

struct Walls {
  double friction = 0, poissons_ratio = 0;
  std::string unlike;  // why there is no single number for them
};

// What the formulas put in; they know one powder between two walls.
Walls walls_of(const Scene& scene, const DieCell& cell) {
  Walls walls;
  const std::string left = scene.tools[static_cast<std::size_t>(cell.left)].name;
  const std::string right = scene.tools[static_cast<std::size_t>(cell.right)].name;
  for (const MaterialSpec& m : scene.materials) {
    const double both = friction_of(scene, left, m.name).coefficient +
                        friction_of(scene, right, m.name).coefficient;
    const bool first = &m == &scene.materials.front();
    if (!first && (0.5 * both != walls.friction || m.poissons_ratio != walls.poissons_ratio))
      walls.unlike = "materials differ in wall friction or Poisson's ratio";
    walls.friction = 0.5 * both;
    walls.poissons_ratio = m.poissons_ratio;
  }
  return walls;
}

TransmissionShare mean_transmission(const std::vector<CompactionSample>& samples) {
  TransmissionShare share;
  const double count = static_cast<double>(samples.size());
  double top = 0, bottom = 0, lateral_stress = 0, axial_stress = 0;
  for (const CompactionSample& s : samples) {
    top += s.top;
    bottom += s.bottom;
    axial_stress += 0.5 * (s.top + s.bottom) / s.width;
    lateral_stress += s.lateral / s.height;
    share.density += s.density / count;
    share.height_over_width += s.height / s.width / count;
  }
  share.measured = bottom / top;
  share.lateral_ratio = lateral_stress / axial_stress;
  return share;
}

void lay_beside(TransmissionShare& share, double mu, double nu) {
  const double slenderness = share.height_over_width, elastic = nu / (1 - nu);
  share.round_die = std::exp(-4 * mu * elastic * slenderness);
  share.slot = std::exp(-2 * mu * elastic * slenderness);
  share.slot_measured_ratio = std::exp(-2 * mu * share.lateral_ratio * slenderness);
}

// The loading under force, in pieces of equal change of density.
std::vector<std::vector<CompactionSample>> loading(const std::vector<CompactionSample>& samples) {
  const auto last = std::ranges::max_element(samples, {}, &CompactionSample::density);
  double maximum = 0;
  for (auto s = samples.begin(); s != last + 1; ++s) maximum = std::max(maximum, s->top);
  const auto first = std::find_if(samples.begin(), last, [&](const CompactionSample& s) {
    return s.top >= min_force_share * maximum;
  });
  std::vector<std::vector<CompactionSample>> found(pieces);
  const double low = first->density, width = (last->density - low) / pieces;
  if (!(maximum > 0) || !(width > 0)) return {};
  for (auto s = first; s != last + 1; ++s) {
    const int piece = std::clamp(static_cast<int>((s->density - low) / width), 0, pieces - 1);
    if (s->top > 0) found[static_cast<std::size_t>(piece)].push_back(*s);
  }
  std::erase_if(found, [](const auto& piece) { return piece.empty(); });
  return found;
}

}  // namespace

std::optional<double> wall_friction(const Scene& scene) {
  const std::optional<DieCell> cell = die_cell(scene);
  if (!cell) return std::nullopt;
  const Walls walls = walls_of(scene, *cell);
  return walls.unlike.empty() ? std::optional(walls.friction) : std::nullopt;
}

CompactionCurve::CompactionCurve(const Scene& scene)
    : cell_(die_cell(scene)), thickness_(scene.thickness) {
  if (!cell_) return;
  const auto name = [&](int tool) { return scene.tools[static_cast<std::size_t>(tool)].name; };
  left_ = name(cell_->left);
  right_ = name(cell_->right);
  bottom_ = name(cell_->bottom);
  top_ = name(cell_->top);
}

void CompactionCurve::sample(const Results& results) {
  if (!cell_) return;
  const auto of = [&](const std::string& tool, const char* what) {
    return results.value("tool/" + tool + "/" + what);
  };
  const double lateral = 0.5 * (of(right_, "force_x") - of(left_, "force_x"));
  const double place = of(bottom_, "position_y");
  samples_.push_back(
      {results.value("relative_density"), of(top_, "force_y"), -of(bottom_, "force_y"), lateral,
       of(right_, "position_x") - of(left_, "position_x"), of(top_, "position_y") - place, place});
}

std::vector<double> CompactionCurve::densities() const {
  std::vector<double> values;
  for (const CompactionSample& s : samples_) values.push_back(s.density);
  return values;
}

std::vector<double> CompactionCurve::punch_pressures() const {
  std::vector<double> values;
  for (const CompactionSample& s : samples_) values.push_back(s.top / (s.width * thickness_));
  return values;
}

Transmission transmission(const Scene& scene, const CompactionCurve& curve) {
  Transmission result;
  const auto pieces_of_loading = curve.samples().empty()
                                     ? std::vector<std::vector<CompactionSample>>{}
                                     : loading(curve.samples());
  if (pieces_of_loading.empty()) {
    result.not_measured = "the top punch does not press the powder";
    return result;
  }
  const Walls walls = walls_of(scene, *die_cell(scene));
  result.wall_friction = walls.friction;
  result.poissons_ratio = walls.poissons_ratio;
  result.not_compared = walls.unlike;
  const double place = curve.samples().front().bottom_place;
  const auto moved = [&](const CompactionSample& s) { return s.bottom_place != place; };
  if (std::ranges::any_of(curve.samples(), moved))
    result.not_compared =
        "the bottom punch moves: the powder does not slide from one end to the other";
  for (const auto& piece : pieces_of_loading) {
    result.shares.push_back(mean_transmission(piece));
    if (result.not_compared.empty())
      lay_beside(result.shares.back(), walls.friction, walls.poissons_ratio);
  }
  return result;
}

}  // namespace pulvis
