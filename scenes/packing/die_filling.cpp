#include "scenes/packing/die_filling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pulvis {
namespace {

// Shares of a mean diameter, or of the height.
constexpr double margin = 2.5e-4;    // of the smallest particle's diameter
constexpr double loosest = 0.45;     // density to start from; less where particles find no room
constexpr double first_step = 0.01;  // of the punch
constexpr double widest_step = 0.02;
constexpr double last_step = 3e-4;    // a punch that cannot go so far rests
constexpr double quick_step = 0.005;  // after shaking
constexpr double faster = 1.3;        // next step after an easy one
constexpr int easy_sweeps = 60;
constexpr int max_sweeps = 300;     // of one step
constexpr double vibration = 0.02;  // displacement of a particle in one step
constexpr double mixing = 0.15;     // displacement of a particle in one shaking of the loose powder
constexpr int mixings = 30;
constexpr double hard_vibration = 0.05;  // of one between pressings
constexpr int vibrations = 10;
constexpr double lift = 0.02;  // of the punch between pressings
constexpr int patience = 12;   // pressings without gain
constexpr double gain = 2e-4;  // that counts
constexpr double sweeps_of_hundred =
    40'000;  // of 100 particles; of ten times as many 1.8 times fewer
constexpr double touching = 1e-3;

class Press {
 public:
  explicit Press(const DieFilling& order)
      : order_(order),
        random_(order.seed),
        powder_(order.shapes, order.shape_of, order.width, margin * smallest(order),
                order.periodic) {
    for (const int s : order.shape_of) area_ += order.shapes[static_cast<std::size_t>(s)].area;
    const double hundreds = std::max(1.0, static_cast<double>(order.shape_of.size()) / 100);
    max_work_ = static_cast<std::int64_t>(sweeps_of_hundred / std::sqrt(std::sqrt(hundreds)));
  }

  FilledDie run() {
    throw_in();
    mix();
    press(first_step);
    if (order_.time_to_shake > 0) shake_on();
    return result();
  }

 private:
  static double smallest(const DieFilling& order) {
    double minimum = std::numeric_limits<double>::max();
    for (const RigidShape& shape : order.shapes) minimum = std::min(minimum, shape.diameter);
    return minimum;
  }

  void throw_in() {
    double density = loosest;
    do {
      powder_.scatter(std::max(area_ / (density * order_.width), order_.min_height), random_);
      density *= 0.7;
    } while (!powder_.relax(10 * max_sweeps) && density > 1e-3);
  }

  // Where particles were thrown chance has left holes and heaps, which shaking evens out while there is room.
  void mix() { vibrate(mixing, mixings); }

  bool at_rest_on_stop() const { return powder_.height() <= order_.min_height; }

  // The punch goes down as far as it can.
  void press(double step) {
    while (step > last_step && !at_rest_on_stop()) {
      const std::vector<RigidPose> poses = powder_.poses();
      const double height = powder_.height();
      const std::int64_t before = powder_.sweeps();
      powder_.squeeze(std::max(height * (1 - step), order_.min_height));
      powder_.shake(vibration * std::min(1.0, step / first_step), random_);
      if (!powder_.relax(max_sweeps)) {
        powder_.restore(poses, height);
        step /= 2;
      } else if (powder_.sweeps() - before < easy_sweeps) {
        step = std::min(step * faster, widest_step);
      }
    }
  }

  // Lifted a little, shaken, pressed again; the densest state is kept.
  void shake_on() {
    std::vector<RigidPose> best = powder_.poses();
    double minimum = powder_.height(), mark = minimum;
    const auto maximum =
        static_cast<std::int64_t>(order_.time_to_shake * static_cast<double>(max_work_));
    for (int idle = 0; idle < patience && !at_rest_on_stop() && powder_.sweeps() < maximum;
         ++idle) {
      powder_.squeeze(powder_.height() * (1 + lift));
      vibrate(hard_vibration, vibrations);
      press(quick_step);
      if (powder_.height() < minimum) {
        minimum = powder_.height();
        best = powder_.poses();
      }
      if (minimum > mark * (1 - gain)) continue;
      mark = minimum;
      idle = -1;
    }
    powder_.restore(best, minimum);
  }

  void vibrate(double displacement, int times) {
    for (int i = 0; i < times; ++i) {
      const std::vector<RigidPose> poses = powder_.poses();
      powder_.shake(displacement, random_);
      if (!powder_.relax(max_sweeps)) powder_.restore(poses, powder_.height());
    }
  }

  FilledDie result() {
    FilledDie die{powder_.poses(), powder_.height(), 0, powder_.min_gap(), 0};
    const auto gaps = powder_.near_gaps(touching, die.touches);
    for (const auto& own : gaps)
      die.mean_gap += (own[0] + own[1] + own[2]) / (3 * static_cast<double>(gaps.size()));
    return die;
  }

  const DieFilling& order_;
  portable::Random random_;
  RigidPowder powder_;
  double area_ = 0;
  std::int64_t max_work_ = 0;  // sweeps
};

}  // namespace

FilledDie fill_die(const DieFilling& order) { return Press(order).run(); }

}  // namespace pulvis
