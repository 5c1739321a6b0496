#include "engine/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace pulvis {
namespace {

unsigned char byte_at(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

// Number of bytes of the UTF-8 character at `i`; 0: invalid.
std::size_t length_at(std::string_view text, std::size_t i) {
  const unsigned char first = byte_at(text, i);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xC2 && first < 0xE0 ? 2
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xF0 && first < 0xF5 ? 4
                                                             : 0;
  if (length == 0 || i + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte_at(text, i + k) & 0xC0U) != 0x80U) return 0;
  return length;
}

bool controls(std::string_view character) {
  const unsigned char first = byte_at(character, 0);
  if (character.size() == 1) return first < 0x20 || first == 0x7F;
  return first == 0xC2 && byte_at(character, 1) < 0xA0;
}

std::string shown(std::string_view text, std::string_view kept) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = length_at(text, i);
    const std::string_view character = text.substr(i, std::max<std::size_t>(length, 1));
    const bool stays = kept.find(text[i]) != std::string_view::npos;
    if (stays || (length > 0 && !controls(character)))
      out += character;
    else
      for (std::size_t k = 0; k < character.size(); ++k)
        fmt::format_to(std::back_inserter(out), "\\x{:02x}", byte_at(character, k));
    i += character.size();
  }
  return out;
}

}  // namespace

std::string printable(std::string_view text) { return shown(text, ""); }
std::string printable_lines(std::string_view text) { return shown(text, "\n\t"); }

}  // namespace pulvis
