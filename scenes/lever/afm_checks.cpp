#include "scenes/lever/afm_checks.hpp"
#include "engine/machine_memory.hpp"
#include "engine/portable_math.hpp"
#include "scenes/spec/afm_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "scenes/lever/afm_size.hpp"
#include "scenes/lever/mesh/lever_mesh.hpp"
#include "scenes/lever/mesh/meshed_lever.hpp"
#include "scenes/lever/mesh/meshed_tip.hpp"
#include "scenes/lever/mesh/tip_mesh.hpp"
#include "scenes/lever/target_shape.hpp"
#include "scenes/spec/material_checks.hpp"

namespace pulvis {
namespace {

using TipShape = TipSpec::Shape;

class AfmChecks {
 public:
  AfmChecks(const Scene& scene, const schema::Origins& origins, Problems& problems)
      : scene_(scene),
        lever_(scene.afm->lever),
        tip_(scene.afm->tip),
        origins_(origins),
        problems_(problems) {}

  void run() {
    if (scene_.materials.empty())
      problems_.add({{1, 1}, -1}, "material",
                    "none is declared, allowed: at least one [[material]]");
    check_materials(scene_, [&](const std::string& path, const std::string& message) {
      refuse(path, message);
    });
    coating();
    if (!outline()) return;
    divisions();
    if (!mesh_size()) return;
    tip();
    laser();
    tetrahedra();
    adhesion();
    actions();
  }

 private:
  void refuse(const std::string& path, const std::string& message) {
    auto found = origins_.find(path);
    if (found == origins_.end()) found = origins_.find(path.substr(0, path.find('.')));
    problems_.add(found == origins_.end() ? document::Origin{{1, 1}, -1} : found->second, path,
                  message);
    good_ = false;
  }

  void coating() {
    if (lever_.coating && lever_.coating_thickness == 0 && !lever_.solid)
      refuse("lever.coating_thickness", "required key is missing, allowed: a quantity in m");
  }

  // False where no valid plan exists.
  bool outline() {
    if (lever_.shape != LeverSpec::Shape::v) return good_;
    if (lever_.half_angle.has_value() == lever_.base_width.has_value()) {
      refuse("lever.half_angle",
             "neither or both of half_angle and base_width are given, allowed: "
             "one of them");
      return false;
    }
    if (lever_.base_width && *lever_.base_width <= lever_.apex_width) {
      refuse("lever.base_width", fmt::format("{:g} m is not wider than the apex, allowed: > {:g} m",
                                             *lever_.base_width, lever_.apex_width));
      return false;
    }
    const VOutline v = v_outline(lever_);
    const double widest = v.apex * portable::sin(v.half_angle);
    if (v.inner <= 0)
      refuse("lever.arm_width",
             fmt::format("{:g} m: the arms of this V merge at the clamp, allowed: < {:g} m",
                         lever_.arm_width, widest));
    const double minimum = (v.apex - lever_.length) * portable::sin(v.half_angle);
    if (v.inner >= lever_.length)
      refuse("lever.arm_width", fmt::format("{:g} m: the arms of this V do not meet before its "
                                            "end, allowed: > {:g} m",
                                            lever_.arm_width, minimum));
    return good_;
  }

  // A mesh key without effect is an error.
  void divisions() {
    if (lever_.solid) return;
    const auto given = [&](const char* key) {
      return origins_.contains(std::string("lever.") + key);
    };
    const auto no_say = [&](const char* key, const char* why) {
      if (given(key))
        refuse(std::string("lever.") + key,
               fmt::format("has no effect: {}, allowed: not given", why));
    };
    const bool along = lever_.along > 0, across = lever_.across > 0;
    if (along && across) no_say("aspect", "elements_along and elements_across set the mesh");
    if (across) no_say("side_aspect", "elements_across sets the mesh");
    if (along || across) no_say("foot_layers", "a uniform mesh has none");
    if (tip_.shape == TipShape::none) {
      no_say("foot_edge", "there is no tip");
      no_say("foot_layers", "there is no tip");
    }
    const AspectRange range = aspect_range(lever_);
    constexpr double round_off = 1e-9;
    if (!(along && across) && given("aspect") &&
        (lever_.aspect < range.least * (1 - round_off) ||
         lever_.aspect > range.most * (1 + round_off)))
      refuse("lever.aspect", fmt::format("{:g} is out of range: the lever has 20 to 150 elements "
                                         "of this size along its length, allowed: {:.3g} to {:.3g}",
                                         lever_.aspect, range.least, range.most));
  }

