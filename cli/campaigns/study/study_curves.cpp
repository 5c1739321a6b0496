#include "cli/campaigns/study/study_curves.hpp"

#include <algorithm>
#include <cmath>

#include "cli/campaigns/study/analysis/study_series.hpp"

namespace pulvis {
namespace {

constexpr std::size_t max_points = 1000;  // per curve of a single run
constexpr std::size_t mean_points = 300;

struct Curve {
  std::vector<double> x, y;
};

Curve curve_of(const StudyResult& result, const StudyCurve& wanted) {
  const std::vector<double>& x = result.series(wanted.x);
  const std::vector<double>& y = result.series(wanted.y);
  Curve curve;
  const std::size_t count = std::min(x.size(), y.size()), step = 1 + count / max_points;
  for (std::size_t i = 0; i < count; ++i) {
    const bool kept = i % step == 0 || i + 1 == count;
    if (!kept || !std::isfinite(x[i]) || !std::isfinite(y[i])) continue;
    curve.x.push_back(x[i]);
    curve.y.push_back(y[i]);
  }
  return curve;
}

// From where x leaves its initial value, as the distance of a target that is at rest first, up to the first point
// that does not increase it.
Curve rising_part(const Curve& curve) {
  std::size_t begin = 0;
  while (begin + 1 < curve.x.size() && curve.x[begin + 1] <= curve.x[begin]) ++begin;
  std::size_t end = begin + 1;
  while (end < curve.x.size() && curve.x[end] > curve.x[end - 1]) ++end;
  const auto part = [&](const std::vector<double>& values) {
    return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(begin),
                               values.begin() + static_cast<std::ptrdiff_t>(end));
  };
  return {part(curve.x), part(curve.y)};
}

double at(const Curve& curve, double x) {
  const auto right = std::ranges::upper_bound(curve.x, x);
  if (right == curve.x.begin()) return curve.y.front();
  if (right == curve.x.end()) return curve.y.back();
  const auto i = static_cast<std::size_t>(right - curve.x.begin());
  const double share = (x - curve.x[i - 1]) / (curve.x[i] - curve.x[i - 1]);
  return curve.y[i - 1] + share * (curve.y[i] - curve.y[i - 1]);
}

// Standard deviation over the seeds, n - 1.
double deviation_at(const std::vector<Curve>& curves, double x, double mean) {
  double squares = 0;
  for (const Curve& curve : curves) squares += (at(curve, x) - mean) * (at(curve, x) - mean);
  return std::sqrt(squares / static_cast<double>(curves.size() - 1));
}

void add_mean(StudyLine& line, const std::vector<Curve>& curves) {
  double low = -INFINITY, high = INFINITY;
  for (const Curve& curve : curves) {
    low = std::max(low, curve.x.front());
    high = std::min(high, curve.x.back());
  }
  if (!(high > low)) return;
  for (std::size_t i = 0; i < mean_points; ++i) {
    const double x = low + (high - low) * static_cast<double>(i) / (mean_points - 1);
    double sum = 0, minimum = INFINITY, maximum = -INFINITY;
    for (const Curve& curve : curves) {
      const double y = at(curve, x);
      sum += y;
      minimum = std::min(minimum, y);
      maximum = std::max(maximum, y);
    }
    line.x.push_back(x);
    line.y.push_back(sum / static_cast<double>(curves.size()));
    line.low.push_back(minimum);
    line.high.push_back(maximum);
    line.deviation.push_back(deviation_at(curves, x, line.y.back()));
  }
}

StudyLine line_of(const std::string& variation, const std::vector<StudyResult>& results,
                  const StudyCurve& wanted) {
  StudyLine line{variation, 0, {}, {}, {}, {}, {}};
  std::vector<Curve> curves;
  for (const StudyResult& result : results) {
    if (result.run->variation != variation || !result.usable) continue;
    Curve curve = curve_of(result, wanted);
    if (!curve.x.empty()) curves.push_back(std::move(curve));
  }
  line.runs = curves.size();
  if (curves.size() == 1) {
    line.x = std::move(curves.front().x);
    line.y = std::move(curves.front().y);
  } else if (!curves.empty()) {
    for (Curve& curve : curves) curve = rising_part(curve);
    add_mean(line, curves);
  }
  return line;
}

std::string unit_of(const Study& study, const std::string& series) {
  for (const StudyRun& run : study.runs)
    for (const SeriesInfo& info : study_series(run.scene))
      if (info.name == series) return info.unit;
  return "-";
}

}  // namespace

std::vector<DrawnCurve> study_curves(const Study& study, const std::vector<StudyResult>& results) {
  std::vector<DrawnCurve> drawn;
  for (const StudyCurve& wanted : study.spec.curves) {
    DrawnCurve curve{
        wanted.title, wanted.x, wanted.y, unit_of(study, wanted.x), unit_of(study, wanted.y), {}};
    if (curve.title.empty()) curve.title = wanted.y + " against " + wanted.x;
    for (const std::string& variation : study.variations) {
      StudyLine line = line_of(variation, results, wanted);
      if (!line.x.empty()) curve.lines.push_back(std::move(line));
    }
    drawn.push_back(std::move(curve));
  }
  return drawn;
}

}  // namespace pulvis
