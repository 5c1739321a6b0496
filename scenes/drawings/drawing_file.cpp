#include "scenes/drawings/drawing_file.hpp"

#include <algorithm>

#include "scenes/drawings/dxf_outline.hpp"
#include "scenes/drawings/svg_outline.hpp"

namespace pulvis::drawing {
namespace {

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  });
  return ending;
}

}  // namespace

bool is_drawing(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  return ending == ".svg" || ending == ".dxf";
}

std::vector<Chain> chains_in(const std::filesystem::path& path, const std::string& text,
                             const std::string& unit, const std::string& layer) {
  return ending_of(path) == ".svg" ? chains_of_svg(text, unit, layer)
                                   : chains_of_dxf(text, unit, layer);
}

}  // namespace pulvis::drawing
