#include "scenes/results/shear_results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/contact.hpp"
#include "components/run_state.hpp"
#include "components/servo.hpp"
#include "engine/access.hpp"
#include "engine/entry.hpp"
#include "scenes/results/observables/result_rows.hpp"
#include "scenes/tools/die_sides.hpp"
#include "systems/tools/systems.hpp"

namespace pulvis {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double straight = 1 - 1e-9;  // cosine between directions that count as parallel
constexpr double goes_along = 0.1;     // share of the target's speed by which a particle may lag
constexpr double least_shared = 0.02;  // of the normal force: a smaller lateral force has no shares
// Of the planned distance. The powder still settles from loading when the target starts: over a tiny distance that plastic
// work would count as an enormous force.
constexpr double least_ploughed = 0.02;
constexpr double static_share = 0.25;  // of the sliding distance, from its beginning
constexpr double dynamic_share = 0.5;  // of the sliding distance, to its end

Vec2 vector_of(const double* values, int tool) {
  return {values[tool_axes * tool], values[tool_axes * tool + 1]};
}

// The plane whose normal points in this direction; -1: none.
int plane_facing(const Scene& scene, const Vec2& direction) {
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    if (scene.tools[t].shape == ToolSpec::Shape::plane &&
        in_plane(scene.tools[t].normal).dot(direction) > straight)
      return static_cast<int>(t);
  return -1;
}

// Mean velocity of a particle's outline.
Vec2 velocity_of(const World& world, int slot) {
  const Bodies& bodies = world.resource<Bodies>();
  const Column<Velocity<TwoD>>& column = world.column<Velocity<TwoD>>();
  const auto first = static_cast<std::size_t>(
      column.table.chunk_begin[static_cast<std::size_t>(slot / lane_count)]);
  const int nodes = bodies.shape_of_slot(slot).boundary_nodes;
  Vec2 sum = Vec2::Zero();
  for (int n = 0; n < nodes; ++n) {
    const Lane* at = column.lanes() + 2 * (first + static_cast<std::size_t>(n));
    sum += Vec2(at[0][slot % lane_count], at[1][slot % lane_count]);
  }
  return sum / nodes;
}

// m: a stage that ends once the tool has moved far enough plans no more than that.
double planned_distance(const StageSpec& stage, int tool, double moved) {
  const bool ends_early = stage.until && stage.until->tool == tool && stage.until->displacement;
  return ends_early ? std::min(moved, *stage.until->displacement) : moved;
}

// The longest move in a stage along a tool's own face.
std::optional<ShearSetup> target_of(const Scene& scene, const StageSpec& stage) {
  std::optional<ShearSetup> target;
  double longest = 0;
  for (const MoveSpec& move : stage.moves) {
    const ToolSpec& tool = scene.tools[static_cast<std::size_t>(move.tool)];
    if (tool.shape == ToolSpec::Shape::constraint) continue;
    const Vec2 up = face_normal(tool);
    const Vec2 moved = in_plane(move.displacement);
    const Vec2 along = moved - moved.dot(up) * up;
    const bool presses_only = along.norm() < 1e-9 * move.displacement.norm();
    if (presses_only || along.norm() <= longest) continue;
    longest = along.norm();
    target.emplace();
    target->target = move.tool;
    target->up = up;
    target->along = along.normalized();
    target->planned = planned_distance(stage, move.tool, longest);
  }
  return target;
}

}  // namespace

std::optional<ShearSetup> shear_setup(const Scene& scene) {
  std::optional<ShearSetup> found;
  std::size_t stage = 0;
  for (; stage < scene.stages.size() && !found; ++stage)
    if (scene.stages[stage].kind == StageSpec::Kind::shear)
      found = target_of(scene, scene.stages[stage]);
  if (!found) return std::nullopt;
  ShearSetup setup = *found;
  setup.stage = static_cast<int>(stage) - 1;
  setup.punch = plane_facing(scene, -setup.up);
  setup.wall = plane_facing(scene, -setup.along);
  const int other = plane_facing(scene, setup.along);
  if (setup.wall >= 0 && other >= 0)
    setup.width = in_plane(scene.tools[static_cast<std::size_t>(setup.wall)].point -
                           scene.tools[static_cast<std::size_t>(other)].point)
                      .dot(setup.along);
  return setup;
}

