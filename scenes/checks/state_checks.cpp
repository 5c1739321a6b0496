#include "scenes/checks/state_checks.hpp"

#include <fmt/format.h>

#include "engine/files/checkpoint.hpp"

namespace pulvis {
namespace {

// Why the scene cannot start from it; empty if it can.
std::string unfit_state(const std::filesystem::path& file, std::uint64_t powder_hash) {
  const std::string allowed = "allowed: a state-*.h5 file saved by a run (stage.keep_state)";
  if (!std::filesystem::is_regular_file(file))
    return fmt::format("'{}' is not a file, {}", file.string(), allowed);
  try {
    const Checkpoint state(file);
    if (state.info().powder_hash != fmt::format("{:016x}", powder_hash))
      return fmt::format(
          "'{}' is the state of another powder, allowed: the state of a scene that differs only in "
          "title, [[stage]], [[expect]], [limits], output.samples and output.frames",
          file.string());
  } catch (const DamagedCheckpoint& damage) {
    return fmt::format("'{}': {}, {}", file.string(), damage.what(), allowed);
  }
  return {};
}

}  // namespace

void check_initial_state(const Scene& scene, std::uint64_t powder_hash,
                         const schema::Origins& origins, Problems& problems) {
  if (!scene.initial_state) return;
  const std::string unfit =
      unfit_state(scene.file.parent_path() / *scene.initial_state, powder_hash);
  if (!unfit.empty()) problems.add(origins.at("initial_state"), "initial_state", unfit);
}

}  // namespace pulvis
