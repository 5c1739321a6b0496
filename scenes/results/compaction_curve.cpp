#include "scenes/results/compaction_curve.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/spec/scene.hpp"
#include "scenes/tools/contact_rules.hpp"
#include "scenes/tools/die_room.hpp"

namespace pulvis {
namespace {

constexpr int pieces = 8;  // of the loading, each with an equal change of density
constexpr double min_force_share =
    0.01;  // of the largest: below it the punch is not in contact yet

struct Walls {
  double friction = 0, poissons_ratio = 0;
  std::string unlike;  // why there is no single value for them
};

// The tools at the sides of the die; empty where there is no die.
std::vector<std::string> names_of_walls(const Scene& scene) {
  if (!scene.in_space()) {
    const auto cell = die_cell(scene);
    if (!cell) return {};
    return {scene.tools[static_cast<std::size_t>(cell->left)].name,
            scene.tools[static_cast<std::size_t>(cell->right)].name};
  }
  const auto room = die_room(scene);
  std::vector<std::string> names;
  if (!room) return names;
  const auto add = [&](int tool) {
    names.push_back(scene.tools[static_cast<std::size_t>(tool)].name);
  };
  if (room->kind == DieRoom::Kind::round)
    add(room->die);
  else
    for (const auto side : {DieRoom::left, DieRoom::right, DieRoom::front, DieRoom::back})
      add(room->tool[side]);
  return names;
}

// Inputs of the formulas, which assume a single powder between its walls.
Walls walls_of(const Scene& scene) {
  const std::vector<std::string> names = names_of_walls(scene);
  Walls walls;
  for (const MaterialSpec& m : scene.materials) {
    double sum = 0;
    for (const std::string& name : names) sum += friction_of(scene, name, m.name).coefficient;
    const double mean = sum / static_cast<double>(names.size());
    const bool first = &m == &scene.materials.front();
    if (!first && (mean != walls.friction || m.poissons_ratio != walls.poissons_ratio))
      walls.unlike = "materials differ in wall friction or Poisson's ratio";
    walls.friction = mean;
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

// A square die has the same ratio of wall to cross-section as a round one.
void lay_beside(TransmissionShare& share, double mu, double nu, bool in_space) {
  const double slenderness = share.height_over_width, elastic = nu / (1 - nu);
  share.round_die = std::exp(-4 * mu * elastic * slenderness);
  if (in_space) return;
  share.slot = std::exp(-2 * mu * elastic * slenderness);
  share.slot_measured_ratio = std::exp(-2 * mu * share.lateral_ratio * slenderness);
}

// The loading while under force, in pieces of equal change of density.
std::vector<std::vector<CompactionSample>> loading(const std::vector<CompactionSample>& samples) {
  if (samples.empty()) return {};
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
  if (names_of_walls(scene).empty()) return std::nullopt;
  const Walls walls = walls_of(scene);
  return walls.unlike.empty() ? std::optional(walls.friction) : std::nullopt;
}

CompactionCurve::CompactionCurve(const Scene& scene)
    : cell_(die_cell(scene)), thickness_(scene.thickness) {
  if (scene.in_space()) {
    room_ = die_room(scene);
    thickness_ = 1;
    if (!room_) return;
    bottom_ = scene.tools[static_cast<std::size_t>(room_->tool[DieRoom::bottom])].name;
    top_ = scene.tools[static_cast<std::size_t>(room_->tool[DieRoom::top])].name;
  }
  if (!cell_) return;
  const auto name = [&](int tool) { return scene.tools[static_cast<std::size_t>(tool)].name; };
  left_ = name(cell_->left);
  right_ = name(cell_->right);
  bottom_ = name(cell_->bottom);
  top_ = name(cell_->top);
}

// The width of a box is that of a square of the same area.
void CompactionCurve::sample_room(const Results& results) {
  if (std::isnan(results.value("relative_density"))) return;  // the tools do not enclose the powder
  const auto place = [&](const std::string& tool) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum +=
          results.value("tool/" + tool + "/position_" + std::string(1, "xyz"[k])) * room_->axis[k];
    return sum;
  };
  const double bottom = place(bottom_), height = place(top_) - bottom;
  const auto at = [&](int tool, int k) { return results.tool_position(tool, k); };
  const bool box = room_->kind == DieRoom::Kind::box;
  const double width = box ? std::sqrt(room_->area(at)) : room_->diameter;
  double lateral = box ? 0 : height * results.value("stress/radial");
  if (box)
    for (const char* side : {"left", "right", "front", "back"})
      lateral += 0.25 * height * results.value(std::string("stress/radial_") + side);
  samples_.push_back({results.value("relative_density"), results.value("stress/axial_top") * width,
                      results.value("stress/axial_bottom") * width, lateral, width, height,
                      bottom});
}

void CompactionCurve::sample(const Results& results) {
  if (room_) return sample_room(results);
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
  const Walls walls = walls_of(scene);
  result.wall_friction = walls.friction;
  result.poissons_ratio = walls.poissons_ratio;
  result.not_compared = walls.unlike;
  const double place = curve.samples().front().bottom_place;
  const auto moved = [&](const CompactionSample& s) { return s.bottom_place != place; };
  if (std::ranges::any_of(curve.samples(), moved))
    result.not_compared =
        "the bottom punch moves: the powder does not slide along the wall in one direction";
  for (const auto& piece : pieces_of_loading) {
    result.shares.push_back(mean_transmission(piece));
    if (result.not_compared.empty())
      lay_beside(result.shares.back(), walls.friction, walls.poissons_ratio, curve.in_space());
  }
  return result;
}

}  // namespace pulvis
