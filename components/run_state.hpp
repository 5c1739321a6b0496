// Resources that change during a run, and the settings of contact and tools from the scene.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "components/shape.hpp"
#include "components/surface_laws.hpp"
#include "engine/entry.hpp"
#include "engine/row_range.hpp"

namespace pulvis {

// Most steps between two evaluations of the stable time step, and of what changes as slowly.
inline constexpr std::int64_t max_steps_between_looks = 8;

// Leapfrog clock (T 5.4, 5.5): positions at t_n, velocities half a step before and after.
struct Clock {
  static constexpr const char* resource_name = "clock";
  std::int64_t step = 0;
  double time = 0;       // t_n, s
  double dt_before = 0;  // t_n - t_(n-1)
  double dt = 0;         // t_(n+1) - t_n
  double end = 0;        // s
  double safety = 0.9;   // fraction of the stable time step that is used
  double relative_motion =
      0;  // m, upper bound of the relative displacement of any two surfaces so far
  std::int64_t next_look = 0;  // step at which the stable time step is computed next
  double stiffening = 1;  // -, tangent of the stiffest contact spring over the undeformed tangent

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(step, time, dt_before, dt, end, safety, relative_motion, next_look, stiffening);
  }
};

// Prescribed motion of the tools: each segment moves one tool by `displacement` over its duration.
struct ToolProgram {
  static constexpr const char* resource_name = "tool_program";
  struct Segment {
    int tool = 0;
    double begin = 0, duration = 0;  // s
    double ramp = 0;                 // -, share of the duration with rising (and falling) speed
    Point3 displacement{};           // m
    int stage = 0;
    // s: when the speed starts to ramp down before the displacement is complete; infinite unless the stage ends early.
    double cut = std::numeric_limits<double>::infinity();

    template <class Bytes>
    void state(Bytes& bytes) {
      bytes(tool, begin, duration, ramp, displacement, stage, cut);
    }
  };
  struct Stage {
    std::string name;
    double begin = 0, end = 0;  // s

    template <class Bytes>
    void state(Bytes& bytes) {
      bytes(name, begin, end);
    }
  };
  std::vector<std::string> names;
  std::vector<Point3> start;  // m
  std::vector<Segment> segments;
  std::vector<Stage> stages;

  // The stage at `time`; the number of stages once all are over.
  std::size_t stage_at(double time) const {
    std::size_t stage = 0;
    while (stage < stages.size() && time >= stages[stage].end) ++stage;
    return stage;
  }

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(names, start, segments, stages);
  }
};

struct ContactRules {
  static constexpr const char* resource_name = "contact_rules";
  static constexpr bool fixed = true;
  double stiffness = 1;   // -, k of kappa = k K L/A
  double tangential = 1;  // -, springs of friction over those of contact; 0: no friction
  double hardness = 0;    // -, pressure over flow stress at which a surface indents; 0: never
  double inertance = 0;   // -, c of the inerters at the boundary (systems/body/inerter_kernel.hpp)
  double damping = 0;     // -, fraction of critical damping
  double penetration_limit = 0.5;   // -, of the edge length
  double unconverged_limit = 1e-3;  // -, share of the closest-point projections
  double shortest_edge = 0;         // m
  // m: minimum width of elements and tool ridges. Anything thinner than a step's displacement can be missed.
  double thinnest = std::numeric_limits<double>::infinity();
  std::vector<double> tool_thickness;  // m, [tools]: of thin ridges; infinite if there are none
  bool servos = false;                 // some tool is force-controlled
  // -, [materials]: stiffness relative to the contact springs, of the stiffest bonds made at the start (their contact
  // springs use it too), and of welds; empty without bonds
  std::vector<double> initial_stiffness, weld_stiffness;
  int materials = 0;
  // Of any two materials, [materials * materials]; then of the folds of a particle, which do not attract each other,
  // [materials].
  std::vector<SurfaceLaws> pairs;
  std::vector<SurfaceLaws> tool_pairs;  // [tools * materials]
  int number_between(int a, int b) const { return a * materials + b; }
  int number_of_fold(int material) const { return materials * materials + material; }
  int number_with_tool(int tool, int material) const { return tool * materials + material; }
  const SurfaceLaws& between(int a, int b) const { return entry(pairs, number_between(a, b)); }
  const SurfaceLaws& with_tool(int tool, int material) const {
    return entry(tool_pairs, number_with_tool(tool, material));
  }
  double reach = 0;  // m, largest gap at which any surfaces attract each other
  // Tangent of the springs of a material's contacts and bonds relative to that of an undeformed contact spring, if the
  // contact springs have stiffened by this factor.
  double springs_of(int material, double stiffening) const {
    if (initial_stiffness.empty()) return stiffening;
    return std::max(1.0, entry(initial_stiffness, material)) *
           (stiffening + entry(weld_stiffness, material));
  }
  double stiffest_weld() const {
    return weld_stiffness.empty() ? 0 : *std::ranges::max_element(weld_stiffness);
  }
};

