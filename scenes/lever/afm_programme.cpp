#include "scenes/lever/afm_programme.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/probe.hpp"
#include "engine/portable_math.hpp"
#include "engine/run_failure.hpp"
#include "scenes/lever/adhesion.hpp"
#include "scenes/lever/afm_curve.hpp"
#include "scenes/lever/afm_series.hpp"
#include "scenes/lever/target_shape.hpp"
#include "scenes/spec/afm_scene.hpp"
#include "systems/lever/jkr_kernel.hpp"
#include "systems/lever/solid_contact_problem.hpp"

namespace pulvis {
namespace {

constexpr int max_halvings = 8;
constexpr int max_iterations = 400;  // of an increment, including its halves
// Of the pull-off force: change of the lever's force in the step in which an adhesive tip is released.
constexpr double release_resolution = 5e-4;

Vec3 on_target(const AfmModel& model, int node) {
  const double* x = model.world->column<ReferencePosition>().values() + 3 * node;
  const double* u = model.world->column<Displacement>().values() + 3 * node;
  return place_from(model.world->resource<Target>(), Vec3(x), Vec3(u));
}

struct Gap {
  double gap = std::numeric_limits<double>::infinity();  // m
  double rise = 1;                                       // -, z component of the normal there
};

// Smallest gap over all points of the probe.
Gap smallest_gap(const AfmModel& model) {
  const Target& target = model.world->resource<Target>();
  const auto& nodes = model.world->column<ProbeNode>();
  Gap smallest;
  for (std::size_t i = 0; i < nodes.table.rows; ++i) {
    const Vec3 x = on_target(model, nodes.values()[i]);
    const auto near = target.shape->nearest({x.x(), x.y(), x.z() + target.end_radius});
    const double gap = near.distance - target.end_radius;
    if (gap < smallest.gap) smallest = {gap, near.normal[2]};
  }
  return smallest;
}

struct ContactPatch {
  double radius = 0, pressure = 0;  // m, Pa
};

ContactPatch adhesive_patch(const AfmModel& model, const AdhesiveBall& ball) {
  const double* state = model.world->column<ProbeState>().values();
  if (state[3] == 0) return {};
  const double radius = kernels::jkr_radius(ball, -state[0]);
  return {radius, kernels::jkr_pressure(ball, radius)};
}

ContactPatch contact_patch(const AfmModel& model) {
  ContactPatch patch;
  if (const auto& ball = model.world->resource<Target>().ball; ball.work > 0)
    return adhesive_patch(model, ball);
  if (model.tip.area.empty()) return patch;
  const auto& nodes = model.world->column<ProbeNode>();
  const double* state = model.world->column<ProbeState>().values();
  double sum = 0, square = 0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < nodes.table.rows; ++i) {
    const double pressing = state[ProbeState::count * i + 1];
    if (state[ProbeState::count * i + 3] == 0 || pressing <= 0) continue;
    const auto at = on_target(model, nodes.values()[i]).head<2>().eval();
    sum += pressing;
    first += pressing * at;
    square += pressing * at.squaredNorm();
    patch.pressure = std::max(patch.pressure, pressing / model.tip.area[i]);
  }
  if (sum > 0)
    patch.radius = std::sqrt(2.5 * std::max(0.0, square / sum - (first / sum).squaredNorm()));
  return patch;
}

}  // namespace

void add_probe(const Scene& scene, AfmModel& model) {
  const AfmScene& afm = *scene.afm;
  World& world = *model.world;
  const bool ball = !model.tip.surface.empty();
  auto& target = world.emplace<Target>();
  target.shape = make_target(*afm.target, scene, reach_of(afm));
  target.friction = afm.target->friction;
  target.pull_off = pull_off_force(scene);
  target.ball = adhesive_ball(scene);
  target.range = afm.target->range;
  target.end_radius = afm.tip.end_radius;  // a ball has none
  add_probe_columns(world, ball ? model.tip.surface.size() : 1);
}

