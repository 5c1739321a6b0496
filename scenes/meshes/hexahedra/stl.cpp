#include "scenes/meshes/hexahedra/stl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string_view>
#include <utility>

#include "engine/files/input_file.hpp"

namespace pulvis::space {
namespace {

constexpr std::size_t header = 84, record = 50;  // bytes, of a binary file
constexpr std::size_t most_triangles = 2'000'000;
constexpr std::size_t largest_stl = 640U << 20U;  // bytes; as text a triangle takes about 300

std::uint32_t little_endian(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

void refuse_count(std::size_t count) {
  if (count > most_triangles)
    throw BadStl(fmt::format("{} triangles, allowed: at most {}", count, most_triangles));
}

constexpr std::string_view space = " \t\r\n";

bool is_word(std::string_view text, std::string_view lower) {  // in small or capital letters
  return std::ranges::equal(text, lower, {}, [](unsigned char c) { return std::tolower(c); });
}

std::string_view without_mark_and_space(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";  // of UTF-8
  if (text.starts_with(mark)) text.remove_prefix(mark.size());
  return text.substr(std::min(text.find_first_not_of(space), text.size()));
}

// Many binary files start with "solid" too: their length reveals them, or bytes that no text has.
bool is_binary(const std::string& bytes) {
  const bool is_text = std::ranges::none_of(bytes, [](unsigned char c) {
    return c < ' ' && space.find(static_cast<char>(c)) == std::string_view::npos;
  });
  if (is_text && !is_word(without_mark_and_space(bytes).substr(0, 5), "solid"))
    throw BadStl("it is neither a binary file nor a text that begins with 'solid'");
  return !is_text && bytes.size() >= header;
}

std::vector<Triangle> binary_triangles(const std::string& bytes) {
  const std::size_t count = little_endian(&bytes[header - 4]);
  refuse_count(count);
  if (bytes.size() < header + record * count)
    throw BadStl(fmt::format("the file is truncated: {} triangles announced, {} present", count,
                             (bytes.size() - header) / record));
  std::vector<Triangle> triangles(count);
  for (std::size_t t = 0; t < count; ++t)
    for (std::size_t i = 0; i < 9; ++i) {
      const char* at = &bytes[header + record * t + 12 + 4 * i];
      triangles[t][i / 3][static_cast<Eigen::Index>(i % 3)] =
          static_cast<double>(std::bit_cast<float>(little_endian(at)));
    }
  return triangles;
}

class Words {
 public:
  explicit Words(std::string_view text) : left_(text) {}
  std::string_view next() {
    left_.remove_prefix(std::min(left_.find_first_not_of(space), left_.size()));
    const std::string_view word = left_.substr(0, left_.find_first_of(space));
    left_.remove_prefix(word.size());
    return word;
  }
  void skip_line() { left_.remove_prefix(std::min(left_.find('\n'), left_.size())); }
  double number() {
    std::string_view word = next();
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc() || end != word.data() + word.size())
      throw BadStl(fmt::format("'{}' where a coordinate is expected", word.substr(0, 20)));
    return value;
  }

 private:
  std::string_view left_;
};

// Only the corners are used: the normals given in such files follow from them.
std::vector<Triangle> text_triangles(const std::string& text) {
  std::vector<Triangle> triangles;
  std::size_t corners = 0;
  Words words(without_mark_and_space(text));
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (is_word(word, "solid")) words.skip_line();  // its name may have any words
    if (!is_word(word, "vertex")) continue;
    if (corners % 3 == 0) triangles.emplace_back();
    for (Eigen::Index i = 0; i < 3; ++i) triangles.back()[corners % 3][i] = words.number();
    ++corners;
  }
  refuse_count(triangles.size());
  if (corners % 3 != 0)
    throw BadStl("the file is truncated: the last triangle does not have three corners");
  return triangles;
}

void refuse_numbers(const std::vector<Triangle>& triangles) {
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const Vec3& p : triangles[t])
      if (!p.allFinite())
        throw BadStl(fmt::format("triangle {} has a corner that is not finite", t + 1));
}

using Corner3 = std::array<double, 3>;
Corner3 key_of(const Vec3& p) { return {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0}; }  // -0 is 0

// Every side is traversed once in each direction.
void refuse_open(const std::vector<Triangle>& triangles) {
  std::map<std::pair<Corner3, Corner3>, int> sides;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) ++sides[{key_of(t[k]), key_of(t[(k + 1) % 3])}];
  for (const auto& [side, count] : sides) {
    const auto back = sides.find({side.second, side.first});
    if (back == sides.end())
      throw BadStl(
          fmt::format("the surface is open, or two triangles have opposite orientation, at the "
                      "edge from ({:g}, {:g}, {:g}), allowed: a closed surface",
                      side.first[0], side.first[1], side.first[2]));
    if (back->second != count)
      throw BadStl(fmt::format("more than two triangles meet at the edge from ({:g}, {:g}, {:g})",
                               side.first[0], side.first[1], side.first[2]));
  }
}

}  // namespace

double volume_of(const std::vector<Triangle>& triangles) {
  double volume = 0;
  for (const Triangle& t : triangles) volume += area_vector(t).dot(t[0]) / 6;
  return volume;
}

Vec3 centre_of_volume(const std::vector<Triangle>& triangles) {
  Vec3 moment = Vec3::Zero();
  for (const Triangle& t : triangles)
    moment += area_vector(t).dot(t[0]) / 24 * (t[0] + t[1] + t[2]);
  return moment / volume_of(triangles);
}

std::vector<Triangle> stl_triangles(const std::string& bytes) {
  std::vector<Triangle> triangles =
      is_binary(bytes) ? binary_triangles(bytes) : text_triangles(bytes);
  if (triangles.empty())
    throw BadStl("it contains no triangles, allowed: an STL file, binary or text");
  refuse_numbers(triangles);
  refuse_open(triangles);
  if (volume_of(triangles) <= 0)
    throw BadStl(
        "its triangles face inwards, allowed: corners counter-clockwise as seen from outside");
  return triangles;
}

std::vector<Triangle> read_stl(const std::string& path) {
  try {
    return stl_triangles(text_of_input(path, largest_stl));
  } catch (const UnfitInput& unfit) {
    throw BadStl(
        fmt::format("the file '{}': {}, allowed: an STL file, binary or text", path, unfit.what()));
  }
}

std::optional<std::string> why_not_star_shaped(const std::vector<Triangle>& triangles) {
  const Vec3 centre = centre_of_volume(triangles);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Vec3 normal = area_vector(triangles[t]);
    if (normal.norm() > 0 && normal.dot(triangles[t][0] - centre) <= 0)
      return fmt::format(
          "from its centre of volume ({:g}, {:g}, {:g}), triangle {} is not visible from inside",
          centre.x(), centre.y(), centre.z(), t + 1);
  }
  return {};
}

}  // namespace pulvis::space
