// tool_contact: narrow phase between particles and rigid tools in three dimensions: the Gauss points of every candidate
// face against the tool's surface.
//
// Stages   tool_gap.hpp -> contact_law.hpp, eight points at a time; one pass with the full stiffness, since a tool
//          is not sampled
// Runs     after bin_tool_faces and tool_motion, before contact_force
// Active   if the scene has tools
#include "engine/prefetch.hpp"
#include "systems/space/contact/blocks.hpp"
#include "systems/space/contact/bond_points.hpp"
#include "systems/space/contact/gauss_points.hpp"
#include "systems/space/tools/systems.hpp"
#include "systems/space/tools/tool_anchors.hpp"
#include "systems/space/tools/tool_gap.hpp"

namespace pulvis::space {
namespace {

// Zeroes the values of a half in the columns.
void clear_half(const tool_contact::Columns& c, Row<FaceToolContact> row, int half) {
  const VectorLanes none{Lane{}, Lane{}, Lane{}};
  store_half(none, &c.force(row), half);
  if (c.sliding.slip) store_half(none, &(*c.sliding.slip)(row), half);
  if (c.sliding.lost) Lane{}.store(&(*c.sliding.lost)(row) + lane_count * half);
}

// Motion of the touching halves of a candidate (bit 0, bit 1); the others are separated.
struct RowMotion {
  std::array<VectorLanes, 2> at;  // m, of the points
  std::array<PointMotion, 2> half;
  std::array<VectorLanes, 2>
      along;  // m, of bonded points from the place that holds them, in the tangent plane
  unsigned touching = 0;
  unsigned bonded = 0;  // bit g: point g, at the start of the step