// The penalties are so stiff that their compliance affects a traverse by only a thousandth.
void place_target(const Scene& scene, AfmModel& model, double stiffness) {
  constexpr double stiffer = 1e3;
  World& world = *model.world;
  const bool ball = !model.tip.surface.empty();
  auto* node = world.column<ProbeNode>().values();
  double* penalty = world.column<ProbeStiffness>().values();
  double* share = world.column<ProbeShare>().values();
  const auto points = static_cast<int>(world.column<ProbeNode>().table.rows);
  const MaterialSpec& m = scene.materials[static_cast<std::size_t>(scene.afm->tip.material)];
  for (int i = 0; i < points; ++i) {
    const auto at = static_cast<std::size_t>(i);
    node[i] = ball ? model.tip.surface[at] : model.contact_node;
    // For a meshed surface: a layer of the probe's material, as thick as a hundredth of its elements.
    const double area = ball ? model.tip.area[at] : 0;
    penalty[2 * i] = penalty[2 * i + 1] =
        ball ? 100 * m.youngs_modulus * std::sqrt(area) : stiffer * stiffness;
    share[i] = ball && node[i] != model.end.front().node ? 0.0 : 1.0;
  }
  Target& target = world.resource<Target>();
  const Vec3 end = read(model.end, world.column<ReferencePosition>().values());
  target.origin = {end.x(), end.y(), end.z()};
  target.travel = {};
  for (int i = 0; i < 100; ++i) target.origin[2] += smallest_gap(model).gap;
  // Over a steep flank the gap is a small fraction of the missing height.
  for (int i = 0; i < 100; ++i) {
    const auto [gap, rise] = smallest_gap(model);
    if (std::abs(gap) < 1e-15 || !(rise > 0)) break;
    target.origin[2] += gap / rise;
  }
  // An adhesive ball jumps in where the gap is 0; it has not yet.
  if (target.ball.work > 0) target.origin[2] -= 2e-15;
  double* memory = world.column<ProbeMemory>().values();
  for (int i = 0; i < points; ++i) {
    const Vec3 x = on_target(model, node[i]);
    for (int k = 0; k < 3; ++k) memory[ProbeMemory::count * i + 3 + k] = x[k];
  }
}

bool AfmProgramme::adheres() const {
  const Target& target = model_.world->resource<Target>();
  return target.pull_off > 0 || target.ball.work > 0;
}

bool AfmProgramme::touches() const {
  const auto& state = model_.world->column<ProbeState>();
  for (std::size_t i = 0; i < state.table.rows; ++i)
    if (state.values()[ProbeState::count * i + 3] > 0) return true;
  return false;
}

bool AfmProgramme::touched() const {
  const auto& memory = model_.world->column<ProbeMemory>();
  for (std::size_t i = 0; i < memory.table.rows; ++i)
    if (memory.values()[ProbeMemory::count * i + 6] != 0) return true;
  return false;
}

double AfmProgramme::vertical_force() const {
  const auto& force = model_.world->column<ProbeForce>();
  double sum = 0;
  for (std::size_t i = 0; i < force.table.rows; ++i) sum += force.values()[3 * i + 2];
  return sum;
}

bool AfmProgramme::tell() {
  const World& world = *model_.world;
  const double* u = world.column<Displacement>().values();
  AfmIncrement now;
  now.scanner = Vec3(world.resource<Target>().travel.data());
  const auto& points = world.column<ProbeForce>();
  const double* state = world.column<ProbeState>().values();
  double sliding = 0;
  for (std::size_t i = 0; i < points.table.rows; ++i) {
    now.force += Vec3(points.values() + 3 * i);
    const double kind = state[ProbeState::count * i + 3];
    now.points += kind > 0 ? 1 : 0;
    sliding += kind > 1 ? 1 : 0;
  }
  now.sliding = now.points > 0 ? sliding / now.points : 0;
  now.end = read(model_.end, u);
  now.foot = read(model_.foot, u).y();
  now.twist = slopes(model_, {model_.foot_slope}, u).lateral;
  now.clamp = clamp_force(model_);
  const ContactPatch patch = contact_patch(model_);
  now.radius = patch.radius;
  now.pressure = patch.pressure;
  const Slopes spot = slopes(model_, model_.spot, u);
  now.slope_normal = spot.normal;
  now.slope_lateral = spot.lateral;
  now.volts_normal = scene_.afm->detector.normal_gain * spot.normal;
  now.volts_lateral = scene_.afm->detector.lateral_gain * spot.lateral;
  now.elastic = elastic_energy(model_);
  now.released = position_.released;
  now.pulling = position_.pulling;
  now.iterations = iterations_;
  now.lowest_force = std::min(lowest_, now.force.z());
  lowest_ = std::numeric_limits<double>::infinity();
  position_.told += 1;
  return record_(time_, afm_row(now));
}

bool AfmProgramme::skip() {
  if (to_skip_ == 0) return false;
  to_skip_ -= 1;
  return true;
}