  double half_width_at(double x) const {
    if (lever_.solid) return std::numeric_limits<double>::infinity();  // determined by the mesh
    if (lever_.shape == LeverSpec::Shape::beam) return 0.5 * lever_.width;
    const VOutline v = v_outline(lever_);
    return (v.apex - x) * portable::tan(v.half_angle);
  }

  void tip() {
    if (tip_.shape == TipShape::sphere && tip_.neck_radius >= tip_.radius) {
      refuse("tip.neck_radius", fmt::format("{:g} m: the neck is not thinner than the ball, "
                                            "allowed: < {:g} m",
                                            tip_.neck_radius, tip_.radius));
      return;
    }
    if (tip_.shape == TipShape::mesh && tip_.file.empty() &&
        !(lever_.solid && !lever_.solid->end.empty())) {
      refuse("tip.file",
             "required key is missing, allowed: a file, or a lever of shape mesh whose file has "
             "the volume tip");
      return;
    }
    if (!contact_mesh()) return;
    const double reach = foot_reach(tip_);
    const std::string size = tip_.shape == TipShape::sphere ? "tip.neck_radius" : "tip.foot";
    if (reach >= half_width_at(lever_.length - tip_.set_back) && reach > 0)
      refuse(size, fmt::format("{:g} m: its foot is wider than the lever there, allowed: < {:g} m",
                               tip_.shape == TipShape::sphere ? reach : 2 * reach,
                               (tip_.shape == TipShape::sphere ? 1 : 2) *
                                   half_width_at(lever_.length - tip_.set_back)));
    else if (!foot_on_lever(reach))
      refuse(std::abs(tip_.offset) > 0 ? "tip.offset" : "tip.set_back",
             fmt::format("the tip's foot (x = {:g} m, y = {:g} m, reaching {:g} m) is not on the "
                         "lever, allowed: {:g} m <= set_back < {:g} m and a foot on the lever",
                         lever_.length - tip_.set_back, tip_.offset, reach, reach, lever_.length));
  }

  // Size of a mesh refined at the pole: some 3 (reach/edge)^3 elements.
  bool contact_mesh() {
    if (!tip_.contact_edge) return true;
    const double edge = *tip_.contact_edge;
    const double minimum = tip_.radius / 1000, coarse = tip_.radius / 4;
    if (edge < minimum || edge > coarse)
      refuse("tip.contact_edge",
             fmt::format("{:g} m is too {} for this ball, allowed: {:g} to {:g} m", edge,
                         edge < minimum ? "small" : "large", minimum, coarse));
    const double maximum = std::min(24 * edge, 0.5 * tip_.radius);
    if (tip_.contact_reach && *tip_.contact_reach > maximum)
      refuse("tip.contact_reach",
             fmt::format("{:g} m: the fine mesh is too large, allowed: <= {:g} m (24 times "
                         "contact_edge, half the radius)",
                         *tip_.contact_reach, maximum));
    return good_;
  }

  bool foot_on_lever(double reach) const {
    const PlanMesh plan =
        lever_.solid ? lever_.solid->face.plan : lever_plan(lever_, foot_plan(lever_, tip_)).mesh;
    const Vec2 axis = tip_axis(lever_, tip_);
    if (tip_.solid)
      return std::ranges::all_of(tip_.solid->foot, [&](int n) {
        const Vec2 off = tip_.solid->solid.nodes[static_cast<std::size_t>(n)].head<2>();
        return locate(plan, axis + off).has_value();
      });
    const bool square = tip_.shape == TipShape::block || tip_.shape == TipShape::pyramid;
    for (int i = 0; i < 32; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5) / 32;
      Vec2 off(portable::cos(angle), portable::sin(angle));
      if (square) off /= off.cwiseAbs().maxCoeff();
      if (!locate(plan, axis + reach * off)) return false;
    }
    return axis.x() > 0 && locate(plan, axis);
  }

  void laser() {
    const LaserSpec& laser = scene_.afm->laser;
    const PlanMesh plan =
        lever_.solid ? lever_.solid->back.plan : lever_plan(lever_, foot_plan(lever_, tip_)).mesh;
    const Vec2 middle(laser.position.value_or(lever_.length - tip_.set_back), laser.offset);
    for (int i = 0; i < 8; ++i) {
      const double angle = 0.25 * std::numbers::pi * i;
      if (locate(plan, middle + laser.radius * Vec2(portable::cos(angle), portable::sin(angle))))
        continue;
      refuse("laser.position",
             fmt::format("the spot (x = {:g} m, y = {:g} m, radius {:g} m) is not on the lever, "
                         "allowed: {}",
                         middle.x(), middle.y(), laser.radius, places_for_laser(middle.x())));
      return;
    }
  }

