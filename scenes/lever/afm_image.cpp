#include "scenes/lever/afm_image.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "scenes/spec/afm_scene.hpp"

namespace pulvis {
namespace {

struct Channel {
  const char *name, *series, *unit, *label, *meaning;
  double sign;
  bool turns;  // changes its sign with the direction of a trace across the lever
};
constexpr Channel channels[] = {
    {"topography", "scanner/z", "m", "topography $z$",
     "distance by which the scanner was lowered to follow the surface", -1, false},
    {"deflection", "detector/normal", "V", "deflection $U_n$", "normal signal of the detector", 1,
     false},
    {"friction", "detector/lateral", "V", "friction signal $U_l$",
     "lateral signal of the detector, with the sign of the force that drags the probe along a "
     "trace across the lever",
     -1, true}};

// The history rows of an action; the first row of all is the state before the programme.
std::size_t first_row(const Scene& scene, std::size_t action) {
  std::size_t row = 1;
  for (std::size_t a = 0; a < action; ++a) row += scene.afm->actions[a].samples();
  return row;
}

AfmImage image_of(const AfmHistory& history, const Channel& channel, std::size_t action,
                  bool retrace, std::size_t first, std::size_t lines, std::size_t pixels,
                  const PixelSpacing& spacing) {
  AfmImage image{
      {fmt::format("action_{}/{}_{}", action, channel.name, retrace ? "retrace" : "trace"),
       channel.unit, channel.label, channel.meaning},
      lines,
      pixels,
      spacing,
      {}};
  for (std::size_t line = 0; line < lines; ++line)
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
      const std::size_t on_line = retrace ? 2 * pixels - 1 - pixel : pixel;
      image.values.push_back(channel.sign *
                             history.value(first + 2 * pixels * line + on_line, channel.series));
    }
  return image;
}

}  // namespace

std::vector<AfmImage> raster_images(const Scene& scene, const AfmHistory& history) {
  std::vector<AfmImage> images;
  for (std::size_t a = 0; a < scene.afm->actions.size(); ++a) {
    const ActionSpec& action = scene.afm->actions[a];
    const std::size_t first = first_row(scene, a);
    if (action.kind != ActionSpec::Kind::raster || history.rows.size() <= first) continue;
    const auto pixels = static_cast<std::size_t>(action.increments);
    const std::size_t told = (history.rows.size() - first) / (2 * pixels);
    const std::size_t lines = std::min(told, static_cast<std::size_t>(action.lines));
    if (lines == 0) continue;
    const double along = std::abs(action.distance) / static_cast<double>(pixels);
    const PixelSpacing spacing{
        along, action.lines > 1 ? std::abs(action.width) / (action.lines - 1) : along};
    const bool is_backwards =
        action.distance < 0 && action.direction == TargetSpec::Direction::lateral;
    for (Channel channel : channels) {
      if (channel.turns && is_backwards) channel.sign = -channel.sign;
      for (const bool retrace : {false, true})
        images.push_back(image_of(history, channel, a, retrace, first, lines, pixels, spacing));
    }
  }
  return images;
}

}  // namespace pulvis
