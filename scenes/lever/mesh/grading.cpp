#include "scenes/lever/mesh/grading.hpp"

#include <algorithm>
#include <cmath>

#include "engine/portable_math.hpp"

namespace pulvis {
namespace {

// The size ramps up from either end, with a plateau between: the number of intervals up to a position, the
// integral of dx/size, and the position for a given number have closed forms.
class Ramps {
 public:
  explicit Ramps(const Grading& g)
      : length_(g.length),
        growth_(g.growth),
        largest_(g.largest),
        first_(std::min(g.first, g.largest)),
        last_(std::min(g.last, g.largest)) {
    const double meet = std::clamp(0.5 * (length_ + (last_ - first_) / growth_), 0.0, length_);
    up_ = std::min((largest_ - first_) / growth_, meet);
    down_ = std::max(length_ - (largest_ - last_) / growth_, meet);
    on_up_ = portable::log(1 + growth_ * up_ / first_) / growth_;
    on_plateau_ = (down_ - up_) / largest_;
    size_down_ = last_ + growth_ * (length_ - down_);
    whole_ = on_up_ + on_plateau_ + portable::log(size_down_ / last_) / growth_;
  }

  double whole() const { return whole_; }
  double place(double count) const {
    if (count <= on_up_) return first_ / growth_ * (portable::exp(growth_ * count) - 1);
    count -= on_up_;
    if (count <= on_plateau_) return up_ + count * largest_;
    count -= on_plateau_;
    return down_ + size_down_ / growth_ * (1 - portable::exp(-growth_ * count));
  }

 private:
  double length_, growth_, largest_, first_, last_;
  double up_ = 0, down_ = 0;  // m, where the ramps end
  double on_up_ = 0, on_plateau_ = 0, size_down_ = 0, whole_ = 0;
};

}  // namespace

int intervals_of(const Grading& grading) {
  return std::max(1, static_cast<int>(std::ceil(Ramps(grading).whole() / grading.coarser - 1e-9)));
}

std::vector<double> graded_lines(const Grading& grading, int fewest) {
  const Ramps ramps(grading);
  const int intervals = std::max(fewest, intervals_of(grading));
  std::vector<double> lines{0};
  for (int n = 1; n < intervals; ++n) lines.push_back(ramps.place(ramps.whole() * n / intervals));
  lines.push_back(grading.length);
  return lines;
}

}  // namespace pulvis