  std::string places_for_laser(double x) const {
    if (lever_.solid) return "on the elements of the file's surface 'back'";
    const std::string along = fmt::format("0 to {:g} m along it", lever_.length);
    if (x < 0 || x > lever_.length) return along;
    const bool v = lever_.shape == LeverSpec::Shape::v;
    const double opening = v ? v_outline(lever_).inner : 0;
    if (x >= opening)
      return fmt::format("{}, within {:g} m of its axis there", along, half_width_at(x));
    return fmt::format(
        "{}; before x = {:g} m the V is open, and its arms are {:g} to {:g} m from "
        "its axis there",
        along, opening, (opening - x) * portable::tan(v_outline(lever_).half_angle),
        half_width_at(x));
  }

  // Tetrahedra have no plastic history variables.
  void tetrahedra() {
    const auto yields = [&](int material) {
      return scene_.materials[static_cast<std::size_t>(material)].yield_stress.has_value();
    };
    const auto check = [&](const GmshSolid& solid, const std::string& path) {
      if (solid.tetrahedra.empty()) return;
      for (const auto& [part, material, key] :
           {std::tuple{SolidPart::lever, lever_.material, "lever.material"},
            {SolidPart::coating, lever_.coating.value_or(lever_.material), "lever.coating"},
            {SolidPart::tip, tip_.material, "tip.material"},
            {SolidPart::glue, tip_.glue.value_or(tip_.material), "tip.glue"}})
        if (solid.has(part) && yields(material))
          refuse(key, fmt::format("it has a yield stress, but the tetrahedra of {} are elastic "
                                  "only, allowed: hexahedra, or a material without a yield_stress",
                                  path));
    };
    if (lever_.solid) check(lever_.solid->solid, "lever.file");
    if (tip_.solid) check(tip_.solid->solid, "tip.file");
  }

  // Checked before meshing, which alone may take minutes and gigabytes.
  bool mesh_size() {
    const AfmScene& afm = *scene_.afm;
    const SolidSize size = afm_size(afm);
    if (!is_too_large(size)) return true;
    const std::string what = fmt::format("about {:.3g} elements and {}", size.elements,
                                         bytes_text(static_cast<std::uint64_t>(size.bytes())));
    const std::string limit =
        fmt::format("{:g} elements and {:.3g} numbers in the factors of their stiffness",
                    max_solid_elements, max_solid_factors);
    if (tip_size(afm).factors >= lever_size(afm).factors && tip_.shape != TipShape::mesh)
      refuse("tip.elements", fmt::format("{}: {}, allowed: at most {}, which keeps within {}",
                                         tip_.elements, what, max_tip_elements(), limit));
    else
      refuse(size_key(), fmt::format("{}, allowed: at most {}", what, limit));
    return false;
  }

  int max_tip_elements() const {
    AfmScene afm = *scene_.afm;
    while (afm.tip.elements > 2 && is_too_large(afm_size(afm))) afm.tip.elements -= 2;
    return afm.tip.elements;
  }

  // The key that determines the size of the lever's mesh.
  std::string size_key() const {
    if (tip_size(*scene_.afm).factors >= lever_size(*scene_.afm).factors) return "tip.file";
    if (lever_.solid) return "lever.file";
    if (lever_.along > 0 || lever_.across > 0)
      return lever_.along >= lever_.across ? "lever.elements_along" : "lever.elements_across";
    return lever_.layers > 1 ? "lever.layers" : "lever.aspect";
  }

  // JKR is the law of a ball on a plane and includes its elasticity.
  void adhesion() {
    if (!scene_.afm->target) return;
    const TargetSpec& target = *scene_.afm->target;
    const auto only_with = [&](const char* key, const char* law, bool given) {
      if (given)
        refuse(key, fmt::format("belongs to another law, allowed: with adhesion = \"{}\"", law));
    };
    if (target.adhesion == TargetSpec::Adhesion::dmt)
      return only_with("surface.work_of_adhesion", "jkr", target.work != 0);
    only_with("surface.pull_off", "dmt", target.pull_off != 0);
    only_with("surface.adhesion_range", "dmt", origins_.contains("surface.adhesion_range"));
    if (target.work == 0)
      refuse("surface.work_of_adhesion", "required key is missing, allowed: a quantity in J/m^2");
    if (tip_.shape != TipShape::sphere)
      refuse("surface.adhesion",
             "jkr is the law of an elastic ball, allowed: a tip of shape sphere");
    if (target.shape != TargetSpec::Shape::plane)
      refuse("surface.adhesion",
             "jkr is the law of a ball on a plane, allowed: a surface of shape "
             "plane");
    if (tip_.contact_edge)
      refuse("tip.contact_edge",
             "with jkr the contact of the ball follows from its law, not from its mesh, allowed: "
             "not given");
  }

