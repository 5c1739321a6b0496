#include "systems/sparse/factors.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <type_traits>
#include <utility>

#include "engine/entry.hpp"
#include "engine/lane.hpp"

namespace pulvis::sparse {
namespace {

// Rows that are processed together.
template <class Real>
struct Slice {
  using Type = Real;
  static constexpr int size = 1, most = 2;
  static Real load(const Real* from) { return *from; }
  static void store(Real* to, Real value) { *to = value; }
};
template <>
struct Slice<double> {
  using Type = Lane;
  static constexpr int size = lane_count;
  static constexpr int most = simd::registers == 1 ? 4 : 1;  // as the registers hold the sums
  static Lane load(const double* from) { return Lane::load(from); }
  static void store(double* to, const Lane& value) { value.store(to); }
};

constexpr int slack = lane_count;  // rows that are read and written behind the last one

long double total(long double sum) { return sum; }
double total(const Lane& sum) {
  std::array<double, lane_count> part;
  sum.store(part.data());
  return ((part[0] + part[4]) + (part[2] + part[6])) + ((part[1] + part[5]) + (part[3] + part[7]));
}

// The product of rows of L with `factor`, [columns, count]: [count, ld].
template <int count, int slices, class Real>
void product_of_slices(const Real* l, std::ptrdiff_t stride, std::span<const Real> factor,
                       Real* out, std::ptrdiff_t ld) {
  using S = Slice<Real>;
  typename S::Type sum[count][slices];
  for (auto& column : sum)
    for (auto& s : column) s = Real(0);
  for (std::size_t c = 0; c < factor.size(); c += count, l += stride)
    for (int i = 0; i < slices; ++i) {
      const auto value = S::load(l + i * S::size);
      for (std::size_t j = 0; j < count; ++j) sum[j][i] += value * typename S::Type(factor[c + j]);
    }
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < slices; ++i) S::store(out + j * ld + i * S::size, sum[j][i]);
}

template <int count, class Real>
void product(const Real* l, std::ptrdiff_t stride, int rows, std::span<const Real> factor,
             Real* out, std::ptrdiff_t ld) {
  using S = Slice<Real>;
  int i = 0;
  for (; i + (S::most - 1) * S::size < rows; i += S::most * S::size)
    product_of_slices<count, S::most>(l + i, stride, factor, out + i, ld);
  for (; i < rows; i += S::size) product_of_slices<count, 1>(l + i, stride, factor, out + i, ld);
}

// Sums of the products of three columns of L with `count` columns of x: [count, 3].
template <int count, class Real>
std::array<Real, 3 * count> dots(const Real* l, std::ptrdiff_t stride, int rows, const Real* x,
                                 std::ptrdiff_t ld) {
  using S = Slice<Real>;
  typename S::Type sum[count][3];
  for (auto& column : sum)
    for (auto& s : column) s = Real(0);
  int i = 0;
  for (; i + S::size <= rows; i += S::size)
    for (int n = 0; n < count; ++n) {
      const auto value = S::load(x + n * ld + i);
      for (int c = 0; c < 3; ++c) sum[n][c] += S::load(l + c * stride + i) * value;
    }
  std::array<Real, 3 * count> all;
  for (int n = 0; n < count; ++n)
    for (int c = 0; c < 3; ++c) {
      Real rest = total(sum[n][c]);
      for (int k = i; k < rows; ++k) rest += l[c * stride + k] * x[n * ld + k];
      all[static_cast<std::size_t>(3 * n + c)] = rest;
    }
  return all;
}

template <class Real>
void add_multiple(Real* to, const Real* from, Real factor, int size) {
  for (int i = 0; i < size; ++i) to[i] += from[i] * factor;
}
template <class Real>
void subtract_from(Real* to, const Real* from, int size) {
  for (int i = 0; i < size; ++i) to[i] -= from[i];
}

// Supernodes by the one that they change next.
class Queues {
 public:
  explicit Queues(int size)
      : head_(static_cast<std::size_t>(size), -1), next_(static_cast<std::size_t>(size), -1) {}
  void push(int queue, int s) { entry(next_, s) = std::exchange(entry(head_, queue), s); }
  int pop(int queue) {
    const int s = entry(head_, queue);
    if (s != -1) entry(head_, queue) = entry(next_, s);
    return s;
  }

 private:
  std::vector<int> head_, next_;
};

}  // namespace

template <class Real>
Factors<Real>::Factors(const BlockGraph& graph, std::vector<std::int32_t> position)
    : nodes_(supernodes_of(graph, std::move(position))), begin_{0} {
  std::size_t most = 0;
  for (int s = 0; s < nodes_.size(); ++s) {
    const auto columns = 3 * static_cast<std::size_t>(nodes_.columns_of(s));
    const std::size_t rows = columns + 3 * nodes_.rows_of(s).size();
    begin_.push_back(begin_.back() + columns * rows);
    most = std::max(most, rows);
  }
  value_.resize(begin_.back() + slack);
  pivot_.resize(3 * nodes_.position.size());
  local_.resize(nodes_.position.size());
  product_.resize(3 * (most + slack));
  find_places(graph);
}

