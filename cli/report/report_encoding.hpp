// How numbers travel inside report.html: as differences of neighbours, sorted into planes of bytes
// (all low bytes first), deflated, and spelt in base64. cli/report/page/payload.js undoes it.
//
// Neighbouring numbers of a mesh are alike, so the differences are small and the high planes are
// nearly all zeros: that is where deflate gains.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pulvis {

std::vector<unsigned char> deflated(const std::vector<unsigned char>& bytes);
std::string base64(const std::vector<unsigned char>& bytes);

// `stride`: how far back the alike neighbour is (2 for interleaved x and y).
std::string encoded(std::span<const std::uint16_t> values, std::size_t stride);
std::string encoded(std::span<const std::int32_t> values, std::size_t stride);
std::string encoded(std::span<const float> values);

struct Range {
  double low = 0, high = 0;
};

// 0..levels over the range; 65535 stands for what is no number.
std::vector<std::uint16_t> quantised(std::span<const double> values, const Range& range,
                                     std::size_t levels = 65534);

}  // namespace pulvis
