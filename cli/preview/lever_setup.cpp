#include "cli/preview/lever_setup.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/preview/rims.hpp"
#include "engine/enum_table.hpp"
#include "scenes/checks/lever_warnings.hpp"
#include "scenes/lever/mesh/foot_plan.hpp"
#include "scenes/lever/mesh/lever_plan.hpp"
#include "scenes/lever/target_shape.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis {
namespace {

using nlohmann::json;

constexpr EnumTable<SolidPart> part_names{"lever", "coating", "tip", "glue"};
constexpr EnumTable<LeverSpec::Shape> lever_shapes{"beam", "v", "mesh"};
constexpr EnumTable<TipSpec::Shape> tip_shapes{"none", "block",  "pyramid",
                                               "cone", "sphere", "mesh"};
constexpr EnumTable<TargetSpec::Shape> surface_shapes{"plane", "bump", "step", "sinusoid", "map"};
constexpr EnumTable<ActionSpec::Kind> action_kinds{"press", "scan", "retract", "hold", "raster"};
constexpr EnumTable<TargetSpec::Direction> direction_names{"lateral", "along"};

struct Part {
  std::vector<Face> faces;  // all of its elements' faces
  std::vector<std::size_t> nodes;
};

std::map<std::uint8_t, Part> parts_of(const SolidMesh& mesh) {
  static constexpr std::array<std::array<std::size_t, 4>, 6> of_hexahedron{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  static constexpr std::array<std::array<std::size_t, 3>, 4> of_tetrahedron{
      {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  std::map<std::uint8_t, Part> parts;
  const auto add = [&](std::uint8_t part, const auto& element, const auto& faces) {
    for (const auto& face : faces) {
      Face of;
      for (const std::size_t corner : face) of.push_back(static_cast<std::size_t>(element[corner]));
      parts[part].faces.push_back(std::move(of));
    }
    for (const auto node : element) parts[part].nodes.push_back(static_cast<std::size_t>(node));
  };
  for (std::size_t e = 0; e < mesh.hexahedra.size(); ++e)
    add(mesh.part[e], mesh.hexahedra[e], of_hexahedron);
  for (std::size_t e = 0; e < mesh.tetrahedra.size(); ++e)
    add(mesh.tetrahedron_part[e], mesh.tetrahedra[e], of_tetrahedron);
  return parts;
}

// Faces of only one element that point up or down, in the upper half of the body; all turned to point up.
std::vector<Face> upper_faces(const std::vector<Face>& faces, const std::vector<Vec3>& at) {
  std::map<Face, int> seen;
  const auto key = [](Face face) {
    std::ranges::sort(face);
    return face;
  };
  for (const Face& face : faces) ++seen[key(face)];
  std::vector<Face> upper;
  for (Face face : faces) {
    if (seen[key(face)] > 1) continue;
    Vec3 middle = Vec3::Zero();
    for (const std::size_t node : face) middle += at[node] / static_cast<double>(face.size());
    const Vec3 normal = (at[face[1]] - at[face[0]]).cross(at[face[2]] - at[face[0]]).normalized();
    if (std::abs(normal.z()) < 0.7 || middle.z() < 0) continue;
    if (normal.z() < 0) std::ranges::reverse(face);
    upper.push_back(std::move(face));
  }
  return upper;
}

json pairs(const std::vector<PlanePoint>& points) {
  json out = json::array();
  for (const PlanePoint& point : points) out.push_back(json::array({point[0], point[1]}));
  return out;
}

json hull_of(const Part& part, const std::vector<Vec3>& at, int across, int up) {
  std::vector<PlanePoint> points;
  for (const std::size_t node : part.nodes) points.push_back({at[node][across], at[node][up]});
  return pairs(convex_hull(std::move(points)));
}

json parts_setup(const AfmModel& model) {
  const double* x = model.world->column<ReferencePosition>().values();
  std::vector<Vec3> at;
  for (std::size_t n = 0; n < model.nodes; ++n) {
    const Vec3 place(x + 3 * n);
    at.emplace_back(model.axis.dot(place), model.side.dot(place), model.up.dot(place));
  }
  json out = json::object();
  for (const auto& [number, part] : parts_of(model.world->resource<SolidMesh>())) {
    json plan = json::array();
    if (number == static_cast<std::uint8_t>(SolidPart::lever))
      for (const Loop& loop : rims_of(upper_faces(part.faces, at))) {
        plan.push_back(json::array());
        for (const std::size_t node : loop) plan.back().push_back({at[node].x(), at[node].y()});
      }
    else
      plan.push_back(hull_of(part, at, 0, 1));
    out[part_names[static_cast<SolidPart>(number)]] = {
        {"plan", plan}, {"side", hull_of(part, at, 0, 2)}, {"front", hull_of(part, at, 1, 2)}};
  }
  return out;
}

const std::string& material_name(const Scene& scene, int material) {
  return scene.materials[static_cast<std::size_t>(material)].name;
}

json dimensions_setup(const Scene& scene) {
  const LeverSpec& lever = scene.afm->lever;
  json out{{"shape", lever_shapes[lever.shape]},
           {"material", material_name(scene, lever.material)},
           {"length", lever.length},
           {"thickness", lever.thickness},
           {"tilt", lever.tilt}};
  if (lever.shape == LeverSpec::Shape::beam) out["width"] = lever.width;
  if (lever.shape == LeverSpec::Shape::v) {
    const VOutline v = v_outline(lever);
    out["arm_width"] = lever.arm_width;
    out["half_angle"] = v.half_angle;
    out["base_width"] = v.base_width;
  }
  if (lever.shape == LeverSpec::Shape::mesh) out["file"] = lever.file;
  if (lever.coating) {
    out["coating"] = material_name(scene, *lever.coating);
    out["coating_thickness"] = lever.coating_thickness;
  }
  if (const auto k = rough_stiffness(scene)) out["rough_stiffness"] = *k;
  return out;
}

json tip_setup(const Scene& scene, const AfmModel& model) {
  const TipSpec& tip = scene.afm->tip;
  const Vec2 axis = tip_axis(scene.afm->lever, tip);
  const Vec3 end = read(model.end, model.world->column<ReferencePosition>().values());
  json out{{"shape", tip_shapes[tip.shape]},
           {"axis", {axis.x(), axis.y()}},
           {"end", {model.axis.dot(end), model.side.dot(end), model.up.dot(end)}},
           {"set_back", tip.set_back}};
  if (tip.shape == TipSpec::Shape::none) return out;
  out["material"] = material_name(scene, tip.material);
  out["height"] = tip_height(tip);
  if (tip.end_radius > 0) out["end_radius"] = tip.end_radius;
  if (tip.radius > 0) out["radius"] = tip.radius;
  if (tip.foot > 0) out["foot"] = tip.foot;
  return out;
}

json actions_setup(const std::vector<ActionSpec>& actions) {
  json out = json::array();
  for (const ActionSpec& action : actions) {
    json one{{"kind", action_kinds[action.kind]}, {"name", action.name},
             {"distance", action.distance},       {"direction", direction_names[action.direction]},
             {"retrace", action.retrace},         {"servo", action.servo},
             {"increments", action.increments}};
    if (action.force) one["force"] = *action.force;
    if (action.kind == ActionSpec::Kind::raster) {
      one["width"] = action.width;
      one["lines"] = action.lines;
    }
    out.push_back(std::move(one));
  }
  return out;
}

// Sideways travel of the scanner: the profile is drawn that far.
double travel_of(const AfmScene& afm) {
  double distance = 0;
  for (const ActionSpec& action : afm.actions)
    if (action.kind == ActionSpec::Kind::scan || action.kind == ActionSpec::Kind::raster)
      distance = std::max(distance, std::abs(action.distance));
  return distance;
}

json surface_setup(const Scene& scene) {
  const TargetSpec& target = *scene.afm->target;
  json out{{"shape", surface_shapes[target.shape]},
           {"direction", direction_names[target.direction]},
           {"friction", target.friction}};
  const auto add = [&](const char* name, double value) {
    if (value != 0) out[name] = value;
  };
  add("incline", target.incline);
  add("height", target.height);
  add("slope", target.slope);
  add("plateau", target.plateau);
  add("position", target.position);
  add("wavelength", target.wavelength);
  add("pull_off", target.pull_off);
  add("work", target.work);
  if (target.shape == TargetSpec::Shape::map) {
    out["spacing"] = target.spacing;
    out["file"] = target.file;
    out["heights"] = drawn_heights(target, scene);
  } else {
    const double size = std::max(scene.afm->tip.radius, tip_height(scene.afm->tip));
    out["profile"] = pairs(drawn_profile(target, 2 * std::max(travel_of(*scene.afm), size)));
  }
  return out;
}

}  // namespace

json lever_setup(const Scene& scene, const AfmModel& model) {
  const AfmScene& afm = *scene.afm;
  json setup{{"family", "afm"},
             {"lever", dimensions_setup(scene)},
             {"parts", parts_setup(model)},
             {"tip", tip_setup(scene, model)},
             {"laser",
              {{"position", afm.laser.position.value_or(tip_axis(afm.lever, afm.tip).x())},
               {"offset", afm.laser.offset},
               {"radius", afm.laser.radius}}},
             {"actions", actions_setup(afm.actions)},
             {"surface", nullptr}};
  if (afm.target) setup["surface"] = surface_setup(scene);
  setup["materials"] = json::array();
  for (const MaterialSpec& m : scene.materials) {
    json material{{"name", m.name},
                  {"youngs_modulus", m.youngs_modulus},
                  {"poissons_ratio", m.poissons_ratio}};
    if (m.yield_stress) material["yield_stress"] = *m.yield_stress;
    setup["materials"].push_back(std::move(material));
  }
  return setup;
}

}  // namespace pulvis
