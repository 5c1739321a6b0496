#include "engine/state_bytes.hpp"

#include <cstring>

namespace pulvis {

void StateWriter::put_raw(const void* data, std::size_t size) {
  const std::span more(static_cast<const std::byte*>(data), size);
  bytes_.insert(bytes_.end(), more.begin(), more.end());
}

void StateReader::take_raw(void* data, std::size_t size) {
  if (size > left_.size()) throw BadState("bytes are missing");
  if (size > 0) std::memcpy(data, left_.data(), size);
  left_ = left_.subspan(size);
}

}  // namespace pulvis
