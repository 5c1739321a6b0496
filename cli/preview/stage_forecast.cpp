#include "cli/preview/stage_forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "scenes/checks/enclosed.hpp"
#include "scenes/spec/cell_spec.hpp"
#include "scenes/tools/cell.hpp"
#include "systems/tools/tool_kernel.hpp"

namespace pulvis {
namespace {

// The share of the way at which `reached` turns true; 1 if it never does.
template <class Reached>
double share_at(const Reached& reached) {
  if (!reached(1)) return 1;
  double low = 0, high = 1;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (reached(middle) ? high : low) = middle;
  }
  return high;
}

// s, of a stage whose tools come to rest after a share of their way: they begin to slow down where what is still to come
// completes it (systems/tools/stage_control.cpp).
double time_of(double share, double duration, double ramp) {
  const double braking = share_at([&](double at) {
    return kernels::smooth_travel(at, ramp) + kernels::travel_to_rest(at, ramp) >= share;
  });
  return duration * std::min(braking + ramp, 1.0);
}

double longest_ramp(const StageSpec& stage) {
  double ramp = 0;
  for (const MoveSpec& move : stage.moves) ramp = std::max(ramp, move.ramp);
  return ramp;
}

bool moves_alone(const StageSpec& stage) {
  return stage.servos.empty() && !stage.cell &&
         std::ranges::none_of(stage.moves,
                              [](const MoveSpec& move) { return move.stiffness.has_value(); });
}

// The state of the die or cell from stage to stage; without one once something else than the scene's file decides it.
class Forecaster {
 public:
  Forecaster(const Scene& scene, const std::vector<BodySpec>& bodies) : scene_(scene) {
    if (scene.initial_state) return;
    const double powder = content_of_powder(scene, bodies);
    if (scene.cell && scene.cell->height) {
      cell_density_ = powder / size_of_cell(*scene.cell);
    } else if (auto room = enclosed(scene)) {
      room_ = std::move(room);
      powder_ = powder;
      places_ = tools_at_start(scene);
    }
  }

  StageForecast pass(const StageSpec& stage) {
    StageForecast forecast{stage.duration, !stage.until, density(), {}};
    if (room_ && moves_alone(stage))
      move(stage, forecast);
    else if (cell_density_ && stage.servos.empty())
      strain(stage, forecast);
    else
      room_.reset(), cell_density_.reset();
    forecast.ends = density();
    if (!forecast.ends && stage.until) forecast.ends = stage.until->relative_density;
    return forecast;
  }

 private:
  std::optional<double> density() const {
    if (room_) return density_at(places_);
    return cell_density_;
  }
  double density_at(const Places& places) const {
    const double left = (*room_)(places);
    return left > 0 ? powder_ / left : std::numeric_limits<double>::infinity();
  }

  void move(const StageSpec& stage, StageForecast& forecast) {
    double share = 1;
    if (stage.until) {
      const UntilSpec& until = *stage.until;
      if (until.force) {
        room_.reset();
        return;
      }
      share = share_at([&](double at) {
        if (until.relative_density)
          return density_at(tools_moved(places_, stage.moves, at)) >= *until.relative_density;
        const auto tool = static_cast<std::size_t>(*until.tool);
        const Places there = tools_moved(places_, stage.moves, at);
        return (there[tool] - places_[tool]).norm() >= *until.displacement;
      });
      forecast.is_known = true;
      forecast.duration = time_of(share, stage.duration, longest_ramp(stage));
    }
    places_ = tools_moved(places_, stage.moves, share);
  }

  void strain(const StageSpec& stage, StageForecast& forecast) {
    if (!stage.cell) return;
    const CellDriveSpec& drive = *stage.cell;
    const auto normal = [&](const CellDriveSpec::Parts& parts) {
      return std::span(parts.data(), static_cast<std::size_t>(scene_.dimension));
    };
    const bool stressed =
        std::ranges::any_of(normal(drive.stress), [](const auto& part) { return bool(part); });
    if (stressed || drive.stress_ratio || drive.mean_stress) {
      cell_density_.reset();
      return;
    }
    double volume = 0;
    for (const auto& strain : normal(drive.strain)) volume += strain.value_or(0);
    double share = 1;
    if (stage.until && stage.until->relative_density) {
      share = share_at([&](double at) {
        return *cell_density_ * std::exp(-at * volume) >= *stage.until->relative_density;
      });
      forecast.is_known = true;
      forecast.duration = time_of(share, stage.duration, drive.ramp);
    }
    *cell_density_ *= std::exp(-share * volume);
  }

  const Scene& scene_;
  std::optional<Enclosed> room_;
  double powder_ = 0;  // m^2 or m^3
  Places places_;
  std::optional<double> cell_density_;
};

std::string time_text(double seconds) {
  return seconds < 1e-3 ? fmt::format("{:.3g} us", 1e6 * seconds)
                        : fmt::format("{:.3g} ms", 1e3 * seconds);
}

}  // namespace

std::vector<StageForecast> stage_forecast(const Scene& scene, const std::vector<BodySpec>& bodies) {
  Forecaster forecaster(scene, bodies);
  std::vector<StageForecast> stages;
  for (const StageSpec& stage : scene.stages) stages.push_back(forecaster.pass(stage));
  return stages;
}

std::string stages_text(const Scene& scene, const std::vector<StageForecast>& stages) {
  std::string text;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const StageForecast& stage = stages[i];
    if (!stage.ends || stage.ends == stage.begins) continue;
    text += fmt::format("{}{} {:.4g}", text.empty() ? "relative density at rest: " : "; ",
                        scene.stages[i].name, *stage.ends);
    const double whole = scene.stages[i].duration;
    if (stage.is_known && stage.duration < whole)
      text += fmt::format(" after {} of {}", time_text(stage.duration), time_text(whole));
  }
  return text;
}

}  // namespace pulvis
