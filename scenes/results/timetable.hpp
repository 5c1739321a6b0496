// Sampling times of a run: evenly spaced over its time, the first at 0, the last at its end.
#pragma once

namespace pulvis {

class Timetable {
 public:
  Timetable(double end, int count) : end_(end), count_(count) {}
  bool due(double time) const { return next_ <= count_ && time >= at(next_); }
  double next() const { return next_ > count_ ? end_ : at(next_); }
  void pass(double time) {
    while (next_ <= count_ && time >= at(next_)) ++next_;
  }

  // Stored in a checkpoint; the rest comes from the scene.
  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(next_);
  }

 private:
  double at(int i) const { return i >= count_ ? end_ : end_ * i / count_; }
  double end_;
  int count_, next_ = 0;
};

}  // namespace pulvis
