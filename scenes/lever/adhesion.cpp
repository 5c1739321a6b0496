#include "scenes/lever/adhesion.hpp"

#include "scenes/lever/target_shape.hpp"
#include "scenes/spec/afm_scene.hpp"
#include "systems/lever/jkr_kernel.hpp"

namespace pulvis {

AdhesiveBall adhesive_ball(const Scene& scene) {
  const AfmScene& afm = *scene.afm;
  if (!afm.target || afm.target->adhesion != TargetSpec::Adhesion::jkr) return {};
  const MaterialSpec& m = scene.materials[static_cast<std::size_t>(afm.tip.material)];
  return {m.youngs_modulus / (1 - m.poissons_ratio * m.poissons_ratio), afm.tip.radius,
          afm.target->work};
}

double pull_off_force(const Scene& scene) {
  const AfmScene& afm = *scene.afm;
  if (!afm.target) return 0;
  const AdhesiveBall ball = adhesive_ball(scene);
  return ball.work > 0 ? kernels::jkr_pull_off(ball) : afm.target->pull_off;
}

std::optional<Vec3> adhesive_normal(const Scene& scene, const Eigen::Matrix3d& turn) {
  if (adhesive_ball(scene).work == 0) return {};
  const auto plane = make_target(*scene.afm->target, scene, scene.afm->tip.radius);
  return turn.transpose() * Vec3(plane->nearest({0, 0, 0}).normal.data());
}

}  // namespace pulvis
