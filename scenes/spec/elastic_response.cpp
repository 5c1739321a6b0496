#include "scenes/spec/elastic_response.hpp"

#include <fmt/format.h>

namespace pulvis {

std::optional<std::string> asks_for_elastic_response(const Scene& scene) {
  using Kind = StageSpec::Kind;
  bool loaded = scene.initial_state.has_value();
  for (const StageSpec& stage : scene.stages) {
    // What was never pressed has nothing to give back: bonded blocks that are pulled apart.
    if (loaded && stage.kind == Kind::unload)
      return fmt::format("stage '{}' unloads the powder", stage.name);
    if (loaded && stage.kind == Kind::eject)
      return fmt::format("stage '{}' ejects the powder", stage.name);
    if (stage.keep_state)
      return fmt::format("stage '{}' keeps its state for other runs", stage.name);
    loaded = loaded || stage.kind == Kind::compact;
  }
  return std::nullopt;
}

std::string advice_of_stiff_contacts() {
  return fmt::format("contact.stiffness = {:g} (up to a quarter more CPU time)", stiff_contacts);
}

std::string soft_contact_warning(const Scene& scene, const std::string& reason) {
  if (scene.contact.stiffness >= stiff_contacts) return "";
  return fmt::format(
      "{}: with contact.stiffness = {:g} contact springs give way as well as the particles, and "
      "the elastic response (springback, residual stress, moduli) is too soft: use {}",
      reason, scene.contact.stiffness, advice_of_stiff_contacts());
}

std::vector<std::string> soft_contact_warnings(const Scene& scene) {
  const auto reason = asks_for_elastic_response(scene);
  const std::string line = reason ? soft_contact_warning(scene, *reason) : "";
  return line.empty() ? std::vector<std::string>{} : std::vector{line};
}

}  // namespace pulvis
