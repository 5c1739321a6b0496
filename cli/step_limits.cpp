#include "cli/step_limits.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "components/ranks.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

std::string element_text(const TimeStepLimit& limit, int axes) {
  std::string at = fmt::format("x = {:.4g} m, y = {:.4g} m", limit.at[0], limit.at[1]);
  if (axes == 3) at += fmt::format(", z = {:.4g} m", limit.at[2]);
  return fmt::format("element {} ({}; {})", limit.element, limit.place, at);
}

std::string particle_text(const TimeStepLimit& limit) {
  return fmt::format("particle {} (class {})", limit.particle, limit.particle_class);
}

std::string of_mode(const TimeStepLimit& limit, int axes) {
  const std::string mode = fmt::format(
      "the fastest oscillation of {}, strongest in {}; {:.3g} times the step of its worst element",
      particle_text(limit), element_text(limit, axes), limit.gain);
  return limit.by_contact() ? fmt::format("springs of contact, with {:.0f}% of the energy of {}",
                                          100 * limit.contact_share, mode)
                            : fmt::format("{}; springs of contact have {:.0f}% of its energy", mode,
                                          100 * limit.contact_share);
}

std::string of_element(const TimeStepLimit& limit, int axes) {
  const std::string element =
      fmt::format("{} of {}", element_text(limit, axes), particle_text(limit));
  std::string text = limit.by_contact() ? "springs of contact on " + element : element;
  if (limit.without_contact > 1.005)
    text += fmt::format("; without contact {:.3g} times as long", limit.without_contact);
  if (limit.gain > 1)
    text += fmt::format("; {:.3g} times its step, the most that is used", limit.gain);
  return text;
}

Json json_of(const char* when, const TimeStepLimit& limit, const Scene& scene) {
  Json position = limit.at;
  if (!scene.in_space()) position.erase(2);
  return {{"when", when},
          {"time", limit.time},
          {"dt", limit.dt},
          {"stable", limit.stable},
          {"set_by", limit.by_contact() ? "contact"
                     : limit.by_mode    ? "mode"
                                        : "element"},
          {"contact_share", limit.contact_share},
          {"particle", limit.particle},
          {"class", limit.particle_class},
          {"element", limit.element},
          {"position", position},
          {"past_slowest", limit.past_slowest},
          {"median", limit.median},
          {"text", time_step_text(limit, scene.time.safety, scene.in_space() ? 3 : 2)},
          {"slowest", slowest_elements_text(limit)}};
}

}  // namespace

std::string time_step_text(const TimeStepLimit& limit, double safety, int axes) {
  const std::string what = limit.by_mode ? of_mode(limit, axes) : of_element(limit, axes);
  const std::string text = fmt::format("{:.4g} s, set by {}", safety * limit.stable, what);
  return limit.shortened.empty()
             ? text
             : fmt::format("{}. This step is only {:.4g} s: {}", text, limit.dt, limit.shortened);
}

std::string slowest_elements_text(const TimeStepLimit& limit) {
  return fmt::format(
      "the step of the elements alone would be {:.2f} times as long without the 1% with the "
      "shortest ones, and {:.2f} times with all like the median",
      limit.past_slowest, limit.median);
}

void StepLimits::sample(World& world, bool last) {
  constexpr double shorter = 0.98;
  if (world.has<RankLink>()) return;
  const bool is_shortest = !shortest_ || shortest_stable_step(world) < shorter * shortest_->stable;
  if (!is_shortest && !last) return;
  const TimeStepLimit limit = time_step_limit(world);
  if (!first_) first_ = limit;
  if (is_shortest) shortest_ = limit;
  if (last) last_ = limit;
}

Json StepLimits::json(const Scene& scene) const {
  Json all = Json::array();
  const auto add = [&](const char* when, const std::optional<TimeStepLimit>& limit) {
    if (limit) all.push_back(json_of(when, *limit, scene));
  };
  add("start", first_);
  if (shortest_ && shortest_->step != first_->step && (!last_ || shortest_->step != last_->step))
    add("shortest", shortest_);
  add("end", last_);
  return all;
}

}  // namespace pulvis