void add_shear_series(const Scene& scene, Observables& all) {
  const auto setup = shear_setup(scene);
  if (!setup) return;
  const bool width = setup->width > 0, punch = setup->punch >= 0, wall = setup->wall >= 0;
  all.add(
      [](const Observation& now) -> const ShearSample& { return now.shear.now(); },
      {{"shear/distance", "m", "sliding distance $s$",
        "displacement of the target along itself since the first shear stage began",
        &ShearSample::distance},
       {"shear/friction", "-", "friction coefficient $\\mu$",
        "lateral over normal force on the target; NaN where it carries none",
        &ShearSample::friction},
       {"shear/work", "J", "work of the target $W$",
        "work of the target against friction and grooves", &ShearSample::work},
       {"shear/locked", "-", "particles moving with the target",
        "particles that touch the target and move with it, within 10%", &ShearSample::locked},
       {"shear/plastic_work", "J", "plastic work during shear $W_p$",
        "dissipated by plastic flow since the first shear stage began", &ShearSample::plastic_work},
       {"shear/ploughing", "-", "contribution of ploughing",
        "shear/plastic_work over the normal force on the target, integrated over the distance: "
        "contribution of ploughing to the mean coefficient; NaN before the target has moved by 2% "
        "of the distance planned for its first shear stage",
        &ShearSample::ploughing},
       {"shear/normal_stress", "Pa", "normal stress on the target $\\sigma_n$",
        "on the target: normal force / width x thickness", &ShearSample::normal_stress, width},
       {"shear/lateral_stress", "Pa", "shear stress on the target $\\tau$",
        "on the target, against its motion", &ShearSample::lateral_stress, width},
       {"shear/punch_lateral_stress", "Pa", "shear stress on the punch $\\tau$",
        "on the punch, along the target's motion", &ShearSample::punch_lateral_stress,
        width && punch},
       {"shear/dilation", "m", "dilation $\\Delta h$",
        "displacement of the punch away from the target since the first shear stage began",
        &ShearSample::dilation, punch},
       {"shear/wall_share", "-", "lateral force carried by the walls",
        "force on the wall that the powder is dragged against / lateral force on the "
        "target; NaN where the latter is zero",
        &ShearSample::wall_share, wall}});
}

void add_shear_fields(const Scene& scene, FrameFields& all) {
  if (!shear_setup(scene)) return;
  all.add({{{"target_slip", "m", "slip of the target $s$",
             "displacement of the target past the particle while they touch, since the first "
             "shear stage began, summed up over samples",
             FieldPlace::particle, 1},
            [](const Observation& now) { return now.shear.slip(); }}});
}

ShearResults::ShearResults(const Scene& scene, const World& world)
    : setup_(shear_setup(scene)), world_(world) {
  if (setup_) slip_.resize(static_cast<std::size_t>(world.resource<Bodies>().particles()));
}

const ToolProgram::Stage& ShearResults::stage() const {
  return entry(world_.resource<ToolProgram>().stages, setup_->stage);
}

// m, of the target along itself, due to servos and compliant drives.
double ShearResults::travel_now() const {
  if (!world_.has<ServoTravel>()) return 0;
  return vector_of(world_.column<ServoTravel>().values(), setup_->target).dot(setup_->along);
}

double ShearResults::distance_now() const {
  const ToolProgram& program = world_.resource<ToolProgram>();
  const double begin = stage().begin;
  const double time = world_.resource<Clock>().time;
  if (time <= begin) return 0;
  const Point3 now = tool_position_at(program, setup_->target, time);
  const Point3 then = tool_position_at(program, setup_->target, begin);
  const double driven = Vec2(now[0] - then[0], now[1] - then[1]).dot(setup_->along);
  return driven + travel_now() - travel_at_begin_;
}

int ShearResults::take_touching(bool sliding) {
  const Clock& clock = world_.resource<Clock>();
  const Bodies& bodies = world_.resource<Bodies>();
  const auto& pair = world_.column<ContactPair<ToolContact>>();
  const auto& touches = world_.column<ContactTouches<ToolContact>>();
  const double speed =
      vector_of(world_.column<ToolVelocity>().values(), setup_->target).dot(setup_->along);
  std::vector<int> touching;
  for (std::size_t r = 0; r < pair.table.rows; ++r) {
    const std::int32_t* row = pair.values() + 3 * r;
    if (touches.values()[r] != 0 && row[2] == setup_->target) touching.push_back(row[0]);
  }
  std::ranges::sort(touching);
  touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
  int locked = 0;
  for (const int slot : touching) {
    const double lag = speed - velocity_of(world_, slot).dot(setup_->along);
    const auto number =
        static_cast<std::size_t>(bodies.slots[static_cast<std::size_t>(slot)].number);
    if (sliding) slip_[number] += lag * (clock.time - time_before_);
    if (std::abs(lag) < goes_along * std::abs(speed)) locked += 1;
  }
  return locked;
}

