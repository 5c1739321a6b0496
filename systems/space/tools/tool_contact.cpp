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
  if (c.history) Lane{}.store(&c.history->lost(row) + lane_count * half);
}

// Motion of the touching halves of a candidate (bit 0, bit 1); the others are separated.
struct RowMotion {
  std::array<PointMotion, 2> half;
  unsigned touching = 0;

  bool touches(int h) const { return (touching >> h & 1) != 0; }
};

// If friction is more than a Coulomb coefficient, else null.
const ContactRules::Friction* weakening_of(const tool_contact& s, Row<FaceToolContact> row) {
  if (!s.columns.history) return nullptr;
  const auto& slots = s.bodies.bodies->slots;
  const ContactRules::Friction& friction = s.columns.history->rules->friction_with_tool(
      s.columns.pair(row, 2), entry(slots, s.columns.pair(row, 0)).material);
  return friction.only_coulomb() ? nullptr : &friction;
}

// Forces on the touching halves of a candidate: law, columns, sums.
void act(const tool_contact::Columns& c, Row<FaceToolContact> row, const Shape::Face& face,
         const RowMotion& motion, const ContactRules::Friction* weakening, double dt,
         FaceSums& sums) {
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
      if (weakening == nullptr) {
        pulvis::kernels::Coulomb<Lane> coulomb{law.friction};
        add_friction(law, m, dt, pressure, before, coulomb, f);
      } else {
        double* lost = &c.history->lost(row) + lane_count * half;
        add_weakening_friction({*weakening, 1, new_touch ? Lane{} : Lane::load(lost)}, law, m, dt,
                               pressure, before, f)
            .store(lost);
      }
      store_half(f.elastic_slip, spring, half);
    }
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
    RowMotion motion;
    for (int half = 0; half < 2; ++half) stand(row, half, own, face.size, motion);
    if (motion.touching == 0) {
      s.columns.touches(row) = 0;
      return;
    }
    if (!rates.empty())
      for (int half = 0; half < 2; ++half)
        if (motion.touches(half))
          set_rates(row, sampled_points({rates.data() + s.bodies.surface(slot), own.number}, half),
                    entry(motion.half, half));
    act(s.columns, row, face, motion, weakening_of(s, row), s.clock->dt_before, sums);
  }

 private:
  // A separated half stays inactive until it can touch.
  void stand(Row<FaceToolContact> row, int half, const PatchNumbers& face, double size,
             RowMotion& motion) const {
    double& activation = s.columns.activation(row, half);
    if (s.clock->travel < activation) return;
    const Standing standing = project(row, sampled_points(face, half), size);
    if (any(standing.gap > 0.0)) {
      entry(motion.half, half) = {standing.gap, standing.normal};
      motion.touching |= 1U << half;
      activation = 0;
    } else {
      activation = s.clock->travel - FaceSums::greatest(standing.gap);
    }
  }
  Standing project(Row<FaceToolContact> row, const VectorLanes& at, double size) const {
    return standing_on_tool(s.tools, s.triangles, s.columns.pair(row, 2), row, at, size);
  }
  // For tools that do not rotate.
  void set_rates(Row<FaceToolContact> row, const VectorLanes& velocity, PointMotion& m) const {
    const Row<Tool> tool(s.columns.pair(row, 2));
    const VectorLanes relative =
        velocity -
        everywhere({s.tool_velocity(tool, 0), s.tool_velocity(tool, 1), s.tool_velocity(tool, 2)});
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