  bool touches(int h) const { return (touching >> h & 1) != 0; }
  unsigned bonded_in(int h) const { return bonded >> lane_count * h & 0xffU; }
};

struct RowRules {
  const FrictionParameters* weakening = nullptr;  // if friction is more than a Coulomb coefficient
  AdhesionParameters adhesion;
};
RowRules rules_of(const tool_contact& s, Row<FaceToolContact> row) {
  const int tool = s.columns.pair(row, 2);
  const int material = entry(s.bodies.bodies->slots, s.columns.pair(row, 0)).material;
  const SurfaceLaws& laws = s.rules->with_tool(tool, material);
  RowRules rules{nullptr, laws.adhesion};
  if (!s.columns.sliding.lost) return rules;
  const FrictionParameters& friction = laws.friction;
  if (!friction.only_coulomb()) rules.weakening = &friction;
  return rules;
}

struct ToolSums {
  FaceSums contact;
  BondSumsOfBlock bonds;
};

// A candidate: a face against a tool.
struct ToolRow {
  Row<FaceToolContact> row;
  const Shape::Face& face;
  RowRules rules;
  Point tool;  // m, its position
};

// ---- bonds of a row ------------------------------------------------------------------------------
using ToolBonds = tool_contact::Bonds;

PointBonds<FaceToolContact> bonds_of(const tool_contact& s, Row<FaceToolContact> row,
                                     BondSumsOfBlock& sums) {
  const BondRules& rules = *s.bonds->columns.rules;
  const int slot = s.columns.pair(row, 0), tool = s.columns.pair(row, 2);
  const Bodies::Slot& body = entry(s.bodies.bodies->slots, slot);
  return {
      s.bonds->columns,
      s.clock->time,
      {rules.initial_with_tool(tool, body), rules.pressed_with_tool(tool, body), slot, -1 - tool},
      1,
      sums};
}

PlacesInRows places_in(Row<FaceToolContact> row, int half) {
  PlacesInRows places;
  places.row.fill(static_cast<std::int32_t>(row.value));
  for (int l = 0; l < lane_count; ++l) entry(places.point, l) = lane_count * half + l;
  return places;
}

// Of the bonded points, the position relative to the places that hold them.
void gap_at_anchors(const ToolBonds& bonds, const ToolRow& of, int half, RowMotion& motion) {
  const double* anchor = &bonds.anchor(of.row);
  const LaneMask bonded = LaneMask::of(motion.bonded_in(half));
  PointMotion& m = entry(motion.half, half);
  m.normal = select(bonded, load_half(anchor + ToolAnchor::normal, half), m.normal);
  const VectorLanes d = entry(motion.at, half) - everywhere(of.tool) - load_half(anchor, half);
  m.gap = select(bonded, -dot(d, m.normal), m.gap);
  const VectorLanes none{Lane{}, Lane{}, Lane{}};
  entry(motion.along, half) = select(bonded, fma(m.gap, m.normal, d), none);
}

// Adds the forces of bonded points to those of contact, and bonds those that pressure has welded.
void bond(const tool_contact& s, const ToolRow& of, int half, const RowMotion& motion,
          const PointLaw& law, const Lane& pressure, PointForces& f, BondSumsOfBlock& sums) {
  const PointBonds<FaceToolContact> bonds = bonds_of(s, of.row, sums);
  const PlacesInRows places = places_in(of.row, half);
  std::array<std::int32_t, lane_count> face;
  face.fill(s.columns.pair(of.row, 1));
  const PointMotion& m = entry(motion.half, half);
  const VectorLanes& at = entry(motion.at, half);
  if (bonds.may_weld())
    set_anchors(s.bonds->anchor, {of.row, half, bonds.press(places, 0xffU, pressure)}, at,
                {m.gap, m.normal}, of.tool);
  if (const unsigned bonded = motion.bonded_in(half); bonded != 0)
    bonds.hold({places, bonded, face, at, entry(motion.along, half)}, law, m, f);
}

// Of the sampled face; what is bonded does not indent.
pulvis::kernels::Hardness<Lane> hardness_of(const tool_contact& s, Row<FaceToolContact> row,
                                            unsigned bonded) {
  using Number = SurfaceHardness<ThreeD>;
  const auto& hardness = *s.faces.hardness;
  const std::ptrdiff_t face =
      first_row(hardness.table(), s.columns.pair(row, 0)) + s.columns.pair(row, 1);
  const double* number = hardness.values().data() + Number::count * face;
  const LaneMask held = LaneMask::of(bonded);
  return {select(held, Lane(pulvis::kernels::no_hardness), Lane(number[Number::pressure])),
          select(held, Lane(1.0), Lane(number[Number::left]))};
}

// ---- a row -----------------------------------------------------------------------------------------
// Forces on the touching halves of a candidate: law, columns, sums.
void act(const tool_contact& s, const ToolRow& of, RowMotion& motion, ToolSums& sums) {
  using Law = ContactLaw<FaceToolContact>;
  const tool_contact::Columns& c = s.columns;
  const Row<FaceToolContact> row = of.row;
  const double dt = s.clock->dt_before;
  const bool new_touch = c.touches(row) == 0;
  c.touches(row) = 1;
  Lane deepest{};
  for (int half = 0; half < 2; ++half) {
    if (!motion.touches(half)) {
      clear_half(c, row, half);
      continue;
    }
    PointMotion& m = entry(motion.half, half);
    const PointLaw law{Lane(c.law(row, Law::stiffness)),
                       Lane(c.law(row, Law::friction)),
                       Lane(c.law(row, Law::damping)),
                       Lane(c.law(row, Law::inv_size)),
                       Lane::load(of.face.weight.data() + lane_count * half),
                       Lane(s.rules->tangential * c.law(row, Law::stiffness))};
    Lane pressure, indenting{};
    if (c.indentation) {
      double* indentation = &(*c.indentation)(row) + lane_count * half;
      indenting =
          indent(law, Lane::load(indentation), hardness_of(s, row, motion.bonded_in(half)), 1, m);
      m.indentation.store(indentation);
    }
    PointForces f = normal_forces(law, m, dt, pressure);
    f.indentation_work = indenting * law.weight;
    if (c.sliding.slip) {
      double* spring = &(*c.sliding.slip)(row);
      const VectorLanes before = new_touch ? VectorLanes{} : load_half(spring, half);
      if (of.rules.weakening == nullptr) {
        pulvis::kernels::Coulomb<Lane> coulomb{law.friction};
        add_friction(law, m, dt, pressure, before, coulomb, f);
      } else {
        double* lost = &(*c.sliding.lost)(row) + lane_count * half;
        add_weakening_friction({*of.rules.weakening, 1, new_touch ? Lane{} : Lane::load(lost)}, law,
                               m, dt, pressure, before, f)
            .store(lost);
      }
      store_half(f.elastic_slip, spring, half);
    }
    if (of.rules.adhesion.range > 0) attract(law, m, of.rules.adhesion, 1.0, f);
    if (s.bonds) bond(s, of, half, motion, law, pressure, f, sums.bonds);
    store_half(f.force, &c.force(row), half);
    sums.contact.add(f);
    deepest = max(m.pressing(), deepest);
  }
  const double depth = FaceSums::greatest(deepest);
  // Where all points are inside their indentations, nothing acts.
  if (!c.indentation || !(depth <= 0) || motion.bonded != 0 || of.rules.adhesion.range > 0)
    sums.contact.block.touching += 1;
  sums.contact.record_depth(row.value, depth * c.law(row, Law::inv_size));
}

struct ToolPass {
  using Sums = ToolSums;
  const tool_contact& s;
  std::span<const double> points = s.faces.position.values();
  std::span<const double> rates =
      s.faces.velocity ? s.faces.velocity->values() : std::span<const double>{};

