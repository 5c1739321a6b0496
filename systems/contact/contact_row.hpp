// What the two contact systems (particle on particle, particle on tool) do alike with a row: place its
// four Gauss points, turn gap and slip into forces, and book the energies.
#pragma once

#include <cmath>
#include <limits>

#include "engine/deal.hpp"
#include "engine/entry.hpp"
#include "engine/lane_memory.hpp"
#include "engine/prefetch.hpp"
#include "systems/contact/contact_kernel.hpp"
#include "systems/contact/systems.hpp"
#include "systems/laws/friction.hpp"
#include "systems/laws/normal_contact.hpp"

namespace pulvis {

// Two rows at once, four Gauss points each: the lanes of the one, then those of the other. The same row
// twice where one is left over.
template <class At>
using RowPair = std::array<Row<At>, 2>;
template <class At>
int rows_in(const RowPair<At>& rows) {
  return rows[0] == rows[1] ? 1 : 2;
}

struct PointLanes {
  Lane x, y;
};

inline constexpr auto basis_at_points = [] {
  std::array<std::array<double, lane_count>, 4> n{};  // [control point][Gauss point of both rows]
  for (std::size_t l = 0; l < lane_count; ++l) {
    const auto all = kernels::basis(kernels::edge_u[l % edge_points]);
    for (std::size_t a = 0; a < 4; ++a) n[a][l] = all[a];
  }
  return n;
}();

// The Gauss points of two edges from their four control points each, which lie one after the other.
inline PointLanes edge_points_at(const double* low, const double* high) {
  PointLanes p{};
  for (std::size_t a = 0; a < 4; ++a) {
    const Lane n = Lane::load(basis_at_points[a].data());
    p.x = fma(n, halves(low[2 * a], high[2 * a]), p.x);
    p.y = fma(n, halves(low[2 * a + 1], high[2 * a + 1]), p.y);
  }
  return p;
}

// Relative motion at the points: how the surfaces stand and move against each other.
struct RowMotion {
  Lane gap;         // m, > 0 in penetration
  Lane nx, ny;      // outward normal of the other surface
  Lane gap_rate;    // m/s
  Lane slip_rate;   // m/s, along t = (-ny, nx)
  Lane over_slope;  // 1/m, 1/|x'| of the other curve; where it has one
};

// Reach of a row of an outline against itself that sees its own neighbourhood or the back face of a thin part.
inline constexpr double back_face = std::numeric_limits<double>::infinity();

// A row whose points are all apart: nothing acts, and nothing can until `clearance` has been travelled.
template <class At>
void set_apart(const RowColumns<At>& c, Row<At> row, double reach) {
  c.touches(row) = 0;
  c.reach(row) = reach;
  for (int k = 0; k < 2 * edge_points; ++k) c.force(row, k) = 0;
  if (c.elastic_slip)
    for (int k = 0; k < edge_points; ++k) (*c.elastic_slip)(row, k) = 0;
  if (c.lost)
    for (int k = 0; k < edge_points; ++k) (*c.lost)(row, k) = 0;
}

// The numbers of a row at its four points, of two rows.
template <class Access, class At>
Lane at_points(const Access& column, const RowPair<At>& rows, int first = 0) {
  return load_halves(&column(rows[0], first), &column(rows[1], first));
}
// A number of a row, of two rows.
template <class Access, class At>
Lane at_rows(const Access& column, const RowPair<At>& rows, int number) {
  return halves(column(rows[0], number), column(rows[1], number));
}

// The sums of a block while it is looked at: lane by lane, and added up at its end.
struct LaneSums {
  Lane energy{}, friction_work{}, damping_work{};
  BlockSums block;  // the other numbers

