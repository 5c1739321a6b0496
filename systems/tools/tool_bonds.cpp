// initial_tool_bonds, pressed_tool_bonds, tool_bond_forces: points bonded to tools: glued grips, powder that sticks
// to a punch.
//
// Law      as between particles (systems/contact/initial_bonds.cpp, pressed_bonds.cpp, bond_points.hpp); tools do not
//          rotate, and the anchor and its normal move with the tool
// Runs     once, at the start; before tool_contact (by the pressures of the previous step); after it, before contact_force
// Active   when the scene has bonds with tools
#include "systems/contact/active_pairs.hpp"
#include "systems/contact/bond_points.hpp"
#include "systems/contact/new_bonds.hpp"
#include "systems/tools/tool_rows.hpp"

namespace pulvis {
namespace {

using Two = TwoCandidates<ToolContact>;

// One row's points, in the lower half of the lanes.
struct RowStand {
  PointLanes at;
  PointMotion motion;
  Point tool;
};
RowStand stand_of(const Bodies& bodies, const ToolBondPlaces& places,
                  const Read<ContactPair<ToolContact>>& pair, Row<ToolContact> row) {
  const SampledEdges edges = SampledEdges::of(bodies, pair, {row, row});
  const PointLanes at = edges.points(places.control.values().data());
  const int number = pair(row, 2);
  const Row<Tool> tool(number);
  return {at,
          gap_to_tool(places.tools, places.range, row, number, at, edges.length[0]),
          {places.tools.position(tool, 0), places.tools.position(tool, 1)}};
}

// At the nearest point on the tool's surface.
void set_anchor(const RowStand& stand, Row<ToolContact> row, int g,
                const Write<ToolAnchor>& anchor) {
  const double nx = stand.motion.nx[g], ny = stand.motion.ny[g], gap = stand.motion.gap[g];
  anchor(row, g) = stand.at.x[g] + gap * nx - stand.tool[0];
  anchor(row, edge_points + g) = stand.at.y[g] + gap * ny - stand.tool[1];
  anchor(row, 2 * edge_points + g) = nx;
  anchor(row, 3 * edge_points + g) = ny;
}

struct ToolBonds {
  using Sums = BondSumsOfLanes;
  static constexpr double share = 1;
  const tool_bond_forces& s;
  const BondPass<ToolContact> bonds{
      {s.columns, s.bonds, *s.rules, *s.clock, s.bodies->thickness, share}};
  const double* points = s.at.curves.position.values().data();
  const double* rates = s.at.curves.velocity ? s.at.curves.velocity->values().data() : nullptr;

  bool active(Row<ToolContact> row) const { return s.bonds.points(row) != 0; }
  void fetch(Row<ToolContact> row) const { pulvis::fetch(s.columns, row); }
  void fetch_other(Row<ToolContact>) const {}

  void operator()(const Two& two, Sums& sums) const {
    const SampledEdges edges = SampledEdges::of(*s.bodies, s.columns.pair, two);
    const PointLanes at = edges.points(points);
    const BondMotion m = motion(two, at);
    const auto contact = [&] {
      PointMotion moving = m.point;
      if (rates != nullptr)
        set_rates(edges.points(rates), of_tools(s.at.velocity, two, 0),
                  of_tools(s.at.velocity, two, 1), moving);
      return forces_of_bonded(s.columns, two, moving, share, s.clock->dt_before);
    };
    bonds.act(two, bonds.bonded(two), m, at, contact, sums);
  }

 private:
  template <class Column>
  Lane of_tools(const Column& column, const Two& two, int axis) const {
    const Row<Tool> a(s.columns.pair(two[0], 2)), b(s.columns.pair(two[1], 2));
    return halves(column(a, axis), column(b, axis));
  }
  BondMotion motion(const Two& two, const PointLanes& at) const {
    const auto of_anchor = [&](int first) {
      return at_points(s.at.anchor, two, first * edge_points);
    };
    BondMotion m{};
    m.point.nx = of_anchor(2);
    m.point.ny = of_anchor(3);
    const Lane x = at.x - of_tools(s.at.position, two, 0) - of_anchor(0);
    const Lane y = at.y - of_tools(s.at.position, two, 1) - of_anchor(1);
    m.point.gap = -fma(x, m.point.nx, y * m.point.ny);
    m.along = fma(y, m.point.nx, -(x * m.point.ny));
    return m;
  }
};

}  // namespace

void initial_tool_bonds::operator()() const {
  for (int r = 0; r < rows.pair.rows(); ++r) {
    const Row<ToolContact> row(r);
    const int slot = rows.pair(row, 0), tool = rows.pair(row, 2);
    const auto& body = entry(bodies->slots, slot);
    const int number = rules->initial_with_tool(tool, body);
    if (number == 0) continue;
    const BondRules::Law& law = rules->law(number);
    const double length = entry(bodies->shape_of_slot(slot).edges, rows.pair(row, 1)).length;
    const RowStand stand = stand_of(*bodies, at, rows.pair, row);
    const double strength = drawn_strength(law, body.number, -1 - tool);
    for (int g = 0; g < edge_points; ++g) {
      const double gap = std::abs(stand.motion.gap[g]);
      entry(totals->nearest, number - 1).take(gap, length);
      if (gap > law.reach * length) continue;
      set_anchor(stand, row, g, anchor);
      make_bond(rows, row, g, number, strength, {-stand.motion.gap[g], 0});
      entry(totals->made, number - 1) += 1;
    }
  }
}

void pressed_tool_bonds::operator()(SmallTasks) const {
  for_rows<ToolContact>(rows.pair.rows(), [&](Row<ToolContact> row) {
    weld(rows, pressure, *rules, row, [&](int g) {
      set_anchor(stand_of(*bodies, at, rows.pair, row), row, g, anchor);
      return BondOpening{};
    });
  });
}

void tool_bond_forces::operator()(SmallTasks) const {
  for_active_pairs(*summed.blocks, summed.sums->blocks, ToolBonds{*this});
}

}  // namespace pulvis
