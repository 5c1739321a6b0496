// A closed outline as a curve: smooth pieces one after the other, counter-clockwise, tabulated by arc
// length. The meshes and polygons of all outlines without a closed formula are made from it.
#pragma once

#include <functional>
#include <vector>

#include "scenes/spec/scene.hpp"

namespace pulvis {

class OutlineCurve {
 public:
  struct Point {
    Vec2 at, slope;  // slope: derivative with respect to the piece's parameter, not 0
  };
  using Piece = std::function<Point(double)>;  // parameter in [0, 1]

  // `sharp`: the curve has a corner where a piece begins. Scaled by `scale` about its area's centroid,
  // which becomes the origin.
  OutlineCurve(std::vector<Piece> pieces, bool sharp, double scale = 1);

  double length() const { return samples_.back().s; }
  double area() const { return samples_.back().swept; }
  bool sharp() const { return sharp_; }
  Vec2 extent() const;  // m, of the bounding box

  // Between two samples the curve belongs to one piece and turns by `turn`.
  struct Sample {
    double s = 0;      // m, arc length from the start
    double swept = 0;  // m^2, area between the origin, the start and here
    double turn = 0;   // rad, of the tangent up to the next sample
    std::size_t piece = 0;
    double t = 0, next_t = 0;  // the piece's parameter here and at the next sample
  };
  const std::vector<Sample>& samples() const { return samples_; }  // first and last coincide

  struct Place {
    Vec2 at, normal;  // outward
    double swept;     // m^2
  };
  Place at(double s) const;  // s in [0, length]

  // Inscribed, counter-clockwise; its sides deviate from the curve by at most `deviation`.
  std::vector<Vec2> polygon(double deviation) const;

 private:
  struct Taken;
  Point point(std::size_t piece, double t) const;
  Point placed(const Point& p) const;
  std::size_t samples_of_a_piece() const;
  std::vector<Taken> take() const;
  void tabulate(const std::vector<Taken>& taken);
  Vec2 centroid(const std::vector<Taken>& taken) const;

  std::vector<Piece> pieces_;
  bool sharp_;
  double scale_ = 1;
  Vec2 origin_ = Vec2::Zero();
  std::vector<Sample> samples_;
};

}  // namespace pulvis