  bool active(Row<FaceToolContact> row) const {
    return s.clock->relative_motion >=
           std::min(s.columns.activation(row, 0), s.columns.activation(row, 1));
  }
  void fetch(Row<FaceToolContact> row) const { prefetch(&s.columns.force(row)); }
  void operator()(Row<FaceToolContact> row, Sums& sums) const {
    const int slot = s.columns.pair(row, 0);
    const Shape::Face& face = entry(s.bodies.shape_of(slot).faces, s.columns.pair(row, 1));
    const PatchNumbers own{points.data() + s.bodies.outline_begin(slot), face.number.data()};
    const ToolRow of{row, face, rules_of(s, row),
                     s.tools.surfaces.position_of(s.columns.pair(row, 2))};
    RowMotion motion;
    if (s.bonds) motion.bonded = bonds_of(s, row, sums.bonds).bonded(row);
    for (int half = 0; half < 2; ++half) {
      if (s.clock->relative_motion < s.columns.activation(row, half)) continue;
      entry(motion.at, half) = sampled_points(own, half);
      find_gap(of, half, motion, sums);
    }
    if (motion.touching == 0) {
      s.columns.touches(row) = 0;
      return;
    }
    if (!rates.empty())
      for (int half = 0; half < 2; ++half)
        if (motion.touches(half))
          set_rates(row,
                    sampled_points({rates.data() + s.bodies.outline_begin(slot), own.number}, half),
                    entry(motion.half, half));
    act(s, of, motion, sums);
  }
  void keep(int block, Sums& sums) const {
    entry(s.sums->blocks, block) = sums.contact.added_up();
    if (s.bonds) entry(s.bonds->sums->blocks, block) = sums.bonds.added_up();
  }

 private:
  // A half out of reach stays inactive until it can come within it.
  void find_gap(const ToolRow& of, int half, RowMotion& motion, Sums& sums) const {
    const VectorLanes& at = entry(motion.at, half);
    const double range = of.rules.adhesion.range;
    const SurfaceGap nearest =
        gap_to_tool(s.tools.surfaces, s.tools.triangles, s.columns.pair(of.row, 2), of.row, at,
                    of.face.size + range);
    PointMotion& m = entry(motion.half, half);
    m = {nearest.gap, nearest.normal};
    double& activation = s.columns.activation(of.row, half);
    const bool bonded = motion.bonded_in(half) != 0;
    if (bonded) gap_at_anchors(*s.bonds, of, half, motion);
    if (s.bonds)
      m.overlap = bonds_of(s, of.row, sums.bonds)
                      .overlap(places_in(of.row, half), 0xffU, motion.bonded_in(half), m.gap);
    if (bonded || any(m.depth() > -range)) {
      motion.touching |= 1U << half;
      activation = 0;
      return;
    }
    activation = s.clock->relative_motion - FaceSums::greatest(m.depth() + range);
    if (s.bonds && weld_apart(of, half, at, m, sums)) activation = 0;
  }
  // The pressure of points that have separated has dropped. Returns whether any weld held them.
  bool weld_apart(const ToolRow& of, int half, const VectorLanes& at, const PointMotion& m,
                  Sums& sums) const {
    const PointBonds<FaceToolContact> bonds = bonds_of(s, of.row, sums.bonds);
    if (!bonds.may_weld()) return false;
    const unsigned made = bonds.press(places_in(of.row, half), 0xffU, Lane{});
    set_anchors(s.bonds->anchor, {of.row, half, made}, at, {m.gap, m.normal}, of.tool);
    return made != 0;
  }
  // For tools that do not rotate.
  void set_rates(Row<FaceToolContact> row, const VectorLanes& velocity, PointMotion& m) const {
    const Row<Tool> tool(s.columns.pair(row, 2));
    const VectorLanes relative =
        velocity - everywhere({s.tools.velocity(tool, 0), s.tools.velocity(tool, 1),
                               s.tools.velocity(tool, 2)});
    const Lane closing = dot(relative, m.normal);
    m.gap_rate = -closing;
    m.slip = fma(-closing, m.normal, relative);
  }
};

}  // namespace

void tool_contact::operator()(SmallTasks) const {
  const auto blocks = static_cast<std::size_t>(columns.blocks->count());
  sums->blocks.resize(blocks);
  if (bonds) bonds->sums->blocks.resize(blocks);
  for_active_rows(*columns.blocks, ToolPass{*this});
}

}  // namespace pulvis::space
