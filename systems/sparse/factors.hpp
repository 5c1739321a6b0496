// Sparse factors K = L D L^T of a symmetric matrix of 3 x 3 blocks, by supernodes: the products of dense parts run in lanes.
// Every sum has one order, whatever the instruction set: the same bits on every processor, which tuned BLAS do not give.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "systems/sparse/supernodes.hpp"

namespace pulvis::sparse {

// `Real`: double or long double.
template <class Real>
class Factors {
 public:
  // `position`: of every block, in an order with little fill.
  Factors(const BlockGraph& graph, std::vector<std::int32_t> position);

  // `values`: of the lower triangle by columns, rows ascending. False if a pivot is zero or not finite.
  bool factorise(std::span<const Real> values);
  // K^-1 times forces: [rows, n] by columns, replaced by the solutions.
  void solve(std::span<Real> forces) const;

  std::span<const Real> pivots() const { return pivot_; }  // [rows] D, in the order of elimination
  std::size_t entries() const { return value_.size(); }
  std::size_t rows() const { return pivot_.size(); }

 private:
  // A supernode's entries of L, dense by columns: first their square part, then the rows below.
  struct Panel {
    std::size_t begin;         // in value_
    int first, columns, rows;  // rows: all of them

    std::size_t at(int row, int column) const {
      return begin + static_cast<std::size_t>(column) * static_cast<std::size_t>(rows) +
             static_cast<std::size_t>(row);
    }
  };
  // What one supernode subtracts from another: the rows below it from `begin` on; up to `end`, they are its columns.
  struct Update {
    Panel from;
    std::span<const std::int32_t> rows;
    int begin, end;
  };

  Panel panel(int s) const;
  void find_places(const BlockGraph& graph);
  std::size_t place_of(int row, int column) const;
  void subtract(const Update& update, const Panel& to);
  bool factorise(const Panel& panel);
  bool factorise_block(const Panel& panel, int column);
  void scale(const Panel& panel, int row, int columns);
  struct Work {
    std::vector<Real> own, below;  // of a supernode
  };
  template <int count>
  void forward(int s, Real* x, Work& work) const;
  template <int count>
  void backward(int s, Real* x, Work& work) const;
  // Threes of columns take a third of the time, and each column has the bits of its separate solution.
  template <class Visit>
  void by_threes(std::size_t columns, Visit&& visit) const;

  Supernodes nodes_;
  std::vector<std::size_t> begin_;  // [supernodes + 1] into value_
  std::vector<Real> value_;
  std::vector<Real> pivot_;
  std::vector<std::size_t> place_;  // [values] in value_
  // Reused by every factorisation:
  std::vector<std::int32_t> local_;  // [blocks] row of a panel
  std::vector<Real> scaled_, product_;
};

}  // namespace pulvis::sparse
