#include "cli/pack.hpp"
#include "scenes/checks/overlaps.hpp"

#include <fmt/format.h>

#include "cli/tell.hpp"
#include "engine/files/own_files.hpp"
#include "scenes/language/counted.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/packing/packing_file.hpp"
#include "scenes/packing/place.hpp"
#include "scenes/space/overlaps.hpp"
#include "scenes/space/packing/packing_file.hpp"
#include "scenes/space/space_summary.hpp"

namespace pulvis {

std::string packing_summary(const Scene& scene) {
  std::string text;
  for (std::size_t i = 0; i < scene.packings.size(); ++i) {
    const PackingSpec& packing = scene.packings[i];
    if (packing.kind != PackingSpec::Kind::random) continue;
    text += fmt::format(
        "packing[{}]: {}, relative density {:.4f}, die {:.6g} m x {:.6g} "
        "m, mean gap to the three nearest neighbours {:.3g} diameters, mean contacts per particle "
        "{:.3g}\n",
        i, counted(packing.placed.size(), "particle"), packing.reached.density,
        packing.container.width, packing.top - packing.container.corner.y(),
        packing.reached.mean_gap,
        2.0 * packing.reached.touches / static_cast<double>(packing.placed.size()));
  }
  return text;
}

namespace {

ExitCode pack_in_space(const Scene& scene, const std::filesystem::path& file) {
  const std::vector<BodySpec> bodies = place_bodies(scene);
  space::check_overlaps(scene, bodies);
  write_own(file, role::packing, space::packing_text(scene, bodies));
  tell("{}{}: {}\n", space::packing_summary(scene), file.string(),
       counted(bodies.size(), "particle"));
  return ExitCode::done;
}

}  // namespace

ExitCode pack_scene(const Scene& scene, const std::filesystem::path& file) {
  if (scene.afm)
    throw SceneError({{scene.file.string(), 1, 1, "", "family",
                       "an AFM scene has no particles, allowed: a scene with particles to pack"}});
  require_another(scene.file, file);
  require_own_or_none(file, role::packing);
  if (scene.in_space()) return pack_in_space(scene, file);
  const std::vector<BodySpec> bodies = place_bodies(scene);
  check_overlaps(scene, bodies);
  write_own(file, role::packing, packing_text(scene, bodies));
  tell("{}{}: {}\n", packing_summary(scene), file.string(), counted(bodies.size(), "particle"));
  return ExitCode::done;
}

}  // namespace pulvis
