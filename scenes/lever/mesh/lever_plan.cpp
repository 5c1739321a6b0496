#include "scenes/lever/mesh/lever_plan.hpp"

#include <algorithm>
#include <cmath>

#include "engine/portable_math.hpp"
#include "scenes/lever/mesh/grading.hpp"

namespace pulvis {
namespace {

// Lower bounds: the shape of the deformation needs as many, however large the elements may be. Upper bound:
// more along the lever cost time and hardly add accuracy, however thin it is.
constexpr int fewest_along = 20, fewest_across = 4, most_along = 150;
constexpr double growth = 0.4, growth_around_foot = 0.7;
// Distance at which the foot's disturbance has decayed, in thicknesses from its rim.
constexpr double solid_reach = 1.5;

// Ascending positions, and the range of the foot's lines among them; begin = end: none.
struct Lines {
  std::vector<double> at;
  int foot_begin = 0, foot_end = 0;

  int count() const { return static_cast<int>(at.size()) - 1; }
  bool crossed() const { return foot_end > foot_begin; }
};

double largest_edge(const LeverSpec& lever) {
  return std::clamp(lever.aspect * lever.thickness, lever.length / most_along,
                    lever.length / fewest_along);
}

// The strip at a side carries a share of the torsion of about t/w: negligible for a thin lever.
double side_edge(const LeverSpec& lever, double width, double largest) {
  constexpr double finest = 0.01;  // -, of the width
  return std::min(largest, std::max(lever.side_aspect * lever.thickness, finest * width));
}

void append(Lines& lines, const std::vector<double>& further) {
  const double from = lines.at.back();
  for (std::size_t i = 1; i < further.size(); ++i) lines.at.push_back(from + further[i]);
}

// The foot's lines occupy a box of the plan; a round foot's box is wider than the foot where there is room.
struct Box {
  double from = 0, to = 0;  // m, in one direction
};
constexpr double wider = 1.3, least_wider = 1.05;

std::optional<Box> box_between(const FootPlan& foot, double at, double from, double to) {
  const double least = (foot.round ? least_wider : 1 - 1e-9) * foot.reach;
  const double most = (foot.round ? wider : 1) * foot.reach;
  if (at - least < from || at + least > to) return {};
  Box box{std::max(from, at - most), std::min(to, at + most)};
  // No sliver between the box and a side.
  if (box.from - from < 1e-3 * foot.edge) box.from = from;
  if (to - box.to < 1e-3 * foot.edge) box.to = to;
  return box;
}

// The foot's lines in a box, which need not be centred on it.
std::vector<double> lines_in(const FootPlan& foot, const Box& box) {
  std::vector<double> lines;
  for (const double line : foot.lines) lines.push_back(0.5 * (1 + line) * (box.to - box.from));
  return lines;
}

void append_foot(Lines& lines, const FootPlan& foot, const Box& box) {
  lines.foot_begin = lines.count();
  append(lines, lines_in(foot, box));
  lines.foot_end = lines.count();
}

double edge_at(const FootPlan& foot, const Box& box) {
  return 0.5 * foot.spacing * (box.to - box.from);
}

Lines even(double from, double length, int count) {
  Lines lines{{from}};
  for (int i = 1; i <= count; ++i) lines.at.push_back(from + length * i / count);
  return lines;
}

// ---- a beam ---------------------------------------------------------------------------------------
struct Direction {
  double from = 0, to = 0;     // m
  double first = 0, last = 0;  // m, requested edges at its ends
  double largest = 0;          // m
  double coarser = 1;          // -
};

Lines lines_along(const Direction& d, const FootPlan* foot, double at) {
  Lines lines{{d.from}};
  const std::optional<Box> box = foot ? box_between(*foot, at, d.from, d.to) : std::nullopt;
  if (!box) {
    append(lines, graded_lines({d.to - d.from, d.first, d.last, d.largest, growth, d.coarser}));
    return lines;
  }
  const double edge = edge_at(*foot, *box);
  if (box->from > d.from)
    append(lines, graded_lines({box->from - d.from, d.first, edge, d.largest, growth_around_foot,
                                d.coarser}));
  append_foot(lines, *foot, *box);
  if (d.to > box->to)
    append(lines,
           graded_lines({d.to - box->to, edge, d.last, d.largest, growth_around_foot, d.coarser}));
  return lines;
}

struct BeamLines {
  Lines along, across;
};

BeamLines beam_lines(const LeverSpec& lever, const FootPlan* foot) {
  const double l = lever.length, w = lever.width, edge = largest_edge(lever);
  const auto fewer = [&](int count) {
    return std::max(1, static_cast<int>(std::round(count / lever.coarser)));
  };
  const bool own = lever.along > 0 || lever.across > 0;
  if (own) foot = nullptr;
  const double wide = std::min(edge, w / fewest_across);
  const double side = side_edge(lever, w, wide);
  const Vec2 at = foot ? foot->axis : Vec2(0, 0);
  BeamLines lines{
      lever.along > 0 ? even(0, l, fewer(lever.along))
                      : lines_along({0, l, edge, edge, edge, lever.coarser}, foot, at.x()),
      lever.across > 0
          ? even(-0.5 * w, w, fewer(lever.across))
          : lines_along({-0.5 * w, 0.5 * w, side, side, wide, lever.coarser}, foot, at.y())};
  if (lines.along.crossed() == lines.across.crossed()) return lines;
  return beam_lines(lever, nullptr);
}

// ---- a V ------------------------------------------------------------------------------------------
// One of its halves, y > 0 or y < 0: the lines across an arm continue across the apex plate.
struct HalfLines {
  std::vector<double> arm;   // shares of its width, from the inner edge
  int foot = 0;              // lines of the foot on this side of its axis
  std::vector<double> rest;  // shares from the foot's rim to the outer edge
  int count() const { return static_cast<int>(arm.size()) - 1; }
};

// Lines of the V: along x first through the arms, then through the apex plate.
struct VLines {
  VOutline v;
  double slope = 0, end = 0;  // -, of the outer edges; m, where it is truncated
  const FootPlan* foot = nullptr;
  Lines arms, apex;
  HalfLines upper, lower;

