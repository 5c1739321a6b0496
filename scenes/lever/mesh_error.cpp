#include "scenes/lever/mesh_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/run_failure.hpp"
#include "scenes/lever/afm_simulation.hpp"
#include "scenes/lever/afm_size.hpp"

namespace pulvis {

std::optional<MeshError> mesh_error(const Scene& scene, const Calibration& calibration,
                                    int threads) {
  if (scene.afm->lever.shape == LeverSpec::Shape::mesh) return {};
  Scene compared = scene;
  const auto afm = std::make_shared<AfmScene>(*scene.afm);
  compared.afm = afm;
  afm->actions.clear();
  const bool uniform = afm->lever.along > 0 || afm->lever.across > 0;
  if (uniform)
    afm->lever.along = afm->lever.across = 0;
  else
    afm->lever.coarser = 1.6;
  if (is_too_large(afm_size(*afm))) return {};
  Calibration other;
  try {
    other = AfmSimulation(compared, threads).calibrate();
  } catch (const RunFailure&) {  // a graded mesh of a very thin lever is more ill-conditioned
    return {};
  }
  const auto share = [&](double mine, double others) {
    return std::abs(uniform ? mine / others - 1 : others / mine - 1);
  };
  return MeshError{share(calibration.normal_stiffness, other.normal_stiffness),
                   share(calibration.lateral_stiffness, other.lateral_stiffness),
                   share(calibration.longitudinal_stiffness, other.longitudinal_stiffness)};
}

std::string mesh_warning(const MeshError& error) {
  const double most = std::max({error.normal, error.lateral, error.longitudinal});
  if (!(most >= doubtful_mesh)) return "";
  return fmt::format(
      "the mesh makes the lever too stiff by about {:.0f}% (k_n), {:.0f}% (k_l) and {:.0f}% (k_x), "
      "usual: < {:.0f}%; {}",
      100 * error.normal, 100 * error.lateral, 100 * error.longitudinal, 100 * doubtful_mesh,
      most >= unusable_mesh
          ? "this is no stiffness of the lever: a longer or thinner one, or smaller edges"
          : "smaller edges reduce it");
}

}  // namespace pulvis
