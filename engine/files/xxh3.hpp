// XXH3, 64 bits (the library xxHash): tells whether bytes are those that were written, and names a state or a
// scene by a number. The same on every machine. Not against malice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

struct XXH3_state_s;

namespace pulvis {

// Of bytes that come in pieces: however they are cut, they hash as in one.
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

// Goes on from another hash where one is given.
std::uint64_t xxh3(std::span<const std::byte> bytes, std::uint64_t seed = 0);

}  // namespace pulvis