  double half_width(double x) const { return (v.apex - x) * slope; }
  int rows() const { return upper.count() + lower.count(); }
};

// A pointed lever is truncated where it is a fiftieth of an arm wide: nothing beyond carries load.
double v_end(const LeverSpec& lever, const VOutline& v) {
  return std::min(lever.length, v.apex - 0.01 * lever.arm_width / portable::tan(v.half_angle));
}

bool fits(const VLines& v, const FootPlan& foot) {
  const auto box = box_between(foot, foot.axis.x(), v.v.inner, v.end);
  if (!box) return false;
  const double margin = std::max(1.02 * foot.reach, foot.reach + 0.25 * foot.edge);
  const double room = v.half_width(box->to) - std::abs(foot.axis.y());
  return room > (foot.round ? least_wider : 1) * margin;
}

// Half the box's height across the V: equal above and below the foot's axis.
double box_height(const VLines& v, double to) {
  const FootPlan& foot = *v.foot;
  if (!foot.round) return foot.reach;
  const double room = v.half_width(to) - std::abs(foot.axis.y());
  return std::min(wider * foot.reach, 0.5 * (foot.reach + room));
}

HalfLines half_lines(const VLines& v, const LeverSpec& lever, double sign) {
  const double wide = lever.arm_width / portable::cos(v.v.half_angle);
  const double largest = std::min(largest_edge(lever), lever.arm_width / fewest_across);
  const double side = side_edge(lever, lever.arm_width, largest);
  const Grading arm{wide, side, side, largest, growth, lever.coarser};
  HalfLines lines;
  if (v.foot == nullptr) {
    lines.arm = graded_lines(arm);
  } else {
    const double to = v.apex.at[static_cast<std::size_t>(v.apex.foot_end)];
    const double rim = sign * v.foot->axis.y() + box_height(v, to);
    const double x = v.foot->axis.x();
    const double edge = v.foot->spacing * box_height(v, to);
    const Grading rest{v.half_width(x) - rim, edge,         side, largest,
                       growth_around_foot,    lever.coarser};
    lines.foot = v.foot->across() / 2;
    const int count = std::max({intervals_of(arm), lines.foot + intervals_of(rest)});
    lines.arm = graded_lines(arm, count);
    lines.rest = graded_lines(rest, count - lines.foot);
    for (double& share : lines.rest) share /= rest.length;
  }
  for (double& share : lines.arm) share /= wide;
  return lines;
}

VLines v_lines(const LeverSpec& lever, const FootPlan* foot) {
  VLines v;
  v.v = v_outline(lever);
  v.slope = portable::tan(v.v.half_angle);
  v.end = v_end(lever, v.v);
  const double edge = std::min(largest_edge(lever), v.v.inner / fewest_along);
  const double corner = std::min(edge, lever.arm_width / 8);
  const double point = std::min(edge, 0.3 * v.half_width(v.end));
  if (foot && fits(v, *foot)) v.foot = foot;
  v.arms = lines_along({0, v.v.inner, edge, corner, edge, lever.coarser}, nullptr, 0);
  v.apex = lines_along({v.v.inner, v.end, corner, point, edge, lever.coarser}, v.foot,
                       v.foot ? v.foot->axis.x() : 0);
  v.upper = half_lines(v, lever, 1);
  v.lower = half_lines(v, lever, -1);
  return v;
}

// Position of line k, counted outwards from the foot's axis, in half-widths of the plate at x.
double share_at_foot(const VLines& v, const HalfLines& half, double sign, int k, double x) {
  const double to = v.apex.at[static_cast<std::size_t>(v.apex.foot_end)];
  const double height = box_height(v, to), axis = sign * v.foot->axis.y();
  const double width = v.half_width(x);
  if (k <= half.foot) {
    const auto line = static_cast<std::size_t>(half.foot + k);
    return (axis + height * v.foot->lines[line]) / width;
  }
  const double rim = axis + height;
  return (rim + half.rest[static_cast<std::size_t>(k - half.foot)] * (width - rim)) / width;
}

// From the positions at the inner corner to those at the foot, and on from there to the point.
double share_of_line(const VLines& v, const HalfLines& half, double sign, int k, double x) {
  const double arm = half.arm[static_cast<std::size_t>(k)];
  if (v.foot == nullptr) return arm;
  const double from = v.apex.at[static_cast<std::size_t>(v.apex.foot_begin)];
  const double to = v.apex.at[static_cast<std::size_t>(v.apex.foot_end)];
  if (x >= from) return share_at_foot(v, half, sign, k, std::min(x, to));
  const double s = (x - v.v.inner) / (from - v.v.inner);
  return (1 - s) * arm + s * share_at_foot(v, half, sign, k, from);
}

// Row j, counted from the lower side, on the apex plate.
Vec2 apex_point(const VLines& v, int i, int j) {
  const double x = v.apex.at[static_cast<std::size_t>(i)];
  const int k = j - v.lower.count();
  const double share =
      k >= 0 ? share_of_line(v, v.upper, 1, k, x) : -share_of_line(v, v.lower, -1, -k, x);
  return {x, share * v.half_width(x)};
}

Vec2 arm_point(const VLines& v, const HalfLines& half, double sign, int i, int k) {
  const double x = v.arms.at[static_cast<std::size_t>(i)];
  const double inner = (v.v.inner - x) * v.slope, outer = v.half_width(x);
  return {x, sign * (inner + half.arm[static_cast<std::size_t>(k)] * (outer - inner))};
}

// ---- the mesh -------------------------------------------------------------------------------------
using Place = std::function<Vec2(int i, int j)>;

void add_part(PlanMesh& mesh, int i0, int i1, int j0, int j1, double tolerance,
              const Place& place) {
  if (i1 <= i0 || j1 <= j0) return;
  add_grid(mesh, i1 - i0, j1 - j0, tolerance, [&](int i, int j) { return place(i0 + i, j0 + j); });
}

// A round foot, and layers of quads between it and the surrounding box.
void add_round_foot(PlanMesh& mesh, const FootPlan& foot, int i0, int j0, double tolerance,
                    double coarser, const Place& place) {
  const int n = foot.across(), first = static_cast<int>(mesh.points.size());
  for (const Vec2& p : foot.unit.points) mesh.points.push_back(foot.axis + foot.reach * p);
  for (const auto& q : foot.unit.quads)
    mesh.quads.push_back({first + q[0], first + q[1], first + q[2], first + q[3]});
  const std::vector<double> layers =
      graded_lines({1, foot.edge / ((wider - 1) * foot.reach), 1, 1, growth, coarser});
  for (int side = 0; side < 4; ++side)
    add_grid(mesh, static_cast<int>(layers.size()) - 1, n, tolerance, [&](int i, int j) {
      const Vec2 rim = foot.axis + foot.reach * rim_of_disc(side, j, n);
      const Vec2 box = side == 0   ? place(i0 + n, j0 + j)
                       : side == 1 ? place(i0 + n - j, j0 + n)
                       : side == 2 ? place(i0, j0 + n - j)
                                   : place(i0 + j, j0);
      const double t = layers[static_cast<std::size_t>(i)];
      return Vec2((1 - t) * rim + t * box);
    });
}

// The position of a round foot in a grid: its first column and row.
struct FootHole {
  const FootPlan* foot = nullptr;
  int column = 0, row = 0;
  double coarser = 1;
};

// A grid with a hole for a round foot, and the foot inside.
void add_grid_around(PlanMesh& mesh, int along, int across, const FootHole& hole, double tolerance,
                     const Place& place) {
  if (hole.foot == nullptr) return add_part(mesh, 0, along, 0, across, tolerance, place);
  const int n = hole.foot->across(), i0 = hole.column, j0 = hole.row;
  add_part(mesh, 0, i0, 0, across, tolerance, place);
  add_part(mesh, i0, i0 + n, 0, j0, tolerance, place);
  add_part(mesh, i0, i0 + n, j0 + n, across, tolerance, place);
  add_part(mesh, i0 + n, along, 0, across, tolerance, place);
  add_round_foot(mesh, *hole.foot, i0, j0, tolerance, hole.coarser, place);
}

FootHole hole_for(const FootPlan* foot, const Lines& columns, int row, double coarser) {
  if (foot == nullptr || !foot->round || !columns.crossed()) return {};
  return {foot, columns.foot_begin, row, coarser};
}

PlanMesh beam_mesh(const LeverSpec& lever, const FootPlan* foot) {
  const BeamLines lines = beam_lines(lever, foot);
  PlanMesh mesh;
  const Place place = [&](int i, int j) {
    return Vec2(lines.along.at[static_cast<std::size_t>(i)],
                lines.across.at[static_cast<std::size_t>(j)]);
  };
  add_grid_around(mesh, lines.along.count(), lines.across.count(),
                  hole_for(foot, lines.along, lines.across.foot_begin, lever.coarser),
                  1e-9 * lever.length, place);
  return mesh;
}

PlanMesh v_mesh(const LeverSpec& lever, const FootPlan* foot) {
  const VLines v = v_lines(lever, foot);
  const double tolerance = 1e-9 * lever.length;
  PlanMesh mesh;
  add_grid(mesh, v.arms.count(), v.upper.count(), tolerance,
           [&](int i, int k) { return arm_point(v, v.upper, 1, i, k); });
  const int lower = v.lower.count();
  add_grid(mesh, v.arms.count(), lower, tolerance,
           [&](int i, int k) { return arm_point(v, v.lower, -1, i, lower - k); });
  add_grid_around(mesh, v.apex.count(), v.rows(),
                  hole_for(v.foot, v.apex, lower - v.lower.foot, lever.coarser), tolerance,
                  [&](int i, int j) { return apex_point(v, i, j); });
  return mesh;
}

bool near_foot(const LeverSpec& lever, const FootPlan& foot, const Vec2& point) {
  const double reach = foot.reach + solid_reach * lever.thickness;
  return (point - foot.axis).cwiseAbs().maxCoeff() < reach;
}

bool has_solid_foot(const LeverSpec& lever) { return lever.foot_layers.value_or(1) > 0; }

double lines_near(const Lines& lines, double at, double reach) {
  double count = 0;
  for (std::size_t i = 0; i + 1 < lines.at.size(); ++i)
    count += std::abs(0.5 * (lines.at[i] + lines.at[i + 1]) - at) < reach ? 1 : 0;
  return count;
}

}  // namespace

VOutline v_outline(const LeverSpec& lever) {
  VOutline v;
  if (lever.half_angle)
    v.half_angle = *lever.half_angle;
  else
    v.half_angle = portable::atan(0.5 * (*lever.base_width - lever.apex_width) / lever.length);
  v.apex = lever.length + 0.5 * lever.apex_width / portable::tan(v.half_angle);
  v.inner = v.apex - lever.arm_width / portable::sin(v.half_angle);
  v.base_width = 2 * v.apex * portable::tan(v.half_angle);
  return v;
}

AspectRange aspect_range(const LeverSpec& lever) {
  return {lever.length / most_along / lever.thickness,
          lever.length / fewest_along / lever.thickness};
}

LeverPlan lever_plan(const LeverSpec& lever, const std::optional<FootPlan>& foot) {
  const FootPlan* const at = foot ? &*foot : nullptr;
  LeverPlan plan;
  plan.mesh = lever.shape == LeverSpec::Shape::beam ? beam_mesh(lever, at) : v_mesh(lever, at);
  const bool solid = plan_count(lever, foot).solid_along > 0;
  for (const auto& q : plan.mesh.quads) {
    Vec2 middle = Vec2::Zero();
    for (const int p : q) middle += 0.25 * plan.mesh.points[static_cast<std::size_t>(p)];
    plan.solid.push_back(solid && near_foot(lever, *foot, middle));
  }
  return plan;
}

PlanCount plan_count(const LeverSpec& lever, const std::optional<FootPlan>& foot) {
  const FootPlan* const at = foot ? &*foot : nullptr;
  const double reach = foot ? foot->reach + solid_reach * lever.thickness : 0;
  if (lever.shape == LeverSpec::Shape::beam) {
    const BeamLines lines = beam_lines(lever, at);
    PlanCount count{static_cast<double>(lines.along.count()),
                    static_cast<double>(lines.across.count())};
    if (foot && has_solid_foot(lever) && lines.along.crossed()) {
      count.solid_along = lines_near(lines.along, foot->axis.x(), reach);
      count.solid_across = lines_near(lines.across, foot->axis.y(), reach);
    }
    return count;
  }
  const VLines v = v_lines(lever, at);
  PlanCount count{static_cast<double>(v.arms.count() + v.apex.count()),
                  static_cast<double>(v.rows())};
  if (foot && has_solid_foot(lever) && v.foot != nullptr) {
    count.solid_along = lines_near(v.apex, foot->axis.x(), reach);
    count.solid_across = std::min(count.solid_along, count.across);
  }
  return count;
}

}  // namespace pulvis
