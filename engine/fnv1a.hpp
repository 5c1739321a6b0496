// FNV-1a, 64 bits: a hash that is the same on every machine. Not against malice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace pulvis {

inline constexpr std::uint64_t fnv1a_start = 0xcbf29ce484222325U;

// Goes on from `hash`, so that data in pieces hash as in one.
inline std::uint64_t fnv1a(std::span<const std::byte> bytes, std::uint64_t hash = fnv1a_start) {
  for (const std::byte byte : bytes) {
    hash ^= static_cast<std::uint64_t>(byte);
    hash *= 0x100000001b3U;
  }
  return hash;
}

// The same over words of eight bytes, eight times as fast; bytes that are left over count as one word each.
// Another hash than fnv1a's. Pieces must be cut at whole words.
inline std::uint64_t fnv1a_words(std::span<const std::byte> bytes,
                                 std::uint64_t hash = fnv1a_start) {
  for (; bytes.size() >= sizeof(std::uint64_t); bytes = bytes.subspan(sizeof(std::uint64_t))) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), sizeof word);
    hash = (hash ^ word) * 0x100000001b3U;
  }
  return fnv1a(bytes, hash);
}

}  // namespace pulvis