  void actions() {
    const AfmScene& afm = *scene_.afm;
    if (afm.actions.empty()) return;
    if (!afm.target)
      return refuse("action[0]", "there is no surface, allowed: [[action]] with a [surface]");
    bool pressed = false;
    for (std::size_t i = 0; i < afm.actions.size(); ++i) {
      const ActionSpec& action = afm.actions[i];
      const std::string path = fmt::format("action[{}]", i);
      const bool press = action.kind == ActionSpec::Kind::press;
      if (press && (action.distance != 0) == action.force.has_value())
        refuse(path + ".distance", "neither or both of distance and force are given, allowed: one");
      if (!press && action.kind != ActionSpec::Kind::hold && action.distance == 0)
        refuse(path + ".distance", "0 m: nothing moves, allowed: any other distance");
      if (action.servo && !pressed)
        refuse(path + ".set_point", "there is no force to hold yet, allowed: after a press");
      pressed = pressed || press;
    }
    map();
    wave();
  }

  void map() {
    const TargetSpec& target = *scene_.afm->target;
    if (target.shape != TargetSpec::Shape::map) return;
    try {
      const auto heights = read_height_map(scene_.file.parent_path() / target.file, target.dataset);
      steepness(heights);
      inside_map(TargetSpec::Direction::lateral, heights.size());
      inside_map(TargetSpec::Direction::along, heights.front().size());
    } catch (const std::runtime_error& error) {
      refuse("surface.file",
             fmt::format("'{}': {}, allowed: lines of numbers in m, separated by commas, all of "
                         "the same length, or an HDF5 file with the dataset",
                         target.file, error.what()));
    }
  }

  void steepness(const std::vector<std::vector<double>>& heights) {
    constexpr double steepest = 100;  // like the flanks of a bump
    const TargetSpec& target = *scene_.afm->target;
    const double step = steepest_step(heights);
    if (!(step <= steepest * target.spacing))
      refuse("surface.file",
             fmt::format("'{}': two neighbouring heights differ by {:g} m, allowed: up to {:g} "
                         "times the spacing, {:g} m",
                         target.file, step, steepest, steepest * target.spacing));
  }

  // A wave is generated as far as the probe may move.
  void wave() {
    constexpr std::size_t maximum = 1'000'000;
    const TargetSpec& target = *scene_.afm->target;
    const std::size_t corners = profile_corners(target, reach_of(*scene_.afm));
    if (corners > maximum)
      refuse("surface.wavelength",
             fmt::format("{:g} m: {} facets along the path, allowed: {} at most", target.wavelength,
                         corners, maximum));
  }

  // Range of the probe's end on the map, ignoring its deflection.
  void inside_map(TargetSpec::Direction direction, std::size_t points) {
    const double bound = 0.5 * scene_.afm->target->spacing * static_cast<double>(points - 1);
    double at = 0;
    for (std::size_t i = 0; i < scene_.afm->actions.size(); ++i) {
      const ActionSpec& action = scene_.afm->actions[i];
      const bool raster = action.kind == ActionSpec::Kind::raster;
      if (!raster && action.kind != ActionSpec::Kind::scan) continue;
      const bool fast = action.direction == direction;
      if (!fast && !raster) continue;
      const double distance = fast ? action.distance : action.width;
      if (std::abs(at + distance) > bound)
        refuse(fmt::format("action[{}].{}", i, fast ? "distance" : "width"),
               fmt::format("the scan leaves the map: it reaches {:g} m, allowed: {:g} to {:g} m",
                           at + distance, -bound, bound));
      if (raster ? !fast : !action.retrace) at += distance;
    }
  }

  const Scene& scene_;
  const LeverSpec& lever_;
  const TipSpec& tip_;
  const schema::Origins& origins_;
  Problems& problems_;
  bool good_ = true;
};

}  // namespace

void check_afm(const Scene& scene, const schema::Origins& origins, Problems& problems) {
  AfmChecks(scene, origins, problems).run();
}

}  // namespace pulvis
