#include "scenes/lever/target_shape.hpp"

#include <fcl/geometry/shape/halfspace.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <sstream>

#include "engine/files/hdf5.hpp"
#include "engine/files/input_file.hpp"
#include "engine/portable_math.hpp"
#include "scenes/lever/mesh/solid_draft.hpp"
#include "scenes/lever/triangle_target.hpp"

namespace pulvis {
namespace {

using Direction = TargetSpec::Direction;

class PlaneTarget : public TargetShape {
 public:
  explicit PlaneTarget(const Vec3& normal) : half_space_(normal, 0) {}
  Nearest nearest(const Place& p) const override {
    const Vec3& n = half_space_.n;
    return {half_space_.signedDistance({p[0], p[1], p[2]}), {n.x(), n.y(), n.z()}};
  }

 private:
  fcl::Halfspaced half_space_;
};

constexpr int facets = 200;  // per wavelength: slopes within 1.6%

struct ProfilePoint {
  double along, height;  // m
};

// The corners of a profile, from -reach to +reach.
std::vector<ProfilePoint> profile(const TargetSpec& t, double reach) {
  const double flank = t.height / t.slope;
  const double low = -reach - std::abs(t.position), high = reach + std::abs(t.position);
  if (t.shape == TargetSpec::Shape::step)
    return {{low, 0}, {t.position, 0}, {t.position + flank, t.height}, {high + flank, t.height}};
  if (t.shape == TargetSpec::Shape::bump)
    return {{low, 0},
            {t.position, 0},
            {t.position + flank, t.height},
            {t.position + flank + t.plateau, t.height},
            {t.position + 2 * flank + t.plateau, 0},
            {high + 2 * flank + t.plateau, 0}};
  std::vector<ProfilePoint> points;
  const double step = t.wavelength / facets;
  for (double x = low - t.wavelength; x <= high + t.wavelength; x += step)
    points.push_back(
        {x,
         0.5 * t.height * portable::sin(2 * std::numbers::pi * (x - t.position) / t.wavelength)});
  return points;
}

std::shared_ptr<const TargetShape> extruded(const TargetSpec& t, double reach) {
  const bool wave = t.shape == TargetSpec::Shape::sinusoid;
  const double unit = wave ? t.wavelength / facets : t.height;
  std::vector<Vec3> points;
  std::vector<fcl::Triangle> triangles;
  const bool lateral = t.direction == Direction::lateral;
  auto corners = profile(t, reach);
  // A bump without a plateau would have its top point twice; a degenerate triangle has no normal.
  const auto same = [](const ProfilePoint& p, const ProfilePoint& q) { return p.along == q.along; };
  corners.erase(std::unique(corners.begin(), corners.end(), same), corners.end());
  for (const ProfilePoint& p : corners)
    for (const double side : {-reach, reach})
      points.push_back(lateral ? Vec3(side, p.along, p.height) : Vec3(p.along, side, p.height));
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const std::size_t a = 2 * i, b = a + 1, c = a + 3, d = a + 2;
    // Counter-clockwise seen from above.
    if (lateral)
      triangles.insert(triangles.end(), {fcl::Triangle(a, b, c), fcl::Triangle(a, c, d)});
    else
      triangles.insert(triangles.end(), {fcl::Triangle(a, c, b), fcl::Triangle(a, d, c)});
  }
  return std::make_shared<TriangleTarget>(std::move(points), std::move(triangles), unit);
}

// Heights may have any origin, but lengths here are those of a lever: the common offset from zero of all
// heights is subtracted.
void take_offset_off(std::vector<std::vector<double>>& heights) {
  const auto [low, high] = height_range(heights);
  const double offset = std::clamp(0.0, low, high);
  for (auto& row : heights)
    for (double& height : row) height -= offset;
}

std::shared_ptr<const TargetShape> from_map(const TargetSpec& t, const Scene& scene) {
  const auto heights = drawn_heights(t, scene);
  const std::size_t rows = heights.size(), columns = heights.front().size();
  const double x0 = 0.5 * t.spacing * static_cast<double>(columns - 1);
  const double y0 = 0.5 * t.spacing * static_cast<double>(rows - 1);
  std::vector<Vec3> points;
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i)
      points.emplace_back(t.spacing * static_cast<double>(i) - x0,
                          t.spacing * static_cast<double>(j) - y0, heights[j][i]);
  std::vector<fcl::Triangle> triangles;
  for (std::size_t j = 0; j + 1 < rows; ++j)
    for (std::size_t i = 0; i + 1 < columns; ++i) {
      const std::size_t a = j * columns + i, b = a + 1, c = b + columns, d = a + columns;
      triangles.insert(triangles.end(), {fcl::Triangle(a, b, c), fcl::Triangle(a, c, d)});
    }
  return std::make_shared<TriangleTarget>(std::move(points), std::move(triangles), t.spacing);
}

constexpr std::size_t max_heights = 4'000'000;  // 2000 x 2000, 200 MB of triangles
constexpr std::size_t max_map_bytes = 256U << 20U;

void refuse_too_many(std::size_t rows, std::size_t columns) {
  if (columns > 0 && rows > max_heights / columns)
    throw std::runtime_error(fmt::format("more than {} heights", max_heights));
}

