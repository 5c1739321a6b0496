// State as bytes: what a checkpoint stores of a resource. One description serves both directions:
//
//   template <class Bytes>
//   void state(Bytes& bytes) { bytes(step, time, neighbours); }
//
// StateWriter appends the named members, StateReader reads them in the same order; it throws BadState
// if the bytes do not fit, before allocating memory. Supports numbers, strings and containers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace pulvis {

class BadState : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

template <class T>
concept IsPlainNumber = std::is_arithmetic_v<T> || std::is_enum_v<T>;

class StateWriter {
 public:
  static constexpr bool reads = false;
  template <class... T>
  void operator()(T&... members) {
    (put(members), ...);
  }
  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  template <IsPlainNumber T>
  void put(const T& value) {
    put_raw(&value, sizeof value);
  }
  void put(const std::string& text) {
    put(text.size());
    put_raw(text.data(), text.size());
  }
  template <class T>
  void put(std::vector<T>& list) {
    put(list.size());
    if constexpr (IsPlainNumber<T>)
      put_raw(list.data(), list.size() * sizeof(T));
    else
      for (T& one : list) put(one);
  }
  template <class T, std::size_t N>
  void put(std::array<T, N>& list) {
    for (T& one : list) put(one);
  }
  template <class A, class B>
  void put(std::pair<A, B>& both) {
    put(both.first);
    put(both.second);
  }
  template <class T>
  void put(std::optional<T>& value) {
    put(value.has_value());
    if (value) put(*value);
  }
  template <class T>
  requires requires(T& t, StateWriter& w) { t.state(w); }
  void put(T& part) { part.state(*this); }

  void put_raw(const void* data, std::size_t size);

  std::vector<std::byte> bytes_;
};

class StateReader {
 public:
  static constexpr bool reads = true;
  explicit StateReader(std::span<const std::byte> bytes) : left_(bytes) {}

  template <class... T>
  void operator()(T&... members) {
    (take(members), ...);
  }
  bool at_end() const { return left_.empty(); }

 private:
  template <IsPlainNumber T>
  void take(T& value) {
    take_raw(&value, sizeof value);
  }
  void take(bool& value) {  // a bool must not hold any other byte
    std::uint8_t byte = 0;
    take(byte);
    if (byte > 1) throw BadState("a truth value is neither 0 nor 1");
    value = byte == 1;
  }
  void take(std::string& text) {
    text.resize(take_count(1));
    take_raw(text.data(), text.size());
  }
  template <class T>
  void take(std::vector<T>& list) {
    list.resize(take_count(IsPlainNumber<T> ? sizeof(T) : 1));
    if constexpr (IsPlainNumber<T>)
      take_raw(list.data(), list.size() * sizeof(T));
    else
      for (T& one : list) take(one);
  }
  template <class T, std::size_t N>
  void take(std::array<T, N>& list) {
    for (T& one : list) take(one);
  }
  template <class A, class B>
  void take(std::pair<A, B>& both) {
    take(both.first);
    take(both.second);
  }
  template <class T>
  void take(std::optional<T>& value) {
    bool there = false;
    take(there);
    value.reset();
    if (there) take(value.emplace());
  }
  template <class T>
  requires requires(T& t, StateReader& r) { t.state(r); }
  void take(T& part) { part.state(*this); }

  std::size_t take_count(std::size_t min_size) {
    std::size_t count = 0;
    take(count);
    if (count > left_.size() / min_size) throw BadState("a list is longer than what is there");
    return count;
  }
  void take_raw(void* data, std::size_t size);

  std::span<const std::byte> left_;
};

// Properties that a resource declares. `fixed = true`: built from the scene, never changes, so a
// checkpoint does not store it; no system can get a Write<> of it.
template <class R>
concept IsFixed = requires {
  requires R::fixed;
};
template <class R>
concept HasState = requires(R& resource, StateWriter& writer, StateReader& reader) {
  resource.state(writer);
  resource.state(reader);
};

template <HasState T>
std::vector<std::byte> state_of(T& object) {
  StateWriter writer;
  object.state(writer);
  return writer.bytes();
}

template <HasState T>
void set_state(T& object, std::span<const std::byte> bytes) {
  StateReader reader(bytes);
  object.state(reader);
  if (!reader.at_end()) throw BadState("there are more bytes than it has members");
}

}  // namespace pulvis
