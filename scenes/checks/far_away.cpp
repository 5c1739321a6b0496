#include "scenes/checks/far_away.hpp"

#include <limits>

#include "scenes/language/problem.hpp"

namespace pulvis {

void refuse_far(const Scene& scene, const FarParticle& particle) {
  // -, of the size of a particle. A compaction of twelve discs agrees with that at the origin to 1.4e-5 (its deepest
  // overlap) where positions are rounded to 2.2e-9 of a diameter; at 2.2e-8 its energies fail at step 13.
  constexpr double largest_round_off = 1e-9;
  constexpr double spacing = std::numeric_limits<double>::epsilon();  // of numbers near 1
  const double round_off = spacing * particle.distance;
  if (round_off <= largest_round_off * particle.size) return;
  throw SceneError(
      {{scene.file_of(particle.mark).string(), particle.mark.line, particle.mark.column, "",
        particle.key,
        fmt::format(
            "'{}', {:.3g} m in size, is placed {:.3g} m from the origin, where positions are "
            "rounded to {:.2g} m: contact gaps would be wrong by {:.2g} of its size, allowed: "
            "up to {:g} of it, i.e. within {:.3g} m of the origin",
            particle.name, particle.size, particle.distance, round_off, round_off / particle.size,
            largest_round_off, largest_round_off * particle.size / spacing)}});
}

}  // namespace pulvis
