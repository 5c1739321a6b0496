// Points of a traced outline from a CSV file.
#include "scenes/outlines/points_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include "engine/files/input_file.hpp"
#include "scenes/drawings/drawing_file.hpp"
#include "scenes/language/csv_table.hpp"
#include "scenes/language/encoding.hpp"
#include "scenes/language/units.hpp"
#include "scenes/outlines/closed_spline.hpp"

namespace pulvis {
namespace {

constexpr std::size_t fewest_points = 8, max_points = 20'000;
constexpr std::size_t largest_file = 4U << 20U;  // bytes
constexpr double closest = 1e-9;                 // of the diagonal, from point to point
constexpr double max_smoothing = 0.05;           // of the square root of the area

struct BadFile {
  int line;  // 0: the whole file
  std::string message;
};

std::string trimmed(const std::string& text) {
  const auto from = text.find_first_not_of(" \t\r");
  return from == std::string::npos ? ""
                                   : text.substr(from, text.find_last_not_of(" \t\r") - from + 1);
}

// "1.5, 2.3", or "1,5; 2,3" with decimal commas.
std::vector<std::string> cells_of(std::string line) {
  std::vector<std::string> cells;
  std::size_t from = 0;
  const char separator = line.find(';') == std::string::npos ? ',' : ';';
  if (separator == ';') std::ranges::replace(line, ',', '.');
  for (std::size_t at = line.find(separator); at != std::string::npos;
       at = line.find(separator, from)) {
    cells.push_back(trimmed(line.substr(from, at - from)));
    from = at + 1;
  }
  cells.push_back(trimmed(line.substr(from)));
  return cells;
}

std::optional<double> number_of(const std::string& cell) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) return {};
  return value;
}

// "x (um)" or "x [um]": um.
std::string unit_in(const std::string& name) {
  const auto from = name.find_first_of("([");
  const auto to = name.find_last_of(")]");
  return from == std::string::npos || to == std::string::npos || to < from
             ? ""
             : trimmed(name.substr(from + 1, to - from - 1));
}

class PointsReader {
 public:
  explicit PointsReader(std::string unit) : unit_(std::move(unit)) {}

  std::vector<Vec2> read(std::istream& stream) {
    std::string line;
    while (std::getline(stream, line)) {
      ++line_;
      line = trimmed(line);
      if (line.empty() || line.front() == '#') continue;
      take(cells_of(line));
    }
    if (points_.size() > 1 && points_.back() == points_.front())
      points_.pop_back();  // already closed
    if (points_.size() < fewest_points)
      throw BadFile{0, fmt::format("{} points are too few for an outline, allowed: at least {}",
                                   points_.size(), fewest_points)};
    refuse_coinciding();
    return points_;
  }

 private:
  // Curves through nearly coincident points have unbounded curvature.
  void refuse_coinciding() const {
    Vec2 low = points_[0], high = low;
    for (const Vec2& p : points_) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const double minimum = std::max(closest * (high - low).norm(), 1e-18);  // m
    for (std::size_t i = 0; i < points_.size(); ++i)
      if ((points_[(i + 1) % points_.size()] - points_[i]).norm() <= minimum)
        throw BadFile{lines_[i], fmt::format("the next point is closer than {:g} m, allowed: at "
                                             "least {:g} of the outline's diagonal",
                                             minimum, closest)};
  }

  void take(const std::vector<std::string>& cells) {
    if (cells.size() != 2)
      throw BadFile{line_, fmt::format("{} columns, allowed: two, x and y", cells.size())};
    const std::optional<double> x = number_of(cells[0]), y = number_of(cells[1]);
    const bool first = factor_ == 0;
    if (first) set_unit(x || y ? std::vector<std::string>{} : cells);
    if (first && !x && !y) return;
    for (const auto& [cell, value] : {std::pair{cells[0], x}, {cells[1], y}})
      if (!value) throw BadFile{line_, fmt::format("'{}' is not a number, allowed: x, y", cell)};
    const Vec2 point = factor_ * Vec2(*x, *y);
    if (!points_.empty() && points_.back() == point)
      throw BadFile{line_, "the same point as before, allowed: each once"};
    if (points_.size() == max_points)
      throw BadFile{
          line_, fmt::format("more than {} points, allowed: at most {}", max_points, max_points)};
    if (point.cwiseAbs().maxCoeff() > csv::largest_number)
      throw BadFile{line_, fmt::format("a point {:g} m away, allowed: up to {:g} m",
                                       point.cwiseAbs().maxCoeff(), csv::largest_number)};
    points_.push_back(point);
    lines_.push_back(line_);
  }

  void set_unit(const std::vector<std::string>& header) {
    const std::string named = header.empty() ? "" : unit_in(header[0]);
    if (!header.empty() && named != unit_in(header[1]))
      throw BadFile{line_, fmt::format("x is in '{}' and y in '{}', allowed: one unit", named,
                                       unit_in(header[1]))};
    if (named.empty() && unit_.empty())
      throw BadFile{line_,
                    "no unit, allowed: a first line such as 'x (um), y (um)', or the key unit"};
    if (!named.empty() && !unit_.empty())
      throw BadFile{line_, fmt::format("the unit is already '{}', allowed: no key unit", named)};
    try {
      factor_ = parse_quantity("1 " + (named.empty() ? unit_ : named), "m");
    } catch (const UnitError& error) {
      throw BadFile{line_, fmt::format("unit: {}, allowed: a length, \"um\"", error.what())};
    }
  }

  std::string unit_;
  double factor_ = 0;  // m per unit; 0: not known yet
  int line_ = 0;
  std::vector<Vec2> points_;
  std::vector<int> lines_;  // of each point
};

std::vector<Vec2> points_in(const std::filesystem::path& path, const PointsOutline& outline) {
  std::string text;
  try {
    text = text_of_input(path, largest_file);
  } catch (const UnfitInput& unfit) {
    throw BadFile{0, fmt::format("{}, allowed: a file of points (CSV, SVG, DXF)", unfit.what())};
  }
  if (drawing::is_drawing(path)) {
    try {
      return drawing::only_outline(drawing::chains_in(path, text, outline.unit, outline.layer));
    } catch (const drawing::BadDrawing& bad) {
      throw BadFile{0, bad.what()};
    }
  }
  std::istringstream stream(as_utf8(std::move(text)));
  return PointsReader(outline.unit).read(stream);
}

double size_of(const std::vector<Vec2>& points) {
  Vec2 low = points[0], high = low;
  for (const Vec2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return std::sqrt((high - low).prod());
}

}  // namespace

std::vector<OutlineFault> read_points(const std::filesystem::path& folder, PointsOutline& outline) {
  const std::filesystem::path path = folder / outline.file;
  if (!outline.layer.empty() && !drawing::is_drawing(path))
    return {{"layer", fmt::format("has no effect with {}, allowed: with a drawing (SVG, DXF)",
                                  path.string())}};
  try {
    outline.points = points_in(path, outline);
  } catch (const BadFile& bad) {
    return {{"file", bad.line > 0 ? fmt::format("{}:{}: {}", path.string(), bad.line, bad.message)
                                  : fmt::format("{}: {}", path.string(), bad.message)}};
  }
  const double maximum = max_smoothing * size_of(outline.points);
  if (outline.smoothing > maximum)
    return {{"smoothing", fmt::format("{:g} m would smooth the outline away, allowed: <= {:g} m",
                                      outline.smoothing, maximum)}};
  if (outline.smoothing > 0) outline.points = smoothed_points(outline.points, outline.smoothing);
  return {};
}

}  // namespace pulvis
