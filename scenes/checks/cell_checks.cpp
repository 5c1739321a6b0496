#include "scenes/checks/cell_checks.hpp"

#include <fmt/format.h>

#include <array>

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
      refuse("packing[1]", "a random packing fills the cell, allowed: no other packing beside it");
    if (fills && cell.height)
      refuse("cell.height",
             "the random packing decides on it, allowed: `density` or `height` of the "
             "packing");
    if (!any && !cell.height)
      refuse("cell", "height is missing, allowed: a quantity in m, or a random packing");
    if (!fills) return;
    const PackingSpec& packing = scene_.packings[0];
    if (packing.width != cell.width)
      refuse("packing[0].width",
             fmt::format("the packing fills the cell, allowed: {:g} m, the cell's", cell.width));
    if (packing.corner != cell.corner)
      refuse("packing[0].corner", "the packing fills the cell, allowed: the cell's corner");
  }

  void stages() {
    for (std::size_t i = 0; i < scene_.stages.size(); ++i) {
      const StageSpec& stage = scene_.stages[i];
      const std::string path = fmt::format("stage[{}].", i);
      if (scene_.cell && stage.until)
        refuse(path + "until", "a cell's stages last as long as they say, allowed: `duration`");
      if (!stage.cell) continue;
      if (!scene_.cell) refuse(path + "cell", "there is no cell, allowed: with a table [cell]");
      const CellDriveSpec& drive = *stage.cell;
      const std::array<std::pair<const char*, bool>, 3> both{
          std::pair{"stress_xx", drive.strain_xx && drive.stress_xx},
          std::pair{"stress_yy", drive.strain_yy && drive.stress_yy},
          std::pair{"stress_xy", drive.strain_xy && drive.stress_xy}};
      for (const auto& [key, twice] : both)
        if (twice)
          refuse(path + "cell." + key, "this component has a strain, too, allowed: one of both");
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