void ShearResults::sample(double plastic) {
  if (!setup_) return;
  const double* forces = world_.column<ToolForce>().values();
  const Vec2 force = vector_of(forces, setup_->target);
  const double normal = -force.dot(setup_->up), lateral = -force.dot(setup_->along);
  if (world_.resource<Clock>().time <= stage().begin) travel_at_begin_ = travel_now();
  now_.distance = distance_now();
  now_.friction = normal > 0 ? lateral / normal : nothing;
  take_work(lateral, normal, plastic);
  now_.locked = take_touching(punch_at_begin_.has_value());
  if (setup_->width > 0) {
    const double face = setup_->width * world_.resource<Bodies>().thickness;
    now_.normal_stress = normal / face;
    now_.lateral_stress = lateral / face;
    if (setup_->punch >= 0)
      now_.punch_lateral_stress = vector_of(forces, setup_->punch).dot(setup_->along) / face;
  }
  if (setup_->punch >= 0) take_dilation();
  if (setup_->wall >= 0)
    now_.wall_share = lateral > least_shared * normal && lateral > 0
                          ? vector_of(forces, setup_->wall).dot(setup_->along) / lateral
                          : nothing;
  keep_of_stage(lateral, normal);
}

void ShearResults::take_work(double lateral, double normal, double plastic) {
  const double distance = now_.distance;
  work_ += 0.5 * (lateral + lateral_before_) * (distance - distance_before_);
  pressed_ += 0.5 * (normal + normal_before_) * std::abs(distance - distance_before_);
  if (distance > 0 && !punch_at_begin_) punch_at_begin_ = punch_before_;
  if (!punch_at_begin_) plastic_at_begin_ = plastic;
  now_.work = work_;
  now_.plastic_work = plastic - plastic_at_begin_;
  const double farthest = std::max(distance, samples_.empty() ? 0 : samples_.back().distance);
  const bool ploughs = farthest >= least_ploughed * setup_->planned && pressed_ > 0;
  now_.ploughing = ploughs ? now_.plastic_work / pressed_ : nothing;
}

void ShearResults::take_dilation() {
  const double* positions = world_.column<ToolPosition>().values();
  const double at = vector_of(positions, setup_->punch).dot(setup_->up);
  now_.dilation = punch_at_begin_ ? at - *punch_at_begin_ : 0;
  punch_before_ = at;
}

// Samples of the shear stage while the target moves on, and what the next sample refers to.
void ShearResults::keep_of_stage(double lateral, double normal) {
  const Clock& clock = world_.resource<Clock>();
  const double distance = now_.distance;
  const bool goes_on = distance > (samples_.empty() ? 0 : samples_.back().distance);
  if (goes_on && clock.time <= stage().end + clock.dt_before)
    samples_.push_back({distance, now_.friction, now_.normal_stress, now_.dilation});
  lateral_before_ = lateral;
  normal_before_ = normal;
  distance_before_ = distance;
  time_before_ = clock.time;
}

// Means are over distance, not over time.
std::optional<ShearFigures> ShearResults::figures() const {
  if (samples_.empty()) return std::nullopt;
  ShearFigures f;
  f.distance = samples_.back().distance;
  if (setup_->punch >= 0) f.dilation = samples_.back().dilation;
  double distance = 0, sum = 0, square = 0, stress = 0;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const Sample& s = samples_[i];
    if (std::isnan(s.friction)) continue;
    if (s.distance <= static_share * f.distance)
      f.static_friction = std::max(f.static_friction.value_or(s.friction), s.friction);
    if (i == 0 || s.distance < (1 - dynamic_share) * f.distance) continue;
    const double step = s.distance - samples_[i - 1].distance;
    distance += step;
    sum += step * s.friction;
    square += step * s.friction * s.friction;
    stress += step * s.normal_stress;
  }
  if (distance > 0) {
    const double mean = sum / distance;
    f.dynamic_friction = mean;
    f.dynamic_deviation = std::sqrt(std::max(square / distance - mean * mean, 0.0));
    if (setup_->width > 0) f.normal_stress = stress / distance;
  }
  return f;
}

}  // namespace pulvis
