#include "cli/pack.hpp"

#include <fmt/format.h>

#include "cli/tell.hpp"
#include "engine/files/own_files.hpp"
#include "scenes/checks/overlaps.hpp"
#include "scenes/checks/scene_summary.hpp"
#include "scenes/language/counted.hpp"
#include "scenes/language/problem.hpp"
#include "scenes/packing/packing_file.hpp"
#include "scenes/packing/place.hpp"

namespace pulvis {

ExitCode pack_scene(const Scene& scene, const std::filesystem::path& file) {
  if (scene.afm)
    throw SceneError({{scene.file.string(), 1, 1, "", "family",
                       "an AFM scene has no particles, allowed: a scene with particles to pack"}});
  require_another(scene.file, file);
  require_own_or_none(file, role::packing);
  const std::vector<BodySpec> bodies = place_bodies(scene);
  check_overlaps(scene, bodies);
  write_own(file, role::packing, packing_text(scene, bodies));
  tell("{}{}: {}\n", packing_summary(scene), file.string(), counted(bodies.size(), "particle"));
  return ExitCode::done;
}

}  // namespace pulvis
