#include "scenes/tools/drawn_face.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "engine/files/input_file.hpp"
#include "scenes/drawings/drawing_file.hpp"

namespace pulvis {
namespace {

constexpr std::size_t largest_drawing = 4U << 20U;  // bytes

std::vector<Vec2> line_in(const std::filesystem::path& path, const ToolSpec& tool) {
  if (!drawing::is_drawing(path))
    throw drawing::BadDrawing("not a drawing by its file extension, allowed: .svg, .dxf");
  try {
    const std::string text = text_of_input(path, largest_drawing);
    return drawing::only_line(drawing::chains_in(path, text, tool.unit, tool.layer));
  } catch (const UnfitInput& unfit) {
    throw drawing::BadDrawing(fmt::format("{}, allowed: a drawing (SVG, DXF)", unfit.what()));
  }
}

}  // namespace

std::vector<Vec2> placed_face(std::vector<Vec2> line, const Vec2& normal, const Vec2* point) {
  const Vec2 chord = line.back() - line.front();
  if (Vec2(-chord.y(), chord.x()).dot(normal) < 0) std::ranges::reverse(line);
  if (point == nullptr) return line;
  double foremost = std::numeric_limits<double>::lowest();
  for (const Vec2& p : line) foremost = std::max(foremost, normal.dot(p));
  const Vec2 across(-normal.y(), normal.x());
  const double middle = across.dot(0.5 * (line.front() + line.back()));
  const Vec2 shift =
      (normal.dot(*point) - foremost) * normal + (across.dot(*point) - middle) * across;
  for (Vec2& p : line) p += shift;
  return line;
}

void read_drawn_faces(Scene& scene, const schema::Origins& origins, Problems& problems) {
  for (std::size_t t = 0; t < scene.tools.size(); ++t) {
    ToolSpec& tool = scene.tools[t];
    const std::string at = fmt::format("tool[{}]", t);
    const bool is_drawn = tool.shape == ToolSpec::Shape::polyline && !tool.file.empty();
    if (!is_drawn || !tool.points.empty()) continue;  // a tool with both keys is rejected elsewhere
    const std::filesystem::path path = scene.file.parent_path() / tool.file;
    try {
      const Vec2 point = in_plane(tool.point);
      tool.points = placed_face(line_in(path, tool), in_plane(tool.normal),
                                origins.contains(at + ".point") ? &point : nullptr);
    } catch (const drawing::BadDrawing& bad) {
      problems.add(origins.at(at + ".file"), at + ".file",
                   fmt::format("{}: {}", path.string(), bad.what()));
    }
  }
}

}  // namespace pulvis
