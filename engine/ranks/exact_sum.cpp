#include "engine/ranks/exact_sum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace pulvis {
namespace {

constexpr std::int64_t base = std::int64_t{1} << 32;
constexpr std::int64_t most_terms = std::int64_t{1} << 30;  // each adds less than the base to a digit
constexpr int lowest = -1074;                               // 2^lowest is the unit of the first digit

__extension__ using Wide = unsigned __int128;

}  // namespace

void ExactSum::add(double term) {
  const auto bits = std::bit_cast<std::uint64_t>(term);
  const int exponent = static_cast<int>(bits >> 52 & 0x7ff);
  const bool negative = (bits >> 63) != 0;
  std::uint64_t mantissa = bits & ((std::uint64_t{1} << 52) - 1);
  if (exponent == 0x7ff) {
    number_[mantissa != 0 ? nan : negative ? minus : plus] += 1;
    return;
  }
  if (exponent != 0) mantissa |= std::uint64_t{1} << 52;
  if (mantissa == 0) return;
  const int position = std::max(exponent, 1) - 1;  // in bits, of the last bit of the mantissa
  const auto digit = static_cast<std::size_t>(position / 32);
  const Wide shifted = Wide{mantissa} << position % 32;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto part = static_cast<std::int64_t>(shifted >> 32 * k & 0xffffffff);
    number_[digit + k] += negative ? -part : part;
  }
  if (++terms_ == most_terms) carry();
}

void ExactSum::add(const ExactSum& other) {
  ExactSum carried_other = other;
  carried_other.carry();
  carry();
  for (std::size_t i = 0; i < numbers; ++i) number_[i] += carried_other.number_[i];
  terms_ = 1;
}

// Normalises every digit but the last to 0 ... 2^32 - 1; the last carries the sign.
void ExactSum::carry() {
  for (std::size_t i = 0; i + 1 < digits; ++i) {
    const std::int64_t over = number_[i] >> 32;  // rounds down
    number_[i] -= over * base;
    number_[i + 1] += over;
  }
  terms_ = 0;
}

const ExactSum::Numbers& ExactSum::carried() {
  carry();
  return number_;
}

ExactSum ExactSum::of(std::span<const std::int64_t> added) {
  ExactSum sum;
  std::ranges::copy(added.first(numbers), sum.number_.begin());
  sum.carry();
  return sum;
}

double ExactSum::value() const {
  const bool both = number_[plus] > 0 && number_[minus] > 0;
  if (number_[nan] > 0 || both) return std::numeric_limits<double>::quiet_NaN();
  if (number_[plus] > 0) return std::numeric_limits<double>::infinity();
  if (number_[minus] > 0) return -std::numeric_limits<double>::infinity();
  ExactSum sum = *this;
  sum.carry();
  const bool negative = sum.number_[digits - 1] < 0;
  if (negative) {
    for (std::size_t i = 0; i < digits; ++i) sum.number_[i] = -sum.number_[i];
    sum.carry();
  }
  std::size_t top = digits;
  while (top > 0 && sum.number_[top - 1] == 0) --top;
  if (top == 0) return 0;
  // The leading digits as one number, and whether anything is left below: rounded to nearest as a whole. Subnormal sums
  // have no digits below these.
  constexpr std::size_t leading = 3;
  const std::size_t first = top > leading ? top - leading : 0;
  Wide head = 0;
  for (std::size_t i = top; i-- > first;) head = head << 32 | static_cast<Wide>(sum.number_[i]);
  for (std::size_t i = 0; i < first; ++i)
    if (sum.number_[i] != 0) {
      head |= 1;
      break;
    }
  // For so few units these are the bits of the double itself; threads that flush denormals would lose them here.
  const bool is_own_bits = first == 0 && head < Wide{1} << 53;
  const double size =
      is_own_bits ? std::bit_cast<double>(static_cast<std::uint64_t>(head))
                  : std::ldexp(static_cast<double>(head), lowest + 32 * static_cast<int>(first));
  return negative ? -size : size;
}

}  // namespace pulvis