std::vector<double> numbers_of(const std::string& line, std::size_t number) {
  std::vector<double> row;
  const char* at = line.data();
  const char* const end = at + line.size();
  while (at < end) {
    while (at < end && (*at == ' ' || *at == '\t')) ++at;
    double value = 0;
    const auto read = std::from_chars(at, end, value);
    if (read.ec != std::errc() || !std::isfinite(value))
      throw std::runtime_error(
          fmt::format("line {}: no number at column {}", number, at - line.data() + 1));
    row.push_back(value);
    at = read.ptr;
    while (at < end && (*at == ' ' || *at == '\t' || *at == '\r' || *at == ',')) ++at;
  }
  return row;
}

std::vector<std::vector<double>> map_from_text(const std::filesystem::path& file) {
  std::istringstream stream(text_of_input(file, max_map_bytes));
  std::vector<std::vector<double>> rows;
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    if (line.empty() || line.front() == '#' || line == "\r") continue;
    rows.push_back(numbers_of(line, number));
    refuse_too_many(rows.size(), rows.front().size());
    if (rows.back().size() != rows.front().size())
      throw std::runtime_error(fmt::format("line {}: {} numbers, but the first line has {}", number,
                                           rows.back().size(), rows.front().size()));
  }
  return rows;
}

std::vector<std::vector<double>> map_from_hdf5(const std::filesystem::path& path,
                                               const std::string& dataset) {
  const hdf5::File file = hdf5::File::open(path);
  if (!file.contains("/" + dataset)) throw std::runtime_error("no dataset '" + dataset + "'");
  const hdf5::Shape shape = file.shape("/" + dataset);
  if (shape.size() != 2) throw std::runtime_error("dataset '" + dataset + "' is not [y, x]");
  refuse_too_many(shape[0], shape[1]);
  const std::vector<double> values = file.read_doubles("/" + dataset);
  std::vector<std::vector<double>> rows;
  for (std::size_t j = 0; j < shape[0]; ++j)
    rows.emplace_back(values.begin() + static_cast<std::ptrdiff_t>(j * shape[1]),
                      values.begin() + static_cast<std::ptrdiff_t>((j + 1) * shape[1]));
  for (const double height : values)
    if (!std::isfinite(height)) throw std::runtime_error("a height that is not a number");
  return rows;
}

}  // namespace

std::vector<std::array<double, 2>> drawn_profile(const TargetSpec& t, double reach) {
  const double rise = portable::tan(t.incline);
  if (t.shape == TargetSpec::Shape::plane) return {{-reach, -reach * rise}, {reach, reach * rise}};
  std::vector<std::array<double, 2>> points;
  for (const ProfilePoint& p : profile(t, reach)) points.push_back({p.along, p.height});
  return points;
}

std::vector<std::vector<double>> drawn_heights(const TargetSpec& t, const Scene& scene) {
  auto heights = read_height_map(scene.file.parent_path() / t.file, t.dataset);
  take_offset_off(heights);
  return heights;
}

std::pair<double, double> height_range(const std::vector<std::vector<double>>& heights) {
  double low = heights.front().front(), high = low;
  for (const auto& row : heights) {
    const auto [minimum, maximum] = std::ranges::minmax(row);
    low = std::min(low, minimum), high = std::max(high, maximum);
  }
  return {low, high};
}

double steepest_step(const std::vector<std::vector<double>>& heights) {
  double step = 0;
  for (std::size_t j = 0; j < heights.size(); ++j)
    for (std::size_t i = 0; i < heights[j].size(); ++i) {
      if (i > 0) step = std::max(step, std::abs(heights[j][i] - heights[j][i - 1]));
      if (j > 0) step = std::max(step, std::abs(heights[j][i] - heights[j - 1][i]));
    }
  return step;
}

double reach_of(const AfmScene& afm) {
  double distance = 0;
  for (const ActionSpec& action : afm.actions) distance += std::abs(action.distance);
  return 2 * distance + 0.1 * afm.lever.length;  // plus the possible deflection of the lever
}

std::size_t profile_corners(const TargetSpec& t, double reach) {
  if (t.shape != TargetSpec::Shape::sinusoid) return 6;
  const double length = 2 * (reach + std::abs(t.position)) / t.wavelength + 2;
  return static_cast<std::size_t>(std::min(1e18, length * facets));
}

std::vector<std::vector<double>> read_height_map(const std::filesystem::path& file,
                                                 const std::string& dataset) {
  const bool binary = file.extension() == ".h5" || file.extension() == ".hdf5";
  auto rows = binary ? map_from_hdf5(file, dataset) : map_from_text(file);
  if (rows.size() < 2 || rows.front().size() < 2)
    throw std::runtime_error("fewer than two lines of two numbers");
  return rows;
}

std::shared_ptr<const TargetShape> make_target(const TargetSpec& t, const Scene& scene,
                                               double reach) {
  if (t.shape == TargetSpec::Shape::map) return from_map(t, scene);
  if (t.shape != TargetSpec::Shape::plane) return extruded(t, reach);
  const double rise = portable::sin(t.incline);
  return std::make_shared<PlaneTarget>(t.direction == Direction::lateral
                                           ? Vec3(0, -rise, portable::cos(t.incline))
                                           : Vec3(-rise, 0, portable::cos(t.incline)));
}

}  // namespace pulvis
