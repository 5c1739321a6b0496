// A bundle: accesses that always go together, as members of a plain struct. Bundles may contain bundles; a system is
// a bundle that can be called.
//
//   struct Elasticity {
//     Read<ShearModulus> shear;
//     Read<BulkModulus> bulk;
//   };
//
// The number of members is found by trial: the largest number of values of any type that can initialise the struct.
// Opening a bundle then requests the access for each member, in order.
#pragma once

#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/world.hpp"

namespace pulvis {

enum class AccessMode { read, write, structural };

struct AccessInfo {
  TypeKey key;       // of the component, resource, or (structural) entity type
  TypeKey entity;    // entity type that the component belongs to; null for resources
  std::string name;  // "node/velocity"; "clock"
  AccessMode mode;
  bool chunked;  // the entity type is divided into chunks, so a chunk system may write it
  bool transient = false;
};

// A single column or resource: Read<C>, Write<C>, Structural<Entity>.
template <class T>
concept IsAccess = requires {
  { T::info() } -> std::same_as<AccessInfo>;
};

template <class T>
concept IsBundle = std::is_class_v<T> && std::is_aggregate_v<T>;

namespace detail {

inline constexpr std::size_t max_members = 8;  // more is hard to keep in mind: bundle them

struct AnyMember {
  template <class T>
  operator T() const;
};

template <class Bundle, std::size_t... I>
constexpr bool has_members(std::index_sequence<I...>) {
  return requires { Bundle{(void(I), AnyMember{})...}; };
}

template <class Bundle, std::size_t Count = max_members>
constexpr std::size_t count_members() {
  if constexpr (has_members<Bundle>(std::make_index_sequence<Count>{}))
    return Count;
  else if constexpr (Count > 0)
    return count_members<Bundle, Count - 1>();
  else
    static_assert(Count > 0, "a bundle has at most eight members, all of them accesses or bundles");
}

// Converts to any access or bundle, and records what it gives access to.
struct Opener {
  World& world;
  std::vector<AccessInfo>* accesses = nullptr;

  template <class T>
  operator T() const {
    return open<T>();
  }
  template <class T>
  T open() const {
    if constexpr (IsBundle<T>) {
      return open_members<T>(std::make_index_sequence<count_members<T>()>{});
    } else if constexpr (IsAccess<T>) {
      T access(world);
      if (accesses != nullptr) accesses->push_back(T::info());
      return access;
    } else {
      return T(*this);  // Optional
    }
  }

 private:
  template <class T, std::size_t... I>
  T open_members(std::index_sequence<I...>) const {
    return T{(void(I), *this)...};
  }
};

// The first member of a bundle; never called. (The language offers no shorter way to ignore the remaining members.)
template <class Bundle>
auto& first_member(Bundle& bundle) {
  constexpr std::size_t count = count_members<Bundle>();
  // clang-format off
  if constexpr (count == 1) { auto& [a] = bundle; return a; }
  if constexpr (count == 2) { auto& [a, b] = bundle; return a; }
  if constexpr (count == 3) { auto& [a, b, c] = bundle; return a; }
  if constexpr (count == 4) { auto& [a, b, c, d] = bundle; return a; }
  if constexpr (count == 5) { auto& [a, b, c, d, e] = bundle; return a; }
  if constexpr (count == 6) { auto& [a, b, c, d, e, f] = bundle; return a; }
  if constexpr (count == 7) { auto& [a, b, c, d, e, f, g] = bundle; return a; }
  if constexpr (count == 8) { auto& [a, b, c, d, e, f, g, h] = bundle; return a; }
  // clang-format on
}

// Whether the world has what an access names; for a bundle, what its first member names.
template <class T>
bool is_there(const World& world) {
  if constexpr (IsAccess<T>)
    return T::is_there(world);
  else
    return is_there<std::remove_cvref_t<decltype(first_member(std::declval<T&>()))>>(world);
}

}  // namespace detail

// All accesses of a bundle, outside a time step: used by tests that call a system directly.
template <IsBundle Bundle>
Bundle open(World& world) {
  return detail::Opener{world}.open<Bundle>();
}

}  // namespace pulvis
