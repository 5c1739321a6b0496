// The only way for a system to reach data: its members Read<C>, Write<C> and Structural<Entity>.
// A system may touch only what it declares; writing through Read does not compile.
#pragma once

#include <optional>
#include <span>

#include "engine/bundle.hpp"
#include "engine/world.hpp"

namespace pulvis {

// The rows of one column that belong to one chunk, indexed from zero: view(row, component).
template <class C, class Pointer>
class ChunkView {
 public:
  explicit ChunkView(Pointer base) : base_(base) {}
  auto& operator()(Row<typename C::Entity> row, int component = 0) const {
    // Components at a fixed offset from the row share one base address.
    return (base_ + static_cast<std::ptrdiff_t>(row.value) * C::count)[component];
  }

 private:
  Pointer base_;
};

// The same for the lanes held in register `part`.
template <class C, class PacketPointer>
class PartView {
 public:
  PartView(PacketPointer base, int part) : base_(base + part) {}
  auto& operator()(Row<typename C::Entity> row, int component = 0) const {
    return (base_ +
            static_cast<std::ptrdiff_t>(row.value) * (C::count * stride))[component * stride];
  }

 private:
  static constexpr int stride = simd::registers;
  PacketPointer base_;
};
template <class C>
using ReadPart = PartView<C, const Packet*>;
template <class C>
using WritePart = PartView<C, Packet*>;
template <class C>
ReadPart<C> part_of(const ChunkView<C, const Lane*>& view, int part) {
  return {reinterpret_cast<const Packet*>(&view(Row<typename C::Entity>(0))), part};
}
template <class C>
WritePart<C> part_of(const ChunkView<C, Lane*>& view, int part) {
  return {reinterpret_cast<Packet*>(&view(Row<typename C::Entity>(0))), part};
}

namespace detail {
template <class C>
std::int32_t first_row(const Column<C>& column, Chunk chunk) {
  return column.table.chunk_begin[static_cast<std::size_t>(chunk.index)];
}

// Start of a chunk's rows: in the worker's buffer for scratch and for transient columns that the graph drops.
template <class C>
auto* rows_of(Column<C>& column, Chunk chunk) {
  using Number = std::conditional_t<C::Entity::laned, Lane, typename C::value_type>;
  if constexpr (C::transient || C::scratch)
    if (C::scratch || (chunk.drops && column.has_transient()))
      return reinterpret_cast<Number*>(column.transient(chunk.worker));
  return reinterpret_cast<Number*>(column.data()) +
         static_cast<std::size_t>(first_row(column, chunk)) * C::count;
}

template <class T>
AccessInfo access_info(AccessMode mode) {
  if constexpr (IsComponent<T>)
    return {type_key<T>(),
            type_key<typename T::Entity>(),
            std::string(T::Entity::name) + "/" + T::info.name,
            mode,
            T::Entity::by_chunk,
            T::transient || T::scratch};
  else
    return {type_key<T>(), nullptr, T::resource_name, mode, false};
}
}  // namespace detail

// Access to components: operator()(row, component) for rows of a plain table, chunk(c) for the rows of a chunk.
template <class T>
class Read {
 public:
  static bool is_there(const World& world) { return world.has<T>(); }
  explicit Read(World& world) : column_(&world.column<T>()) {}
  static AccessInfo info() { return detail::access_info<T>(AccessMode::read); }

  const auto& operator()(Row<typename T::Entity> row, int component = 0) const {
    static_assert(!T::Entity::laned, "rows of a laned kind of entity are reached chunk by chunk");
    return column_->values()[static_cast<std::size_t>(row.value) * T::count + component];
  }
  auto chunk(Chunk c) const {
    const auto* first = detail::rows_of(*column_, c);
    return ChunkView<T, decltype(first)>(first);
  }
  // The whole column as stored in memory: [row][component], in groups of eight lanes if laned.
  std::span<const typename T::value_type> values() const {
    return {column_->values(), column_->bytes() / sizeof(typename T::value_type)};
  }
  int rows() const { return static_cast<int>(column_->table.rows); }
  const Table& table() const { return column_->table; }

 private:
  Column<T>* column_;
};

template <class T>
class Write {
 public:
  static bool is_there(const World& world) { return world.has<T>(); }
  explicit Write(World& world) : column_(&world.column<T>()) {}
  static AccessInfo info() { return detail::access_info<T>(AccessMode::write); }

  auto& operator()(Row<typename T::Entity> row, int component = 0) const {
    static_assert(!T::Entity::laned, "rows of a laned kind of entity are reached chunk by chunk");
    return column_->values()[static_cast<std::size_t>(row.value) * T::count + component];
  }
  auto chunk(Chunk c) const {
    auto* first = detail::rows_of(*column_, c);
    return ChunkView<T, decltype(first)>(first);
  }
  std::span<typename T::value_type> values() const {
    return {column_->values(), column_->bytes() / sizeof(typename T::value_type)};
  }
  int rows() const { return static_cast<int>(column_->table.rows); }
  const Table& table() const { return column_->table; }

 private:
  Column<T>* column_;
};

template <IsResource R>
class Read<R> {
 public:
  static bool is_there(const World& world) { return world.has<R>(); }
  explicit Read(World& world) : resource_(&world.resource<R>()) {}
  static AccessInfo info() { return detail::access_info<R>(AccessMode::read); }
  const R& operator*() const { return *resource_; }
  const R* operator->() const { return resource_; }

 private:
  const R* resource_;
};

template <IsResource R>
class Write<R> {
  static_assert(HasState<R>, "a resource that a system writes has a state that checkpoints keep");

 public:
  static bool is_there(const World& world) { return world.has<R>(); }
  explicit Write(World& world) : resource_(&world.resource<R>()) {}
  static AccessInfo info() { return detail::access_info<R>(AccessMode::write); }
  R& operator*() const { return *resource_; }
  R* operator->() const { return resource_; }

 private:
  R* resource_;
};

// The right to change the number of rows of an entity type. All its columns are resized with it, so this excludes
// any other access to that entity type: a sync point.
template <class Entity>
class Structural {
 public:
  static bool is_there(const World& world) { return world.has_table<Entity>(); }
  explicit Structural(World& world) : world_(&world) {}
  static AccessInfo info() {
    return {type_key<Entity>(), type_key<Entity>(), std::string(Entity::name) + "/*",
            AccessMode::structural, false};
  }
  int rows() const { return static_cast<int>(world_->table<Entity>().rows); }
  void rebuild(const std::vector<std::int32_t>& sources) const { world_->rebuild<Entity>(sources); }

 private:
  World* world_;
};

// An access or bundle that a system uses only if the scene has it: test with `if (handle)`. A bundle is present if
// its first member is; all other members must then be present too. If present, the usual access rules apply.
template <class T>
class Optional {
 public:
  explicit Optional(World& world) : Optional(detail::Opener{world}) {}
  explicit Optional(const detail::Opener& opener) {
    if (detail::is_there<T>(opener.world)) inner_.emplace(opener.open<T>());
  }
  explicit operator bool() const { return inner_.has_value(); }
  const T& operator*() const { return *inner_; }
  const T* operator->() const { return &*inner_; }

 private:
  std::optional<T> inner_;
};

}  // namespace pulvis