void AfmProgramme::advance(const std::array<double, 3>& travel, bool servo, int depth) {
  Target& target = model_.world->resource<Target>();
  const auto before = target.travel;
  const StaticSolver::State start = solver_.state();
  const double pulled = vertical_force();
  for (std::size_t k = 0; k < 3; ++k) target.travel[k] += travel[k];
  target.servo = servo;
  NewtonSettings settings;
  // Factors of a yielding solid are far too soft for one that unloads.
  settings.reuse_factors = !model_.world->has<SolidYield>();
  settings.may_jump = depth >= max_halvings;
  const IncrementStep step{travel[0], travel[1], travel[2], target.set_point - position_.set_point};
  const NewtonReport report = equilibrium(settings, step);
  if (report.converged && !is_released_too_far(travel, servo)) {
    lowest_ = std::min(lowest_, vertical_force());
    position_.pulling += pulling_area(pulled, vertical_force(), before[2] - target.travel[2]);
    position_.released += report.released;
    position_.set_point = target.set_point;
    position_.trail.add(solver_.state(), step);
    return solver_.commit();
  }
  position_.trail.clear();
  solver_.restore(start);
  target.travel = before;
  if (!report.converged && (depth >= max_halvings || iterations_ > max_iterations))
    throw RunFailure(fmt::format(
        "{}: no equilibrium at {:.4f} of the programme, with the sample at x {:.4g}, y {:.4g}, z "
        "{:.4g} m, after {} halvings of the increment; residual {:.2g} of the forces in balance: "
        "the probe has locked, jumped or left the surface",
        doing_, time_, before[0], before[1], before[2], depth, report.residuals.back()));
  const std::array<double, 3> half{travel[0] / 2, travel[1] / 2, travel[2] / 2};
  advance(half, servo, depth + 1);
  advance(half, servo, depth + 1);
}

// A long step reaches the equilibrium of the free tip without passing the one at which it lets go.
bool AfmProgramme::is_released_too_far(const std::array<double, 3>& travel, bool servo) const {
  const bool straight_down = travel[0] == 0 && travel[1] == 0 && travel[2] < 0 && !servo;
  return straight_down && adheres() && touched() && !touches() && iterations_ <= max_iterations &&
         model_.normal_stiffness * -travel[2] >
             release_resolution * model_.world->resource<Target>().pull_off;
}

NewtonReport AfmProgramme::equilibrium(const NewtonSettings& settings, const IncrementStep& step) {
  const auto search = [&] {
    const NewtonReport report = solver_.equilibrate(settings);
    iterations_ += static_cast<int>(report.residuals.size());
    return report;
  };
  Target& target = model_.world->resource<Target>();
  // Where the probe can jump there may be two equilibria: use the nearer one.
  const auto guess = adheres() ? std::nullopt : position_.trail.next(step);
  const StaticSolver::State start = solver_.state();
  if (!guess || guess->displacement.size() != start.displacement.size() ||
      guess->force.size() != start.force.size())
    return search();
  solver_.restore(*guess);
  if (!target.servo) target.travel[2] = start.height;
  if (const NewtonReport report = search(); report.converged) return report;
  solver_.restore(start);
  return search();
}

void AfmProgramme::refuse_lock(const std::array<double, 3>& travel) const {
  const World& world = *model_.world;
  const Target& target = world.resource<Target>();
  const double length = portable::hypot(travel[0], travel[1]);
  if (length == 0 || target.friction == 0) return;
  const Vec3 forward(-travel[0] / length, -travel[1] / length, 0);
  const auto& nodes = world.column<ProbeNode>();
  const double* state = world.column<ProbeState>().values();
  for (std::size_t i = 0; i < nodes.table.rows; ++i) {
    constexpr double sticks = 1, equal = 1e-9;
    if (state[ProbeState::count * i + 3] != sticks) continue;
    const Vec3 x = on_target(model_, nodes.values()[i]);
    const auto near = target.shape->nearest({x.x(), x.y(), x.z() + target.end_radius});
    const Vec3 n(near.normal.data());
    if (-n.dot(forward) * target.friction < n.z() * (1 - equal)) continue;
    throw RunFailure(fmt::format(
        "{}: the probe has locked at {:.4f} of the programme, with the sample at x {:.4g}, y "
        "{:.4g} "
        "m: uphill on a slope of {:.4g}, friction of {:.4g} withstands any force, allowed: < "
        "{:.4g}",
        doing_, time_, target.travel[0], target.travel[1], -n.dot(forward) / n.z(), target.friction,
        -n.z() / n.dot(forward)));
  }
}

bool AfmProgramme::traverse(const std::array<double, 3>& travel, int increments, bool servo) {
  const std::array<double, 3> step{travel[0] / increments, travel[1] / increments,
                                   travel[2] / increments};
  for (int i = 0; i < increments; ++i) {
    const bool made = skip();
    if (!made) pass(step, servo);
    time_ += share_ / increments;
    if (!made && !tell()) return false;
  }
  return true;
}

void AfmProgramme::pass(const std::array<double, 3>& step, bool servo) {
  iterations_ = 0;
  advance(step, servo, 0);
  refuse_lock(step);
}

