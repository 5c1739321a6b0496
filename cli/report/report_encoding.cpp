#include "cli/report/report_encoding.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace pulvis {
namespace {

using Bytes = std::vector<unsigned char>;

template <class Unsigned>
Bytes planes_of_differences(std::span<const Unsigned> values, std::size_t stride) {
  Bytes planes(values.size() * sizeof(Unsigned));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Unsigned before = i < stride ? Unsigned{0} : values[i - stride];
    const auto difference = static_cast<Unsigned>(values[i] - before);  // wraps, as in the decoder
    for (std::size_t plane = 0; plane < sizeof(Unsigned); ++plane) {
      planes[plane * values.size() + i] = static_cast<unsigned char>(difference >> (8 * plane));
    }
  }
  return planes;
}

}  // namespace

std::vector<unsigned char> deflated(const std::vector<unsigned char>& bytes) {
  uLongf size = compressBound(bytes.size());
  Bytes packed(size);
  const int status = compress2(packed.data(), &size, bytes.data(), bytes.size(), 6);
  if (status != Z_OK) throw std::runtime_error("zlib refused the report's data");
  packed.resize(size);
  return packed;
}

std::string base64(const std::vector<unsigned char>& bytes) {
  static constexpr const char* letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t there = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (k < there ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= there ? letters[word >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

std::string encoded(std::span<const std::uint16_t> values, std::size_t stride) {
  return base64(deflated(planes_of_differences(values, stride)));
}

std::string encoded(std::span<const std::int32_t> values, std::size_t stride) {
  std::vector<std::uint32_t> same(values.size());
  std::transform(values.begin(), values.end(), same.begin(),
                 [](std::int32_t value) { return std::bit_cast<std::uint32_t>(value); });
  return base64(deflated(planes_of_differences<std::uint32_t>(same, stride)));
}

std::string encoded(std::span<const float> values) {
  std::vector<std::uint32_t> bits(values.size());
  std::transform(values.begin(), values.end(), bits.begin(),
                 [](float value) { return std::bit_cast<std::uint32_t>(value); });
  return base64(deflated(planes_of_differences<std::uint32_t>(bits, 1)));
}

std::vector<std::uint16_t> quantised(std::span<const double> values, const Range& range,
                                     std::size_t levels) {
  const double width = range.high - range.low;
  std::vector<std::uint16_t> codes(values.size(), 65535);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    const double share = width > 0 ? (values[i] - range.low) / width : 0;
    codes[i] = static_cast<std::uint16_t>(
        std::lround(static_cast<double>(levels) * std::clamp(share, 0.0, 1.0)));
  }
  return codes;
}

nlohmann::ordered_json rounded(const std::vector<double>& values) {
  auto list = nlohmann::ordered_json::array();
  for (const double value : values) {
    const double size = value == 0 || !std::isfinite(value)
                            ? 1.0
                            : std::pow(10.0, 5 - std::floor(std::log10(std::abs(value))));
    list.push_back(std::round(value * size) / size);
  }
  return list;
}

}  // namespace pulvis
