// tool_contact: narrow phase between particles and rigid tools in three dimensions: the Gauss points of every candidate
// face against the tool's surface.
//
// Stages   tool_standing.hpp -> contact_law.hpp, eight points at a time; one pass with the full stiffness, since a tool
//          is not sampled
// Runs     after bin_tool_faces and tool_motion, before contact_force
// Active   if the scene has tools
#include "engine/prefetch.hpp"
#include "systems/space/contact/blocks.hpp"
#include "systems/space/contact/gauss_points.hpp"
#include "systems/space/tools/systems.hpp"
#include "systems/space/tools/tool_standing.hpp"

namespace pulvis::space {
namespace {

// Zeroes the values of a half in the columns.
void clear_half(const tool_contact::Columns& c, Row<FaceToolContact> row, int half) {
  const VectorLanes none{Lane{}, Lane{}, Lane{}};
  store_half(none, &c.force(row), half);
  if (c.slip) store_half(none, &(*c.slip)(row), half);
  if (c.lost) Lane{}.store(&(*c.lost)(row) + lane_count * half);
}

// Motion of the touching halves of a candidate (bit 0, bit 1); the others are separated.
struct RowMotion {
  std::array<PointMotion, 2> half;
  unsigned touching = 0;

  bool touches(int h) const { return (touching >> h & 1) != 0; }
};

struct RowRules {
  const ContactRules::Friction* weakening =
      nullptr;  // if friction is more than a Coulomb coefficient
  ContactRules::Adhesion adhesion;
};
RowRules rules_of(const tool_contact& s, Row<FaceToolContact> row) {
  const int tool = s.columns.pair(row, 2);
  const int material = entry(s.bodies.bodies->slots, s.columns.pair(row, 0)).material;
  RowRules rules{nullptr, s.rules->adhesion_with_tool(tool, material)};
  if (!s.columns.lost) return rules;
  const ContactRules::Friction& friction = s.rules->friction_with_tool(tool, material);
  if (!friction.only_coulomb()) rules.weakening = &friction;
  return rules;
}

// Forces on the touching halves of a candidate: law, columns, sums.
void act(const tool_contact::Columns& c, Row<FaceToolContact> row, const Shape::Face& face,
         const RowMotion& motion, const RowRules& rules, double dt, FaceSums& sums) {
  using Law = ContactLaw<FaceToolContact>;
  const bool new_touch = c.touches(row) == 0;
  c.touches(row) = 1;
  sums.block.touching += 1;
  Lane deepest{};
  for (int half = 0; half < 2; ++half) {
    if (!motion.touches(half)) {
      clear_half(c, row, half);
      continue;
    }
    const PointMotion& m = entry(motion.half, half);
    const PointLaw law{Lane(c.law(row, Law::stiffness)), Lane(c.law(row, Law::friction)),
                       Lane(c.law(row, Law::damping)), Lane(c.law(row, Law::inv_size)),
                       Lane::load(face.weight.data() + lane_count * half)};
    Lane pressure;
    PointForces f = normal_forces(law, m, dt, pressure);
    if (c.slip) {
      double* spring = &(*c.slip)(row);
      const VectorLanes before = new_touch ? VectorLanes{} : load_half(spring, half);
      if (rules.weakening == nullptr) {
        pulvis::kernels::Coulomb<Lane> coulomb{law.friction};
        add_friction(law, m, dt, pressure, before, coulomb, f);
      } else {
        double* lost = &(*c.lost)(row) + lane_count * half;
        add_weakening_friction({*rules.weakening, 1, new_touch ? Lane{} : Lane::load(lost)}, law, m,
                               dt, pressure, before, f)
            .store(lost);
      }
      store_half(f.elastic_slip, spring, half);
    }
    if (rules.adhesion.range > 0)
      attract(law, m, Lane(rules.adhesion.traction), rules.adhesion.range, f);
    store_half(f.force, &c.force(row), half);
    sums.add(f);
    deepest = max(m.gap, deepest);
  }
  sums.book_depth(row.value, FaceSums::greatest(deepest) * c.law(row, Law::inv_size));
}

struct ToolPass {
  const tool_contact& s;
  std::span<const double> points = s.faces.position.values();
  std::span<const double> rates =
      s.faces.velocity ? s.faces.velocity->values() : std::span<const double>{};

  bool active(Row<FaceToolContact> row) const {
    return s.clock->travel >= std::min(s.columns.activation(row, 0), s.columns.activation(row, 1));
  }
  void fetch(Row<FaceToolContact> row) const { prefetch(&s.columns.force(row)); }
  void operator()(Row<FaceToolContact> row, FaceSums& sums) const {
    const int slot = s.columns.pair(row, 0);
    const Shape::Face& face = entry(s.bodies.shape_of(slot).faces, s.columns.pair(row, 1));
    const PatchNumbers own{points.data() + s.bodies.surface(slot), face.number.data()};
    const RowRules rules = rules_of(s, row);
    RowMotion motion;
    for (int half = 0; half < 2; ++half)
      stand(row, half, own, {face.size, rules.adhesion.range}, motion);
    if (motion.touching == 0) {
      s.columns.touches(row) = 0;
      return;
    }
    if (!rates.empty())
      for (int half = 0; half < 2; ++half)
        if (motion.touches(half))
          set_rates(row, sampled_points({rates.data() + s.bodies.surface(slot), own.number}, half),
                    entry(motion.half, half));
    act(s.columns, row, face, motion, rules, s.clock->dt_before, sums);
  }

 private:
  struct Reach {
    double size;   // m, of the face
    double range;  // m, of forces
  };
  // A half out of reach stays inactive until it can come within it.
  void stand(Row<FaceToolContact> row, int half, const PatchNumbers& face, const Reach& reach,
             RowMotion& motion) const {
    double& activation = s.columns.activation(row, half);
    if (s.clock->travel < activation) return;
    const Standing standing = project(row, sampled_points(face, half), reach.size + reach.range);
    if (any(standing.gap > -reach.range)) {
      entry(motion.half, half) = {standing.gap, standing.normal};
      motion.touching |= 1U << half;
      activation = 0;
    } else {
      activation = s.clock->travel - FaceSums::greatest(standing.gap + reach.range);
    }
  }
  Standing project(Row<FaceToolContact> row, const VectorLanes& at, double farthest) const {
    return standing_on_tool(s.tools.surfaces, s.tools.triangles, s.columns.pair(row, 2), row, at,
                            farthest);
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
  for_active_rows(*columns.blocks, sums->blocks, ToolPass{*this});
}

}  // namespace pulvis::space
