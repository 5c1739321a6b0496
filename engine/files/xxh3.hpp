// XXH3, 64 bits (library xxHash): detects whether bytes have changed since they were written, and identifies
// a state or scene by a number. The same on every machine. No protection against tampering.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

struct XXH3_state_s;

namespace pulvis {

// Hash of data that arrives in pieces: the result does not depend on how it is split.
class Xxh3 {
 public:
  Xxh3();
  void add(std::span<const std::byte> bytes);
  std::uint64_t value() const;

 private:
  struct Release {
    void operator()(XXH3_state_s* state) const;
  };
  std::unique_ptr<XXH3_state_s, Release> state_;
};

// Continues from another hash if one is given.
std::uint64_t xxh3(std::span<const std::byte> bytes, std::uint64_t seed = 0);

}  // namespace pulvis
