#include "scenes/checks/faces.hpp"

#include <fmt/format.h>

namespace pulvis {

std::string told_meeting(const Meeting& meeting, const Scene& scene, const std::string& first,
                         const std::string& second) {
  return fmt::format(
      "stage '{}': tools '{}' and '{}' approach each other by {:.4g} m, but are {:.4g} m apart at "
      "its start: no room is left for the powder, allowed: less than {:.4g} m",
      scene.stages[static_cast<std::size_t>(meeting.stage)].name, first, second, meeting.closing,
      meeting.apart, meeting.apart);
}

std::vector<std::string> leaving_warnings(const Scene& scene,
                                          const std::vector<std::string>& leaving) {
  std::vector<std::string> lines;
  for (std::size_t s = 0; s < leaving.size(); ++s)
    if (!leaving[s].empty() && scene.stages[s].kind == StageSpec::Kind::compact)
      lines.push_back(fmt::format(
          "stage '{}': tool '{}' moves away from the powder, and no tool moves towards it: a stage "
          "of kind = \"compact\" that loads nothing (wrong sign of the displacement?)",
          scene.stages[s].name, leaving[s]));
  return lines;
}

}  // namespace pulvis