  BlockSums added_up() const {
    BlockSums sums = block;
    const SumsOfHalves ab = sums_of_halves(energy, friction_work);
    const SumsOfHalves c = sums_of_halves(damping_work, Lane{});
    sums.energy = ab.a[0] + ab.a[1];
    sums.friction_work = ab.b[0] + ab.b[1];
    sums.damping_work = c.a[0] + c.a[1];
    return sums;
  }
};

// Books the depth of a row: the first NaN, or the deepest.
template <class At>
void book_depth(Row<At> row, double depth, BlockSums& sums) {
  if (depth <= sums.depth || std::isnan(sums.depth)) return;
  sums.depth = depth;
  sums.deepest = row.value;
}

// Friction of a pair of rows after its law; keeps what sliding has done to the rows that touch.
template <class At>
kernels::Friction<Lane> friction_of(const RowColumns<At>& c, const RowPair<At>& rows,
                                    unsigned touching, const Lane& slip, const Lane& pressure,
                                    const Lane& kappa, const Lane& inv_kappa, double share) {
  const Lane before = at_points(*c.elastic_slip, rows);
  const Lane mu = at_rows(c.law, rows, ContactLaw<At>::friction);
  if (!c.more) {
    kernels::Coulomb<Lane> law{mu};
    return kernels::friction_return(before, slip, pressure, law, kappa, inv_kappa);
  }
  using More = FrictionMore<At>;
  kernels::Weakening<Lane> law{
      mu, at_rows(*c.more, rows, More::drop), at_rows(*c.more, rows, More::inv_decay),
      share * at_rows(*c.more, rows, More::strength), at_points(*c.lost, rows)};
  const auto friction = kernels::friction_return(before, slip, pressure, law, kappa, inv_kappa);
  for (int half = 0; half < 2; ++half)
    if ((touching >> half & 1) != 0) store_half(law.lost, half, &(*c.lost)(entry(rows, half)));
  return friction;
}

inline constexpr std::array<unsigned, 4> lanes_of_halves{0x00, 0x0f, 0xf0, 0xff};

// Forces of the rows of a pair that touch (bit 0, bit 1), and what they add to the sums of their block.
// `share` of kappa: one half where the other particle samples back. Returns the friction traction times
// weight [N] (the couple of the other body needs it).
template <class At>
[[gnu::flatten]] Lane set_touching(const RowColumns<At>& c, const RowPair<At>& rows,
                                   unsigned touching, const RowMotion& m, double share, double dt,
                                   LaneSums& sums) {
  using Law = ContactLaw<At>;
  const Lane weight = at_points(c.law, rows, Law::weight);
  const std::array<double, 2> stiffness{share * c.law(rows[0], Law::stiffness),
                                        share * c.law(rows[1], Law::stiffness)};
  const Lane kappa = halves(stiffness[0], stiffness[1]);
  const Lane inv_length = at_rows(c.law, rows, Law::inv_length);
  const auto normal = kernels::normal_traction(
      m.gap, m.gap_rate, kappa, share * at_rows(c.law, rows, Law::damping), inv_length);
  Lane along{}, spring{}, friction_work{}, energy = normal.spring_energy;
  if (c.elastic_slip) {
    const auto friction = friction_of(c, rows, touching, m.slip_rate * dt, normal.pressure, kappa,
                                      halves(1 / stiffness[0], 1 / stiffness[1]), share);
    spring = friction.elastic_slip;
    along = friction.traction * weight;
    friction_work = friction.work * weight;
    energy = fma(0.5 * kappa * spring, spring, energy);
  }
  energy *= weight;
  const Lane push = normal.pressure * weight;
  const Lane fx = fma(push, m.nx, -(along * m.ny)), fy = fma(push, m.ny, along * m.nx);
  const Lane damping_work = normal.damping_power * weight * dt;
  const LaneMask touch = LaneMask::of(lanes_of_halves[touching]);
  sums.energy += select(touch, energy, Lane{});
  sums.friction_work += select(touch, friction_work, Lane{});
  sums.damping_work += select(touch, damping_work, Lane{});
  const Lane depth = m.gap * inv_length;
  const bool deeper = any(touch & ~(depth <= sums.block.depth));
  for (int half = 0; half < 2; ++half) {
    if ((touching >> half & 1) == 0) continue;
    const Row<At> row = entry(rows, half);
    c.touches(row) = 1;
    c.reach(row) = 0;
    store_pairs_of_half(fx, fy, half, &c.force(row));
    if (c.elastic_slip) store_half(spring, half, &(*c.elastic_slip)(row));
    sums.block.touching += 1;
    if (deeper) book_depth(row, greatest_of_half(depth, half), sums.block);
  }
  return along;
}

// Asks for a row's numbers before they are needed: in a large powder they come from memory, a line a column.
template <class At>
void fetch(const RowColumns<At>& c, Row<At> row) {
  const auto line = [row](const auto& column) { prefetch(&column(row)); };
  line(c.pair), line(c.law), line(c.force);
  if (c.elastic_slip) line(*c.elastic_slip);
}

// As many stay in the caches from step to step; asking ahead for what is there already would only cost.
inline constexpr int rows_in_cache = 16384;
inline constexpr int min_tasks = 64, max_blocks = 16;  // of a task
inline constexpr std::size_t max_rows_of_a_task = max_blocks * (rows_of_a_block + 1);

// What a pair computes waits for itself, step by step, and no processor looks ahead as far as the next pair: where
// a register holds all points of a pair, two pairs go side by side. With more registers they fill the time alone.
inline constexpr bool two_pairs_at_once = simd::registers == 1;

// Calls look_at(pair, sums of its block) for all active rows, two by two; look_at_two(pair, pair, sums), where it is
// given and pays, for two pairs. Which rows make a pair does not depend on threads. Rows that are not active are
// apart and add nothing. `fetch(row)` and then `fetch_other(row)`, which may use what the first has asked for, come
// some rows before; a task has several blocks, so that the first rows of the next are asked for while the last of
// one are looked at.
template <class At, class Active, class Fetch, class FetchOther, class LookAt,
          class LookAtTwo = std::nullptr_t>
void for_active_pairs(int rows, ContactSums<At>& sums, const Active& active, const Fetch& fetch,
                      const FetchOther& fetch_other, const LookAt& look_at,
                      const LookAtTwo& look_at_two = {}) {
  constexpr std::size_t rows_before = 24, rows_before_other = 12;
  const bool from_memory = rows > rows_in_cache;
  const int blocks = (rows + rows_of_a_block - 1) / rows_of_a_block;
  const int blocks_of_a_task = std::clamp(blocks / min_tasks, 1, max_blocks);
  sums.blocks.resize(static_cast<std::size_t>(blocks));
  Deal tasks((blocks + blocks_of_a_task - 1) / blocks_of_a_task,
             tbb::this_task_arena::max_concurrency());
  for_pieces(tasks, [&](int task) {
    const int first = task * blocks_of_a_task, last = std::min(blocks, first + blocks_of_a_task);
    std::array<std::int32_t, max_rows_of_a_task> found;
    std::array<std::size_t, max_blocks> end;
    std::size_t count = 0;
    for (int block = first; block < last; ++block) {
      // No branch: which rows are active follows no pattern.
      for (int r = block * rows_of_a_block; r < std::min(rows, (block + 1) * rows_of_a_block);
           ++r) {
        found[count] = r;
        count += active(Row<At>(r)) ? 1 : 0;
      }
      if (count % 2 != 0) {
        found[count] = found[count - 1];
        ++count;
      }
      entry(end, block - first) = count;
    }
    const auto ask = [&](std::size_t i) {
      if (from_memory && i < count) fetch(Row<At>(found[i]));
    };
    const auto ask_other = [&](std::size_t i) {
      if (from_memory && i < count) fetch_other(Row<At>(found[i]));
    };
    for (std::size_t i = 0; i < rows_before; ++i) ask(i);
    for (std::size_t i = 0; i < rows_before_other; ++i) ask_other(i);
    std::size_t i = 0;
    for (int block = first; block < last; ++block) {
      LaneSums sum;
      const std::size_t stop = entry(end, block - first);
      const auto pair = [&](std::size_t at) {
        for (std::size_t k = 0; k < 2; ++k) {
          ask(at + k + rows_before);
          ask_other(at + k + rows_before_other);
        }
        return RowPair<At>{Row<At>(found[at]), Row<At>(found[at + 1])};
      };
      if constexpr (two_pairs_at_once && !std::is_null_pointer_v<LookAtTwo>)
        for (; i + 4 <= stop; i += 4) look_at_two(pair(i), pair(i + 2), sum);
      for (; i < stop; i += 2) look_at(pair(i), sum);
      entry(sums.blocks, block) = sum.added_up();
    }
  });
}

}  // namespace pulvis
