#include "cli/report/report_observed.hpp"

#include <algorithm>
#include <cmath>

#include "cli/report/report_encoding.hpp"
#include "cli/report/report_fragments.hpp"

namespace pulvis {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_cells = 10'000;  // map cells per frame

std::size_t groups(std::size_t count, std::size_t size) { return (count + size - 1) / size; }

// Every `size`-th line of a grid, and the last.
std::vector<double> every(const std::vector<double>& lines, std::size_t size) {
  std::vector<double> kept;
  for (std::size_t i = 0; i + 1 < lines.size(); i += size) kept.push_back(lines[i]);
  kept.push_back(lines.back());
  return kept;
}

// Averages over groups of wide x tall cells of a grid; cells without a number are ignored.
std::vector<double> means(const std::vector<double>& cells, std::size_t columns, std::size_t wide,
                          std::size_t tall) {
  const std::size_t rows = cells.size() / columns, across = groups(columns, wide);
  std::vector<double> sum(across * groups(rows, tall)), count(sum.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (!std::isfinite(cells[c])) continue;
    const std::size_t group = c / columns / tall * across + c % columns / wide;
    sum[group] += cells[c];
    count[group] += 1;
  }
  for (std::size_t g = 0; g < sum.size(); ++g) sum[g] /= count[g];  // 0 / 0: no cell has a number
  return sum;
}

class Observed {
 public:
  Observed(const hdf5::File& file, std::string frame, const ReportCell<TwoD>& cell)
      : file_(file), frame_(std::move(frame)), cell_(cell) {}

  bool has(const std::string& name) const { return file_.contains(frame_ + "/" + name); }

  // A grid finer than screen resolution is drawn as averages over `merged` x `merged` cells.
  Json density() const {
    const std::vector<double> x = numbers("density_grid/x"), y = numbers("density_grid/y");
    const std::size_t columns = x.size() - 1, rows = y.size() - 1;
    std::size_t merged = 1;
    while (groups(columns, merged) * groups(rows, merged) > max_cells) ++merged;
    const auto profile = numbers("density_profile");
    return {{"cells", rounded(means(numbers("local_density"), columns, merged, merged))},
            {"profile", rounded(means(profile, 1, 1, merged))},
            {"x", rounded(every(x, merged))},
            {"y", rounded(every(y, merged))},
            {"merged", merged}};
  }

  Json network(std::size_t lines) const {
    return {{"number", rounded_of("rose/number")},
            {"force", rounded_of("rose/force")},
            {"lines", lines},
            {"unit", file_.text_attribute(frame_ + "/contacts/normal_force", "unit")}};
  }

  // Lines to draw, five numbers each: centre to centre, or centre to the tool's contact point; force.
  std::vector<float> lines() const {
    std::vector<float> all;
    const std::vector<double> centre = numbers("particle_centre");
    for (const char* group : {"contacts", "tool_contacts"}) {
      const bool pairs = std::string(group) == "contacts";
      const auto ids = file_.read_integers(frame_ + "/" + group + "/ids");
      const auto point = numbers(std::string(group) + "/point");
      const auto force = numbers(std::string(group) + "/normal_force");
      for (std::size_t i = 0; i < force.size(); ++i) {
        const Point from = point_of(centre, ids[2 * i]), at = point_of(point, i);
        const Point to = pairs ? cell_.other_end(from, at, point_of(centre, ids[2 * i + 1])) : at;
        const Point way = cell_.way(ids[2 * i]);
        for (const Point& end : {from, to})
          for (std::size_t k = 0; k < 2; ++k) all.push_back(static_cast<float>(end[k] + way[k]));
        all.push_back(static_cast<float>(std::abs(force[i])));  // the width of the line
      }
    }
    return all;
  }

  // Lines of four numbers, from start to end; cracks have five, with the shear fraction. If a run was killed,
  // the table may lack the newest rows.
  std::vector<float> bond_lines(const std::string& group) const {
    const std::vector<double> start = numbers(group + "/start"), end = numbers(group + "/end");
    const bool cracks = group == "cracks";
    const std::vector<double> shear =
        cracks ? file_.read_doubles("/cracks/shear") : std::vector<double>(start.size() / 2);
    const std::size_t count = std::min(start.size() / 2, shear.size());
    const std::vector<Point> ways = cell_.ways_of_bonds(file_, frame_, group, count);
    std::vector<float> all;
    for (std::size_t i = 0; i < count; ++i) {
      for (const auto& point : {start, end})
        for (std::size_t k = 0; k < 2; ++k)
          all.push_back(static_cast<float>(point[2 * i + k] + ways[i][k]));
      if (cracks) all.push_back(static_cast<float>(shear[i]));
    }
    return all;
  }

 private:
  template <class Number>
  static Point point_of(const std::vector<double>& points, Number number) {
    const auto n = static_cast<std::size_t>(number);
    return {points[2 * n], points[2 * n + 1]};
  }

  std::vector<double> numbers(const std::string& name) const {
    return file_.read_doubles(frame_ + "/" + name);
  }

  Json rounded_of(const std::string& name) const { return rounded(numbers(name)); }

  const hdf5::File& file_;
  std::string frame_;
  const ReportCell<TwoD>& cell_;
};

}  // namespace

void add_observed(const hdf5::File& file, const std::string& frame, const std::string& prefix,
                  const ReportCell<TwoD>& cell, Json& entry, std::vector<ReportSection>& sections) {
  const Observed observed(file, frame, cell);
  if (observed.has("local_density")) entry["density"] = observed.density();
  if (observed.has("bonds")) {
    const std::vector<float> bonds = observed.bond_lines("bonds"),
                             cracks = observed.bond_lines("cracks");
    entry["fragments"] = fragments_of(file, frame);
    entry["bonds"] = bonds.size() / 4;
    entry["cracks"] = cracks.size() / 5;
    if (!bonds.empty()) sections.push_back({prefix + "bonds", encoded(bonds)});
    if (!cracks.empty()) sections.push_back({prefix + "cracks", encoded(cracks)});
  }
  if (!observed.has("contacts")) return;
  const std::vector<float> lines = observed.lines();
  entry["network"] = observed.network(lines.size() / 5);
  if (!lines.empty()) sections.push_back({prefix + "network", encoded(lines)});
}

}  // namespace pulvis
