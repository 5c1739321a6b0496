#include "scenes/checks/servo_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/body.hpp"
#include "components/cell.hpp"
#include "components/contact.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "engine/entry.hpp"
#include "scenes/results/parts/visit_particles.hpp"
#include "systems/tools/servo_kernel.hpp"

namespace pulvis {
namespace {

constexpr double usual_passages = 50;
constexpr double never_judged = 1;  // -, tolerance from which on a scene does not ask for its force

using Servo = ToolServos::Servo;
constexpr double infinite = std::numeric_limits<double>::infinity();

// ---- gaps in the powder ---------------------------------------------------------------------------
struct Interval {
  double low = infinite, high = -infinite;  // m, along a direction
};

double along(const double* of_tool, const Point3& direction) {
  return of_tool[0] * direction[0] + of_tool[1] * direction[1] + of_tool[2] * direction[2];
}

template <class D>
Interval interval_of(const Lane* nodes, std::size_t count, int lane, const Point3& direction) {
  Interval extent;
  for (std::size_t n = 0; n < count; ++n) {
    double at = 0;
    for (std::size_t k = 0; k < D::axes; ++k) at += nodes[D::axes * n + k][lane] * direction[k];
    extent = {std::min(extent.low, at), std::max(extent.high, at)};
  }
  return extent;
}

template <class D>
std::vector<Interval> extents_along(const World& world, const Point3& direction) {
  std::vector<Interval> all;
  const Lane* nodes = world.column<Position<D>>().lanes();
  visit_particles<D>(world, [&](std::size_t first, int lane, const auto& shape) {
    all.push_back(interval_of<D>(nodes + D::axes * first, shape.nodes.size(), lane, direction));
  });
  return all;
}

// Tools whose faces support the powder against the force; what is behind them does not count.
void add_supports(const World& world, const Point3& direction, std::vector<Interval>& all) {
  const double* normals = world.column<ToolNormal>().values();
  const double* positions = world.column<ToolPosition>().values();
  for (std::size_t t = 0; t < world.column<ToolNormal>().table.rows; ++t)
    if (along(normals + tool_axes * t, direction) < -0.999)
      all.push_back({along(positions + tool_axes * t, direction), infinite});
}

// m, of all sections beyond `begin` that none of the extents covers.
double uncovered(std::vector<Interval> extents, double begin) {
  std::ranges::sort(extents, {}, &Interval::low);
  double gaps = 0;
  for (const Interval& extent : extents) {
    gaps += std::max(0.0, extent.low - begin);
    begin = std::max(begin, extent.high);
  }
  return gaps;
}

// Whether the gaps are those of the start, and nothing but this servo closes them.
bool closes_gaps_alone(const World& world, const Servo& servo) {
  const auto of_stage = [&](const auto& of) { return of.stage == servo.stage; };
  return servo.stage == 0 && world.has<ToolNormal>() &&
         std::ranges::count_if(world.resource<ToolServos>().servos, of_stage) == 1 &&
         std::ranges::none_of(world.resource<ToolProgram>().segments, of_stage);
}

// m. Only for flat faces: others have no single distance from the powder.
double gaps_before(const World& world, const Servo& servo) {
  if (!closes_gaps_alone(world, servo)) return 0;
  const std::size_t row = tool_axes * static_cast<std::size_t>(servo.tool);
  if (along(world.column<ToolNormal>().values() + row, servo.direction) < 0.999) return 0;
  std::vector<Interval> extents = world.has<Position<ThreeD>>()
                                      ? extents_along<ThreeD>(world, servo.direction)
                                      : extents_along<TwoD>(world, servo.direction);
  add_supports(world, servo.direction, extents);
  return uncovered(std::move(extents),
                   along(world.column<ToolPosition>().values() + row, servo.direction));
}

// ---- servos of tools ------------------------------------------------------------------------------
const StageSpec& stage_of(const Scene& scene, int stage) { return entry(scene.stages, stage); }

// N, of the tool's servo in the stage before.
double force_before(const ToolServos& servos, const Servo& servo) {
  for (const Servo& other : servos.servos)
    if (other.tool == servo.tool && other.stage == servo.stage - 1) return std::abs(other.force);
  return 0;
}

// A force that falls, or stays, needs no approach; a stage with `until` ends when its condition is met.
bool approaches(const Scene& scene, const ToolServos& servos, const Servo& servo) {
  return servo.holds_force() && servo.tolerance < never_judged &&
         !stage_of(scene, servo.stage).until && std::abs(servo.force) > force_before(servos, servo);
}

std::string told_passages(double duration, double passage) {
  return fmt::format(
      "the stage lasts {:.3g} passages of an elastic wave through the powder, {:.2g} s each",
      duration / passage, passage);
}

std::string told_gaps(double gaps, double speed) {
  return gaps > 0 ? fmt::format(
                        "; gaps of {:.3g} m in all have to close first, at up to {:.2g} m/s in "
                        "{:.2g} s",
                        gaps, speed, gaps / speed)
                  : "";
}

std::string servo_warning(const Scene& scene, const World& world, const Servo& servo) {
  const StageSpec& stage = stage_of(scene, servo.stage);
  const double passage = servo.powder_mass / servo.wave;
  const double speed = std::min(servo.max_speed, 2 * std::abs(servo.force) / servo.wave);
  const double gaps = gaps_before(world, servo);
  const double needed = gaps / speed + usual_passages * passage;
  if (stage.duration >= needed) return "";
  return fmt::format(
      "stage '{}': tool '{}' may not reach {:.4g} N: {}{}, and the approach of a force servo takes "
      "about {:g} passages: use a longer stage: at least {:.2g} s",
      stage.name, entry(world.resource<ToolProgram>().names, servo.tool), servo.force,
      told_passages(stage.duration, passage), told_gaps(gaps, speed), usual_passages, needed);
}

// ---- cells and dies that are driven by stresses ---------------------------------------------------
bool asks_for_more(const MixedControl& control, std::size_t stage) {
  const MixedControl::Stage& asked = control.stages[stage];
  if (!asked.holds_stress() || asked.tolerance >= never_judged ||
      asked.stress == decltype(asked.stress){})
    return false;
  const MixedControl::Stage before = stage > 0 ? control.stages[stage - 1] : MixedControl::Stage{};
  return asked.law != before.law || asked.stress != before.stress;
}

// s: m_p/Z, from inertia and dashpot of the servo (scenes/tools/cell.cpp).
double passage_of(const MixedControl::Stage& asked, const CellDriveSpec& drive) {
  const double share = drive.response / (1 + kernels::dragged_mass);
  return 0.5 * std::sqrt(kernels::dragged_mass / share) * asked.mass / asked.damping;
}

std::string cell_warning(const Scene& scene, const MixedControl& control, std::size_t number) {
  const StageSpec& stage = scene.stages[number];
  if (!stage.cell || stage.until || !asks_for_more(control, number)) return "";
  const double passage = passage_of(control.stages[number], *stage.cell);
  const double needed = usual_passages * passage;
  if (stage.duration >= needed) return "";
  return fmt::format(
      "stage '{}': stresses may not be reached: {}, and their control takes about {:g} passages: "
      "use a longer stage: at least {:.2g} s",
      stage.name, told_passages(stage.duration, passage), usual_passages, needed);
}

}  // namespace

std::vector<std::string> servo_warnings(const Scene& scene, const World& world) {
  std::vector<std::string> lines;
  if (world.has<ToolServos>()) {
    const ToolServos& servos = world.resource<ToolServos>();
    for (const Servo& servo : servos.servos)
      if (approaches(scene, servos, servo)) lines.push_back(servo_warning(scene, world, servo));
  }
  if (const MixedControl* control = mixed_control_of(world))
    for (std::size_t s = 0; s < control->stages.size(); ++s)
      lines.push_back(cell_warning(scene, *control, s));
  std::erase(lines, "");
  return lines;
}

}  // namespace pulvis