// The rows of each particle; rebuilt together with the rows.
struct ContactIndex {
  static constexpr const char* resource_name = "contact_index";
  double skin = 0;  // m: how far surfaces may approach each other before rows are rebuilt
  double reach =
      0;  // m: forces act across gaps below this; rows are created for gaps below skin + reach
  double neighbourhood = 0;   // m, > skin + reach: particles closer than this are neighbours
  double motion_at_bin = -1;  // m, Clock::relative_motion when the rows were created; < 0: not yet
  double look_at = 0;         // m, Clock::relative_motion at which the skin may be used up
  double motion_seen = 0;     // m, Clock::relative_motion in the previous step
  bool due = false;           // the rows are rebuilt in this step
  std::int64_t bins = 0;      // number of rebuilds so far
  std::vector<std::int32_t> neighbour_begin;  // [slots + 1] into neighbours
  std::vector<std::int32_t> neighbours;  // slots, including itself, at the last rebuild; sorted
  // In a periodic cell, for each neighbour: the number of periods by which it is shifted along each vector.
  std::vector<std::int32_t> images;
  std::vector<double> cell_before;          // m, the tensor of the cell vectors at the last rebuild
  std::vector<Point3> tools_before;         // m, [tools]: tool positions then
  std::vector<std::int32_t> sampled_begin;  // [slots + 1] into contact rows: as sampled particle
  std::vector<std::int32_t>
      other_begin;  // [slots + 1] into other_rows: rows with the particle as the other side
  std::vector<std::int32_t> other_rows;
  std::vector<std::int32_t> tool_begin;  // [slots + 1] into tool contact rows

  // From the keys of the rows: slot, edge, other for each.
  void list_others(std::span<const std::int32_t> keys) {
    other_begin.assign(sampled_begin.size(), 0);
    for (std::size_t k = 2; k < keys.size(); k += 3) entry(other_begin, keys[k] + 1) += 1;
    std::partial_sum(other_begin.begin(), other_begin.end(), other_begin.begin());
    std::vector<std::int32_t> next = other_begin;
    other_rows.resize(keys.size() / 3);
    for (std::size_t r = 0; r < other_rows.size(); ++r)
      entry(other_rows, entry(next, keys[3 * r + 2])++) = static_cast<std::int32_t>(r);
  }

  RowRange<Contact> sampled_by(int slot) const {
    return RowRange<Contact>::of(sampled_begin, slot);
  }
  RowRange<ToolContact> with_tools(int slot) const {
    return RowRange<ToolContact>::of(tool_begin, slot);
  }

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(skin, neighbourhood, motion_at_bin, look_at, motion_seen, due, bins, neighbour_begin,
          neighbours, images, cell_before, tools_before, sampled_begin, other_begin, other_rows,
          tool_begin);
  }
};

// Sums over the run, and values of the last step.
struct Totals {
  static constexpr const char* resource_name = "totals";
  double external_work = 0;      // J, of the tools on the particles
  double largest_work = 0;       // J, of the tools in one step, absolute value
  double friction_work = 0;      // J, dissipated
  double damping_work = 0;       // J, dissipated by contact damping
  double indentation_work = 0;   // J, spent by indenting surfaces
  double damping_power = 0;      // W, of this step
  double contact_energy = 0;     // J, stored in contact springs
  double penetration = 0;        // -, penetration / edge length, maximum in this step
  double worst_penetration = 0;  // -, the same, maximum of the run
  double min_jacobian = 1;       // -, minimum det F of the run
  std::int64_t touching = 0;     // rows with at least one touching point
  std::int64_t projections = 0;  // closest-point projections in the run
  std::int64_t unconverged = 0;  // projections that did not converge

  // Share of the projections that did not converge: of all in the run, or of ten thousand if there were fewer, so that
  // one of the first few does not already count as a tenth.
  double unconverged_share() const {
    return static_cast<double>(unconverged) /
           static_cast<double>(std::max<std::int64_t>(projections, 10000));
  }

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(external_work, largest_work, friction_work, damping_work, indentation_work, damping_power,
          contact_energy, penetration, worst_penetration, min_jacobian, touching, projections,
          unconverged);
  }
};

}  // namespace pulvis
