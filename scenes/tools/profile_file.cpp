#include "scenes/tools/profile_file.hpp"

#include <fmt/format.h>

#include "scenes/language/csv_table.hpp"

namespace pulvis {
namespace {

constexpr std::size_t fewest_points = 3, max_points = 20'000;
constexpr double shortest = 1e-12;  // m, of a profile: squares of shorter lengths underflow

void check(const csv::Table& table, const std::vector<double>& x) {
  if (x.size() < fewest_points || x.size() > max_points)
    csv::refuse(table, "x",
                fmt::format("{} points, allowed: {} to {}", x.size(), fewest_points, max_points));
  for (std::size_t i = 1; i < x.size(); ++i)
    if (!(x[i] > x[i - 1]))
      csv::refuse(table, i, csv::column_at(table, "x"),
                  fmt::format("x goes from {:.6g} m {} {:.6g} m: the profile overhangs or turns "
                              "back, allowed: x that increases from row to row",
                              x[i - 1], x[i] < x[i - 1] ? "back to" : "to", x[i]));
  if (x.back() - x.front() < shortest)
    csv::refuse(table, "x",
                fmt::format("a profile of {:g} m, allowed: at least {:g} m", x.back() - x.front(),
                            shortest));
}

// Instruments are tilted: heights are measured from the least-squares line.
void level(std::vector<Vec2>& points) {
  Vec2 mean = Vec2::Zero();
  for (const Vec2& p : points) mean += p / static_cast<double>(points.size());
  double square = 0, product = 0;
  for (const Vec2& p : points) {
    square += (p.x() - mean.x()) * (p.x() - mean.x());
    product += (p.x() - mean.x()) * (p.y() - mean.y());
  }
  const double slope = product / square;
  for (Vec2& p : points) p.y() -= mean.y() + slope * (p.x() - mean.x());
}

}  // namespace

std::vector<Vec2> read_profile(const std::filesystem::path& file) {
  const csv::Table table = csv::read(file);
  const std::vector<double> x = csv::numbers(table, csv::column_at(table, "x"), "m");
  const std::vector<double> height = csv::numbers(table, csv::column_at(table, "height"), "m");
  check(table, x);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < x.size(); ++i) points.push_back({x[i], height[i]});
  level(points);
  return points;
}

}  // namespace pulvis
