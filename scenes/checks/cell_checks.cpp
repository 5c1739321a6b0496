#include "scenes/checks/cell_checks.hpp"

#include <fmt/format.h>

#include <vector>

#include "scenes/tools/die_cell.hpp"
#include "scenes/tools/die_room.hpp"

namespace pulvis {
namespace {

class CellChecks {
 public:
  CellChecks(const Scene& scene, const schema::Origins& origins, Problems& problems)
      : scene_(scene), origins_(origins), problems_(problems) {}

  void run() {
    stages();
    if (!scene_.cell) return;
    if (!scene_.tools.empty())
      refuse("tool[0]", "a periodic cell has no walls, allowed: [cell] or tools");
    packings();
    for (std::size_t m = 0; m < scene_.materials.size(); ++m)
      if (scene_.materials[m].mass_damping > 0)
        refuse(fmt::format("material[{}].damping.mass_proportional", m),
               "it damps the motion relative to a fixed frame, which a cell does not have, "
               "allowed: stiffness_proportional");
  }

 private:
  void refuse(const std::string& path, const std::string& message) {
    const auto found = origins_.find(path);
    problems_.add(found != origins_.end() ? found->second : origins_.begin()->second, path,
                  message);
  }

  void packings() {
    const CellSpec& cell = *scene_.cell;
    const bool fills =
        scene_.packings.size() == 1 && scene_.packings[0].kind == PackingSpec::Kind::random;
    bool any = false;
    for (const PackingSpec& packing : scene_.packings)
      any = any || packing.kind == PackingSpec::Kind::random;
    if (any && !fills)
      refuse("packing[1]", "a random packing fills the cell, allowed: no other packing");
    if (fills && cell.height)
      refuse("cell.height",
             "it follows from the random packing, allowed: `density` or `height` of the packing");
    if (!any && !cell.height)
      refuse("cell", "height is missing, allowed: a quantity in m, or a random packing");
    if (!fills) return;
    const PackingSpec& packing = scene_.packings[0];
    if (packing.container.width != cell.width)
      refuse("packing[0].width",
             fmt::format("the packing fills the cell, allowed: {:g} m, the width of the cell",
                         cell.width));
    if (scene_.in_space() && packing.container.kind != ContainerSpec::Kind::box)
      return refuse("packing[0].diameter",
                    "the packing fills the cell, allowed: its `width` and `depth` instead");
    if (scene_.in_space() && packing.container.depth != *cell.depth)
      refuse("packing[0].depth",
             fmt::format("the packing fills the cell, allowed: {:g} m, the depth of the cell",
                         *cell.depth));
    if (packing.container.corner != cell.corner)
      refuse("packing[0].corner", "the packing fills the cell, allowed: the corner of the cell");
  }

  void stages() {
    for (std::size_t i = 0; i < scene_.stages.size(); ++i) {
      const StageSpec& stage = scene_.stages[i];
      const std::string path = fmt::format("stage[{}].", i);
      if (scene_.cell && stage.until && !stage.until->relative_density)
        refuse(path + "until", "a cell has no tools, allowed: `relative_density`");
      if (!stage.cell) continue;
      drive(*stage.cell, path + "cell");
      if (!scene_.cell) walls(stage, path);
    }
  }

  void drive(const CellDriveSpec& drive, const std::string& path) {
    for (std::size_t part = 0; part < tensor_parts; ++part)
      if (drive.strain[part] && drive.stress[part])
        refuse(fmt::format("{}.stress_{}", path, tensor_part_names[part]),
               "this component has a strain as well, allowed: only one of the two");
    const int lateral = scene_.in_space() ? 2 : 1;
    for (std::size_t part = 0; part < static_cast<std::size_t>(lateral); ++part) {
      const int given = int{drive.strain[part] || drive.stress[part]} +
                        int{drive.stress_ratio.has_value()} + int{drive.mean_stress.has_value()};
      if (given <= 1) continue;
      refuse(path + (drive.mean_stress ? ".mean_stress" : ".stress_ratio"),
             fmt::format("the component {0} is prescribed twice, allowed: one of strain_{0}, "
                         "stress_{0}, stress_ratio and mean_stress",
                         tensor_part_names[part]));
      break;
    }
    unused(drive, path);
  }

  // Keys for strains without any strain, and likewise for stresses.
  void unused(const CellDriveSpec& drive, const std::string& path) {
    const auto only_with = [&](const std::string& key, bool any, const char* what) {
      if (!any && origins_.contains(path + key))
        refuse(path + key, fmt::format("has no effect without {0}, allowed: with {0}", what));
    };
    only_with(".ramp", drive.strains(), "a strain or a rotation");
    for (const char* key : {".rise", ".response", ".tolerance"})
      only_with(key, drive.stresses(), "a stress");
  }

  // The tools on all sides; none if that is no box.
  std::vector<int> sides_of_die() const {
    if (scene_.in_space()) {
      const auto room = die_room(scene_);
      if (!room || room->kind != DieRoom::Kind::box) return {};
      return {room->tool.begin(), room->tool.end()};
    }
    const auto die = die_cell(scene_);
    if (!die) return {};
    return {die->left, die->right, die->bottom, die->top};
  }

  // For a scene without a cell.
  void walls(const StageSpec& stage, const std::string& path) {
    const std::vector<int> sides = sides_of_die();
    if (sides.empty())
      return refuse(
          path + "cell",
          fmt::format("there is no cell, allowed: with a table [cell], or in a scene "
                      "whose tools are {}",
                      scene_.in_space() ? "six planes with normals along +x, -x, +y, -y, +z and -z"
                                        : "four planes with normals along +x, -x, +y and -y"));
    const CellDriveSpec& drive = *stage.cell;
    for (std::size_t part = 3; part < tensor_parts; ++part)
      if (drive.strain[part] || drive.stress[part])
        refuse(fmt::format("{}cell.{}_{}", path, drive.strain[part] ? "strain" : "stress",
                           tensor_part_names[part]),
               "planes cannot shear, allowed: in a periodic cell");
    if (drive.rotation != Vec3::Zero())
      refuse(path + "cell.rotation", "planes cannot rotate, allowed: in a periodic cell");
    for (const int tool : sides)
      if (scene_.tools[static_cast<std::size_t>(tool)].shape != ToolSpec::Shape::plane)
        refuse(fmt::format("tool[{}]", tool),
               "it would be moved by [stage.cell], allowed: a plane on each side");
    for (std::size_t s = 0; s < scene_.stages.size(); ++s) {
      if (!scene_.stages[s].servos.empty())
        refuse(fmt::format("stage[{}].servo[0]", s),
               "another stage moves the walls by [stage.cell], allowed: only one of the two in a "
               "scene");
      if (!scene_.stages[s].moves.empty() && scene_.stages[s].cell)
        refuse(fmt::format("stage[{}].move[0]", s),
               "[stage.cell] moves the walls, allowed: only one of the two in a stage");
    }
  }

  const Scene& scene_;
  const schema::Origins& origins_;
  Problems& problems_;
};

}  // namespace

void check_cell(const Scene& scene, const schema::Origins& origins, Problems& problems) {
  CellChecks(scene, origins, problems).run();
}

}  // namespace pulvis
