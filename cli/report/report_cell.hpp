// The periodic cell of a frame, and where the report shows the particles: with their centres inside it.
#pragma once

#include <string>
#include <vector>

#include "components/cell.hpp"
#include "engine/files/hdf5.hpp"

namespace pulvis {

template <class D>
class ReportCell {
 public:
  using Point = typename D::Point;

  ReportCell(const hdf5::File& file, const std::string& frame,
             const std::vector<std::int32_t>& node_particle);

  bool here() const { return !way_.empty(); }  // otherwise nothing is shifted
  // m, shift of the particle with that number.
  Point way(std::int32_t particle) const {
    return here() ? way_[static_cast<std::size_t>(particle)] : Point{};
  }
  // m, [count]: shifts of the particles on which the bonds or cracks of a frame are; `group`: "bonds" or "cracks". If a run was
  // killed, the table of cracks may lack the newest rows: those are not shifted.
  std::vector<Point> ways_of_bonds(const hdf5::File& file, const std::string& frame,
                                   const std::string& group, std::size_t count) const;
  // Coordinates of all nodes, shifted into the cell.
  std::vector<double> inside(std::vector<double> positions) const;
  // For a line from the centre of one particle through its contact point with another: the centre of that image of the
  // other one. Neighbouring particles are assumed to be of similar size.
  Point other_end(const Point& from, const Point& through, const Point& other) const;
  // Corner and vectors.
  std::vector<double> numbers() const;
  std::vector<Point> corners() const;

 private:
  void find_ways(const std::vector<double>& positions);

  const std::vector<std::int32_t>& node_particle_;
  Point corner_{};
  Tensor<D> vectors_;
  std::vector<Point> way_;
};

}  // namespace pulvis
