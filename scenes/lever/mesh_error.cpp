#include "scenes/lever/mesh_error.hpp"

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

}  // namespace pulvis