template <class Real>
typename Factors<Real>::Panel Factors<Real>::panel(int s) const {
  const int columns = 3 * nodes_.columns_of(s);
  return {entry(begin_, s), 3 * entry(nodes_.first, s), columns,
          columns + 3 * static_cast<int>(nodes_.rows_of(s).size())};
}

// Of an entry of the lower triangle, by its places in the order of elimination.
template <class Real>
std::size_t Factors<Real>::place_of(int row, int column) const {
  const int s = entry(nodes_.of_column, column / 3);
  const Panel to = panel(s);
  int local = row - to.first;
  if (local >= to.columns) {
    const auto below = nodes_.rows_of(s);
    const auto at = std::ranges::lower_bound(below, row / 3) - below.begin();
    local = to.columns + 3 * static_cast<int>(at) + row % 3;
  }
  return to.at(local, column - to.first);
}

template <class Real>
void Factors<Real>::find_places(const BlockGraph& graph) {
  for (int c = 0; c < graph.columns(); ++c)
    for (int j = 0; j < 3; ++j)
      for (const int r : graph.rows_of(c))
        for (int i = r == c ? j : 0; i < 3; ++i) {
          const int row = 3 * entry(nodes_.position, r) + i,
                    column = 3 * entry(nodes_.position, c) + j;
          place_.push_back(place_of(std::max(row, column), std::min(row, column)));
        }
}

template <class Real>
bool Factors<Real>::factorise(std::span<const Real> values) {
  std::ranges::fill(value_, Real(0));
  for (std::size_t i = 0; i < values.size(); ++i) value_[place_[i]] = values[i];
  Queues waiting(nodes_.size());
  std::vector<int> done(static_cast<std::size_t>(nodes_.size()), 0);  // of the rows below
  const auto queue = [&](int s) {
    const auto rows = nodes_.rows_of(s);
    if (const int next = entry(done, s); next < std::ssize(rows))
      waiting.push(entry(nodes_.of_column, entry(rows, next)), s);
  };
  for (int s = 0; s < nodes_.size(); ++s) {
    const Panel to = panel(s);
    const auto below = nodes_.rows_of(s);
    for (int c = 0; c < to.columns; c += 3) entry(local_, (to.first + c) / 3) = c;
    for (int i = 0; i < std::ssize(below); ++i) entry(local_, entry(below, i)) = to.columns + 3 * i;
    for (int d = waiting.pop(s); d != -1; d = waiting.pop(s)) {
      const auto rows = nodes_.rows_of(d);
      const int begin = std::exchange(
          entry(done, d),
          static_cast<int>(std::ranges::lower_bound(rows, (to.first + to.columns) / 3) -
                           rows.begin()));
      subtract({panel(d), rows, begin, entry(done, d)}, to);
      queue(d);
    }
    if (!factorise(to)) return false;
    queue(s);
  }
  return true;
}

// Three columns of D L^T.
template <class Real>
void Factors<Real>::scale(const Panel& panel, int row, int columns) {
  scaled_.clear();
  for (int c = 0; c < columns; ++c)
    for (int j = 0; j < 3; ++j)
      scaled_.push_back(entry(pivot_, panel.first + c) * value_[panel.at(row + j, c)]);
}

template <class Real>
void Factors<Real>::subtract(const Update& update, const Panel& to) {
  const Panel& from = update.from;
  const int size = static_cast<int>(update.rows.size());
  for (int block = update.begin; block < update.end; ++block) {
    const int row = from.columns + 3 * block, rows = from.rows - row;
    scale(from, row, from.columns);
    const std::ptrdiff_t ld = rows + slack;
    product<3>(&value_[from.at(row, 0)], from.rows, rows, std::span<const Real>(scaled_),
               product_.data(), ld);
    const int column = entry(local_, entry(update.rows, block));
    for (int i = block, run = 1; i < size; i += run, run = 1) {
      const int place = entry(local_, entry(update.rows, i));
      while (i + run < size && entry(local_, entry(update.rows, i + run)) == place + 3 * run) ++run;
      for (int j = 0; j < 3; ++j)
        subtract_from(&value_[to.at(place, column + j)], product_.data() + j * ld + 3 * (i - block),
                      3 * run);
    }
  }
}

template <class Real>
bool Factors<Real>::factorise(const Panel& panel) {
  for (int column = 0; column < panel.columns; column += 3) {
    scale(panel, column, column);
    const int rows = panel.rows - column;
    const std::ptrdiff_t ld = rows + slack;
    product<3>(&value_[panel.at(column, 0)], panel.rows, rows, std::span<const Real>(scaled_),
               product_.data(), ld);
    for (int j = 0; j < 3; ++j)
      subtract_from(&value_[panel.at(column, column + j)], product_.data() + j * ld, rows);
    if (!factorise_block(panel, column)) return false;
  }
  return true;
}

