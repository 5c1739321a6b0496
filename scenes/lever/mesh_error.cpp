#include "scenes/lever/mesh_error.hpp"

#include <cmath>

#include "scenes/lever/afm_simulation.hpp"

namespace pulvis {

std::optional<MeshError> mesh_error(const Scene& scene, const Calibration& calibration,
                                    int threads) {
  if (scene.afm->lever.shape == LeverSpec::Shape::mesh) return {};
  Scene coarse = scene;
  coarse.afm = std::make_shared<AfmScene>(*scene.afm);
  coarse.afm->lever.coarser = 1.6;
  coarse.afm->actions.clear();
  const Calibration other = AfmSimulation(coarse, threads).calibrate();
  const auto share = [](double fine, double rough) { return std::abs(rough / fine - 1); };
  return MeshError{share(calibration.normal_stiffness, other.normal_stiffness),
                   share(calibration.lateral_stiffness, other.lateral_stiffness),
                   share(calibration.longitudinal_stiffness, other.longitudinal_stiffness)};
}

}  // namespace pulvis
