// An exact sum of doubles, rounded only when it is read: it does not depend on the order in which terms are added, nor on
// how they are distributed to threads or ranks.
//
// Source   U. W. Kulisch & W. L. Miranker, "The arithmetic of the digital computer: a new approach", SIAM Review 28
//          (1986) 1: a fixed-point register as wide as the range of doubles, here with base 2^32 digits and delayed carry
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace pulvis {

class ExactSum {
 public:
  // Digits, and the counts of NaN, +infinity and -infinity terms: ranks add these numbers element by element.
  static constexpr std::size_t digits = 68, numbers = digits + 3;
  using Numbers = std::array<std::int64_t, numbers>;

  ExactSum() = default;
  void add(double term);
  // For at most 2^30 sums.
  void add(const ExactSum& other);

  // The sum rounded once, to nearest: infinity beyond the range; NaN if any term was NaN, or for infinities of both signs.
  double value() const;

  // With carries propagated, so that the numbers of 2^30 sums can be added in 64 bits.
  const Numbers& carried();
  // The sum represented by the added numbers of several sums.
  static ExactSum of(std::span<const std::int64_t> numbers);

 private:
  static constexpr std::size_t nan = digits, plus = digits + 1, minus = digits + 2;
  void carry();

  Numbers number_{};
  std::int64_t terms_ = 0;  // since the last carry
};

}  // namespace pulvis