bool AfmProgramme::press(const ActionSpec& action, double sign) {
  if (action.force) return press_to_force(action);
  return traverse({0, 0, sign * action.distance}, action.increments, false);
}

// The set point rises in equal steps.
bool AfmProgramme::press_to_force(const ActionSpec& action) {
  Target& target = model_.world->resource<Target>();
  if (to_skip_ == 0) position_.from = std::max(0.0, vertical_force());
  const double from = position_.from;
  for (int i = 1; i <= action.increments; ++i) {
    const bool made = skip();
    iterations_ = 0;
    if (!made) {
      target.set_point = from + (*action.force - from) * i / action.increments;
      advance({0, 0, 0}, true, 0);
    }
    time_ += 1.0 / action.increments;
    if (!made && !tell()) return false;
  }
  return true;
}

// Scanning the probe over the sample means moving the sample under it in the opposite direction.
bool AfmProgramme::scan(const ActionSpec& action) {
  const bool lateral = action.direction == TargetSpec::Direction::lateral;
  const double d = action.distance;
  const std::array<double, 3> trace{lateral ? 0 : -d, lateral ? -d : 0, 0};
  const std::array<double, 3> retrace{-trace[0], -trace[1], 0};
  share_ = action.retrace ? 0.5 : 1;
  const bool done = traverse(trace, action.increments, action.servo) &&
                    (!action.retrace || traverse(retrace, action.increments, action.servo));
  share_ = 1;
  return done;
}

// Pixels are recorded at their centres, so that trace and retrace have them at the same places: half a pixel before the first
// and after the last one is passed without a record.
bool AfmProgramme::cross(const std::array<double, 3>& travel, const ActionSpec& action) {
  std::array<double, 3> pixel, half;
  for (std::size_t k = 0; k < 3; ++k) {
    pixel[k] = travel[k] / action.increments;
    half[k] = pixel[k] / 2;
  }
  for (int i = 0; i < action.increments; ++i) {
    const std::array<double, 3>& step = i == 0 ? half : pixel;
    const bool made = skip();
    if (!made) pass(step, action.servo);
    time_ += share_ / action.increments;
    if (!made && !tell()) return false;
  }
  if (to_skip_ == 0) pass(half, action.servo);
  return true;
}

// Between the lines the probe moves along the slow axis.
bool AfmProgramme::raster(const ActionSpec& action) {
  const bool lateral = action.direction == TargetSpec::Direction::lateral;
  const double d = action.distance;
  const std::array<double, 3> trace{lateral ? 0 : -d, lateral ? -d : 0, 0};
  const std::array<double, 3> retrace{-trace[0], -trace[1], 0};
  const double apart = action.lines > 1 ? action.width / (action.lines - 1) : 0;
  const std::array<double, 3> aside{lateral ? -apart : 0, lateral ? 0 : -apart, 0};
  share_ = 0.5 / action.lines;
  for (int line = 0; line < action.lines; ++line) {
    if (line > 0 && to_skip_ == 0) pass(aside, action.servo);
    if (!cross(trace, action) || !cross(retrace, action)) return false;
  }
  share_ = 1;
  return true;
}

// The force at which the action begins is its set point.
void AfmProgramme::hold_force(std::size_t action) {
  if (!touched())
    throw RunFailure(fmt::format(
        "action[{}]: the probe does not touch the sample, so there is no force to hold; its "
        "nearest "
        "point is {:.3g} m away, allowed: set_point = \"force\" with the probe in contact, after a "
        "press",
        action, smallest_gap(model_).gap));
  model_.world->resource<Target>().set_point = vertical_force();
}

bool AfmProgramme::run() {
  if (position_.told == 0) {
    // With a DMT attraction a tip without force is pressed on by it: it has touched before the first increment.
    solver_.look();
    solver_.commit();
    if (!tell()) return false;
  } else {
    to_skip_ = position_.told - 1;
  }
  for (std::size_t i = 0; i < scene_.afm->actions.size(); ++i) {
    const ActionSpec& action = scene_.afm->actions[i];
    using Kind = ActionSpec::Kind;
    bool on = true;
    const double end = static_cast<double>(i + 1);
    if (action.servo && to_skip_ == 0) hold_force(i);
    switch (action.kind) {
      case Kind::press:
        doing_ = "press";
        on = press(action, 1);
        break;
      case Kind::retract:
        doing_ = "retract";
        on = press(action, -1);
        break;
      case Kind::scan:
        doing_ = "scan";
        on = scan(action);
        break;
      case Kind::raster:
        doing_ = "raster";
        on = raster(action);
        break;
      case Kind::hold:
        doing_ = "hold";
        on = traverse({0, 0, 0}, action.increments, action.servo);
        break;
    }
    if (!on) return false;
    time_ = end;
  }
  return true;
}

}  // namespace pulvis
