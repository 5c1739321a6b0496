#include "scenes/checks/lever_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/portable_math.hpp"
#include "scenes/spec/afm_scene.hpp"

namespace pulvis {
namespace {

struct Ratio {
  const char* first;
  double first_size;  // m
  const char* second;
  double second_size;  // m
  double least;        // -, usual minimum of the first over the second
  const char* why;
};

std::string unusual(const Ratio& r) {
  const double ratio = r.first_size / r.second_size;
  if (!(r.second_size > 0) || ratio >= r.least) return "";
  return fmt::format("{} = {:g} m is {:.3g} times {} = {:g} m, usual: {:g} times or more; {}",
                     r.first, r.first_size, ratio, r.second, r.second_size, r.least, r.why);
}

std::string unusual_stiffness(const Scene& scene) {
  constexpr double softest = 1e-4, stiffest = 1e4;  // N/m
  const double k = *rough_stiffness(scene);
  if (k >= softest && k <= stiffest) return "";
  return fmt::format(
      "lever: stiffness of about {:.2g} N/m, usual: {:g} to {:g} N/m; check the units of its "
      "length, width and thickness",
      k, softest, stiffest);
}

// A sphere touches a slope off its axis, where the load twists the lever.
std::string ball_on_slope(const Scene& scene) {
  const AfmScene& afm = *scene.afm;
  const bool slope = afm.target && afm.target->shape == TargetSpec::Shape::plane &&
                     afm.target->incline != 0 &&
                     afm.target->direction == TargetSpec::Direction::lateral;
  const bool loops = std::ranges::any_of(afm.actions, [](const ActionSpec& action) {
    return action.kind == ActionSpec::Kind::scan && action.retrace &&
           action.direction == TargetSpec::Direction::lateral;
  });
  if (!slope || !loops || afm.tip.shape != TipSpec::Shape::sphere) return "";
  return fmt::format(
      "tip.radius: on this slope the ball touches {:.3g} m beside its axis; the load twists the "
      "lever there, and loop/friction and loop/sensitivity take that for a lateral force "
      "(docs/afm.md); the forces on the tip are right",
      afm.tip.radius * std::abs(portable::sin(afm.target->incline)));
}

}  // namespace

std::optional<double> rough_stiffness(const Scene& scene) {
  const LeverSpec& lever = scene.afm->lever;
  if (lever.shape == LeverSpec::Shape::mesh) return std::nullopt;
  const double e = scene.materials[static_cast<std::size_t>(lever.material)].youngs_modulus;
  const double width = lever.shape == LeverSpec::Shape::v ? 2 * lever.arm_width : lever.width;
  const double slender = lever.thickness / lever.length;
  return e * width * slender * slender * slender / 4;
}

std::vector<std::string> lever_warnings(const Scene& scene) {
  const LeverSpec& lever = scene.afm->lever;
  const TipSpec& tip = scene.afm->tip;
  std::vector<std::string> lines;
  if (const std::string line = ball_on_slope(scene); !line.empty()) lines.push_back(line);
  if (lever.shape == LeverSpec::Shape::mesh) return lines;
  const bool v = lever.shape == LeverSpec::Shape::v;
  const char* width = v ? "lever.arm_width" : "lever.width";
  const double wide = v ? lever.arm_width : lever.width;
  const bool ball = tip.shape == TipSpec::Shape::sphere;
  const double high = ball ? 2 * tip.radius : tip.height;
  for (const Ratio& ratio :
       {Ratio{"lever.length", lever.length, "lever.thickness", lever.thickness, 10,
              "a body this thick is not a beam: the closed forms for beams do not hold"},
        Ratio{"lever.length", lever.length, width, wide, 1.5,
              "a lever this wide bends like a plate"},
        Ratio{width, wide, "lever.thickness", lever.thickness, 1,
              "it bends sideways more easily than towards the sample"},
        Ratio{"lever.length", lever.length, ball ? "the ball's diameter" : "tip.height", high, 1,
              "the tip is higher than the lever is long"}})
    if (const std::string line = unusual(ratio); !line.empty()) lines.push_back(line);
  if (lines.empty())
    if (const std::string line = unusual_stiffness(scene); !line.empty()) lines.push_back(line);
  return lines;
}

}  // namespace pulvis
