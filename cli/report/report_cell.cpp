#include "cli/report/report_cell.hpp"

#include <algorithm>
#include <cmath>

namespace pulvis {
namespace {

template <std::size_t N>
using Vector = std::array<double, N>;

// a + factor b
template <std::size_t N>
Vector<N> sum(Vector<N> a, const Vector<N>& b, double factor = 1) {
  for (std::size_t k = 0; k < N; ++k) a[k] += factor * b[k];
  return a;
}

// Each component rounded by `round`.
template <std::size_t N, class Round>
Vector<N> whole(Vector<N> a, const Round& round) {
  for (double& x : a) x = round(x);
  return a;
}

}  // namespace

template <class D>
ReportCell<D>::ReportCell(const hdf5::File& file, const std::string& frame,
                          const std::vector<std::int32_t>& node_particle)
    : node_particle_(node_particle) {
  if (!file.contains(frame + "/cell") || node_particle.empty()) return;
  const std::vector<double> cell = file.read_doubles(frame + "/cell");
  for (std::size_t i = 0; i < D::axes; ++i) {
    corner_[i] = cell.at(i);
    for (std::size_t j = 0; j < D::axes; ++j) vectors_(i, j) = cell.at(D::axes * (j + 1) + i);
  }
  find_ways(file.read_doubles(frame + "/position"));
}

template <class D>
void ReportCell<D>::find_ways(const std::vector<double>& positions) {
  const auto particles = static_cast<std::size_t>(*std::ranges::max_element(node_particle_)) + 1;
  std::vector<Point> centre(particles);
  std::vector<double> nodes(particles);
  for (std::size_t n = 0; n < node_particle_.size(); ++n) {
    const auto p = static_cast<std::size_t>(node_particle_[n]);
    for (std::size_t k = 0; k < D::axes; ++k) centre[p][k] += positions[D::axes * n + k];
    nodes[p] += 1;
  }
  const Tensor<D> inverse = vectors_.inverse();
  for (std::size_t p = 0; p < particles; ++p) {
    for (double& x : centre[p]) x /= nodes[p];
    const Point at = inverse * sum(centre[p], corner_, -1);
    way_.push_back(vectors_ * whole(at, [](double x) { return -std::floor(x); }));
  }
}

template <class D>
auto ReportCell<D>::ways_of_bonds(const hdf5::File& file, const std::string& frame,
                                  const std::string& group, std::size_t count) const
    -> std::vector<Point> {
  std::vector<Point> ways(count);
  if (!here()) return ways;
  const bool cracks = group == "cracks";
  const auto ids = file.read_integers(cracks ? "/cracks/particle" : frame + "/bonds/ids");
  const std::size_t each = cracks ? 1 : 2;
  for (std::size_t i = 0; i < count && each * i < ids.size(); ++i) ways[i] = way(ids[each * i]);
  return ways;
}

template <class D>
std::vector<double> ReportCell<D>::inside(std::vector<double> positions) const {
  if (here())
    for (std::size_t i = 0; i < positions.size(); ++i)
      positions[i] += way(node_particle_[i / D::axes])[i % D::axes];
  return positions;
}

template <class D>
auto ReportCell<D>::other_end(const Point& from, const Point& through, const Point& other) const
    -> Point {
  if (!here()) return other;
  const Point there = sum(sum(through, through), from, -1);
  const Point periods = vectors_.inverse() * sum(there, other, -1);
  return sum(other, vectors_ * whole(periods, [](double x) { return std::round(x); }));
}

template <class D>
std::vector<double> ReportCell<D>::numbers() const {
  std::vector<double> all(corner_.begin(), corner_.end());
  for (std::size_t j = 0; j < D::axes; ++j)
    for (const double x : vectors_.column(j)) all.push_back(x);
  return all;
}

template <class D>
auto ReportCell<D>::corners() const -> std::vector<Point> {
  std::vector<Point> all;
  if (!here()) return all;
  ImageIn<D> last;
  last.fill(1);
  for_images<D>({}, last,
                [&](const ImageIn<D>& at) { all.push_back(sum(corner_, vectors_ * at)); });
  return all;
}

template class ReportCell<TwoD>;
template class ReportCell<ThreeD>;

}  // namespace pulvis
