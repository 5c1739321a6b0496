// A sum of doubles that is exact until it is read: it does not depend on the order in which terms are added, nor on how
// they are dealt out to threads or ranks.
//
// Source   U. W. Kulisch & W. L. Miranker, "The arithmetic of the digital computer: a new approach", SIAM Review 28
//          (1986) 1: a fixed-point register as wide as the doubles' range, here in digits to the base 2^32 that carry late
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace pulvis {

class ExactSum {
 public:
  // Digits, and how many NaN, +infinity and -infinity were added: what ranks add up number by number.
  static constexpr std::size_t digits = 68, numbers = digits + 3;
  using Numbers = std::array<std::int64_t, numbers>;

  ExactSum() = default;
  void add(double term);
  // Of 2^30 sums at most.
  void add(const ExactSum& other);

  // The sum rounded once, to nearest: infinity beyond the range; NaN where a term was, or infinities of both signs.
  double value() const;

  // Carried out, so that the numbers of 2^30 sums can be added up in 64 bits.
  const Numbers& carried();
  // What the numbers of several sums add up to.
  static ExactSum of(std::span<const std::int64_t> numbers);

 private:
  static constexpr std::size_t nan = digits, plus = digits + 1, minus = digits + 2;
  void carry();

  Numbers number_{};
  std::int64_t terms_ = 0;  // since the last carry
};

}  // namespace pulvis
