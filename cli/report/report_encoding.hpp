// Encoding of numbers inside report.html: differences of neighbours, sorted into byte planes
// (all low bytes first), deflated, and base64-encoded. cli/report/page/payload.js decodes them.
//
// Neighbouring numbers of a mesh are similar, so the differences are small and the high planes are
// nearly all zeros: they compress well.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace pulvis {

std::vector<unsigned char> deflated(const std::vector<unsigned char>& bytes);
std::string base64(const std::vector<unsigned char>& bytes);

// `stride`: distance back to the similar neighbour (2 for interleaved x and y).
std::string encoded(std::span<const std::uint16_t> values, std::size_t stride);
std::string encoded(std::span<const std::int32_t> values, std::size_t stride);
std::string encoded(std::span<const float> values);

struct Range {
  double low = 0, high = 0;
};

// 0..levels over the range; 65535 stands for NaN or infinity.
std::vector<std::uint16_t> quantised(std::span<const double> values, const Range& range,
                                     std::size_t levels = 65534);

// Six digits, as many as anybody reads; NaN and infinity become null.
nlohmann::ordered_json rounded(const std::vector<double>& values);

}  // namespace pulvis