// Three columns from which all before them are subtracted.
template <class Real>
bool Factors<Real>::factorise_block(const Panel& panel, int column) {
  for (int c = column; c < column + 3; ++c) {
    Real* l = &value_[panel.at(0, c)];
    const Real d = l[c];
    if (d == 0 || !std::isfinite(d)) return false;
    entry(pivot_, panel.first + c) = d;
    for (int i = c + 1; i < panel.rows; ++i) l[i] /= d;
    for (int next = c + 1; next < column + 3; ++next)
      add_multiple(&value_[panel.at(next, next)], l + next, -d * l[next], panel.rows - next);
  }
  return true;
}

// x, [rows, count] by columns, becomes L^-1 x.
template <class Real>
template <int count>
void Factors<Real>::forward(int s, Real* x, Work& work) const {
  const Panel l = panel(s);
  const auto size = static_cast<std::ptrdiff_t>(rows());
  bool is_zero = true;
  work.own.resize(static_cast<std::size_t>(count * l.columns));
  for (int n = 0; n < count; ++n) {
    Real* own = x + n * size + l.first;
    for (int c = 0; c < l.columns; ++c) {
      is_zero = is_zero && own[c] == 0;
      entry(work.own, count * c + n) = own[c];
      add_multiple(own + c + 1, &value_[l.at(c + 1, c)], -own[c], l.columns - c - 1);
    }
  }
  if (is_zero) return;
  const int below = l.rows - l.columns;
  const std::ptrdiff_t ld = below + slack;
  product<count>(value_.data() + l.at(l.columns, 0), l.rows, below, std::span<const Real>(work.own),
                 work.below.data(), ld);
  for (int n = 0; n < count; ++n) {
    const Real* change = work.below.data() + n * ld;
    for (const int row : nodes_.rows_of(s))
      for (int k = 0; k < 3; ++k) x[n * size + 3 * row + k] -= *change++;
  }
}

// x becomes L^-T x.
template <class Real>
template <int count>
void Factors<Real>::backward(int s, Real* x, Work& work) const {
  const Panel l = panel(s);
  const auto size = static_cast<std::ptrdiff_t>(rows());
  const int below = l.rows - l.columns;
  for (int n = 0; n < count; ++n) {
    Real* value = work.below.data() + n * below;
    for (const int row : nodes_.rows_of(s))
      for (int k = 0; k < 3; ++k) *value++ = x[n * size + 3 * row + k];
  }
  for (int c = l.columns - 3; c >= 0; c -= 3) {
    const auto sums =
        dots<count>(value_.data() + l.at(l.columns, c), l.rows, below, work.below.data(), below);
    for (int n = 0; n < count; ++n)
      for (int k = 3; k-- > 0;) {
        Real* own = x + n * size + l.first;
        Real sum = sums[static_cast<std::size_t>(3 * n + k)];
        for (int i = c + k + 1; i < l.columns; ++i) sum += value_[l.at(i, c + k)] * own[i];
        own[c + k] -= sum;
      }
  }
}

template <class Real>
template <class Visit>
void Factors<Real>::by_threes(std::size_t columns, Visit&& visit) const {
  std::size_t first = 0;
  for (; first + 3 <= columns; first += 3) visit(std::integral_constant<int, 3>(), first * rows());
  for (; first < columns; ++first) visit(std::integral_constant<int, 1>(), first * rows());
}

template <class Real>
void Factors<Real>::solve(std::span<Real> forces) const {
  assert(forces.size() % rows() == 0);
  std::vector<Real> x(forces.size());
  Work work{.own = {}, .below = std::vector<Real>(product_.size())};
  const std::size_t columns = forces.size() / rows();
  const auto place = [&](std::size_t i) {
    return 3 * static_cast<std::size_t>(nodes_.position[i / 3]) + i % 3;
  };
  for (std::size_t n = 0; n < forces.size(); n += rows())
    for (std::size_t i = 0; i < rows(); ++i) x[n + place(i)] = forces[n + i];
  for (int s = 0; s < nodes_.size(); ++s)
    by_threes(columns,
              [&](auto count, std::size_t begin) { forward<count()>(s, &x[begin], work); });
  for (std::size_t i = 0; i < x.size(); ++i) x[i] /= pivot_[i % rows()];
  for (int s = nodes_.size(); s-- > 0;)
    by_threes(columns,
              [&](auto count, std::size_t begin) { backward<count()>(s, &x[begin], work); });
  for (std::size_t n = 0; n < forces.size(); n += rows())
    for (std::size_t i = 0; i < rows(); ++i) forces[n + i] = x[n + place(i)];
}

template class Factors<double>;
template class Factors<long double>;

}  // namespace pulvis::sparse
