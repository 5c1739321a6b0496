#include "engine/shortened.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace pulvis {
namespace {

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

}  // namespace

std::string shortened(std::string_view text, std::size_t longest) {
  if (text.size() <= longest) return std::string(text);
  std::size_t head = 2 * longest / 3, tail = text.size() - longest / 4;
  while (head > 0 && continues_character(text[head])) --head;
  while (tail < text.size() && continues_character(text[tail])) ++tail;
  const auto characters =
      std::ranges::count_if(text, [](char c) { return !continues_character(c); });
  return fmt::format("{}...{} ({} characters)", text.substr(0, head), text.substr(tail),
                     characters);
}

}  // namespace pulvis
