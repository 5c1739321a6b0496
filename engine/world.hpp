// The world: tables (how many rows an entity type has) and the columns and resources requested by a scene.
// Only what was added by name is allocated; asking for a missing column is an error that names it.
#pragma once

#include <cstddef>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <vector>

#include "engine/component.hpp"
#include "engine/lane.hpp"
#include "engine/state_bytes.hpp"

namespace pulvis {

struct FreeBuffer {
  std::size_t mapped = 0;  // bytes; 0: allocated on the heap
  void operator()(std::byte* p) const;
};

// Zeroed memory, aligned to cache lines. Large buffers use huge pages; physical memory is only taken for pages that are
// written. `sparse`: small pages, also for small buffers, so that little memory is taken beyond what is written.
class Buffer {
 public:
  enum class Kind { dense, sparse };
  Buffer() = default;
  explicit Buffer(std::size_t bytes, Kind kind = Kind::dense);
  // For dense buffers. Keeps the contents that fit; large buffers are not copied. New bytes are indeterminate.
  void resize(std::size_t bytes);
  std::byte* data() { return data_.get(); }
  const std::byte* data() const { return data_.get(); }
  std::size_t bytes() const { return bytes_; }

 private:
  std::unique_ptr<std::byte[], FreeBuffer> data_;
  std::size_t bytes_ = 0;
};

struct Table;

class ColumnBase {
 public:
  ColumnBase(ComponentInfo declared, std::string at, int numbers, std::size_t bytes_of_row,
             bool is_transient, bool is_scratch)
      : info(declared),
        entity(std::move(at)),
        count(numbers),
        row_bytes(bytes_of_row),
        declared_transient(is_transient),
        scratch(is_scratch) {}
  virtual ~ColumnBase() = default;
  ColumnBase(const ColumnBase&) = delete;
  ColumnBase& operator=(const ColumnBase&) = delete;

  void allocate(std::size_t rows, Buffer::Kind kind) { buffer_ = Buffer(rows * row_bytes, kind); }
  // For sparse columns: frees the memory of these rows, which then read as zeros. Applies to whole pages only.
  void drop(std::size_t first_row, std::size_t rows);
  // For sparse columns: announces that these half-open ranges of rows will be written. Many rows get huge pages; memory may
  // then also be taken for adjacent rows.
  void expect(const std::vector<std::pair<std::size_t, std::size_t>>& runs);
  // Transient rows: this many for each worker.
  void allocate_transient(std::size_t rows_of_worker, int workers);
  bool has_transient() const { return bytes_of_worker_ > 0; }
  std::byte* transient(int worker) {
    return transient_.data() + static_cast<std::size_t>(worker) * bytes_of_worker_;
  }
  // New row r gets the values of old row sources[r]; a negative source gives zeros. In place: the non-negative sources
  // must increase.
  void rebuild(const std::vector<std::int32_t>& sources);

  std::size_t bytes() const { return buffer_.bytes(); }
  virtual const Table& owner() const = 0;
  // The rows of a chunk; empty if the entity type is not divided into chunks.
  virtual std::span<const std::byte> of_chunk(int chunk) const = 0;
  std::byte* data() { return buffer_.data(); }
  const std::byte* data() const { return buffer_.data(); }

  const ComponentInfo info;
  const std::string entity;
  const int count;                // numbers per row (per lane of a slot)
  const std::size_t row_bytes;    // of a row, or of a slot with all its lanes
  const bool declared_transient;  // nobody needs it after its step
  const bool scratch;             // per worker, one chunk each

 private:
  Buffer buffer_, transient_;
  std::size_t bytes_of_worker_ = 0;
};

// The rows of one entity type. `chunk_begin` (chunks + 1 entries) gives the rows of each chunk;
// it is empty for entity types that are not divided into chunks.
struct Table {
  std::string entity;
  bool laned = false;
  std::size_t rows = 0;
  std::vector<std::int32_t> chunk_begin;
  std::vector<ColumnBase*> columns;

  std::size_t rows_of_largest_chunk() const;
};

// Of a table stored by particle: the first row of a slot.
inline std::ptrdiff_t first_row(const Table& table, int slot) {
  const auto chunk = static_cast<std::size_t>(slot / lane_count);
  const std::ptrdiff_t begin = table.chunk_begin[chunk],
                       rows = (table.chunk_begin[chunk + 1] - begin) / lane_count;
  return begin + slot % lane_count * rows;
}

template <IsComponent C>
class Column : public ColumnBase {
 public:
  using value_type = typename C::value_type;
  static constexpr bool laned = C::Entity::laned;
  static constexpr std::size_t bytes_a_row =
      sizeof(value_type) * C::count * (laned ? lane_count : 1);

  explicit Column(const Table& owner)
      : ColumnBase(C::info, C::Entity::name, C::count, bytes_a_row, C::transient, C::scratch),
        table(owner) {}

  const Table& owner() const override { return table; }
  std::span<const std::byte> of_chunk(int chunk) const override {
    if (table.chunk_begin.empty()) return {};
    const auto c = static_cast<std::size_t>(chunk);
    const auto first = static_cast<std::size_t>(table.chunk_begin[c]);
    const auto last = static_cast<std::size_t>(table.chunk_begin[c + 1]);
    return {data() + first * row_bytes, (last - first) * row_bytes};
  }

  value_type* values() { return reinterpret_cast<value_type*>(data()); }
  const value_type* values() const { return reinterpret_cast<const value_type*>(data()); }
  Lane* lanes() requires(laned&& std::is_same_v<value_type, double>) {
    return reinterpret_cast<Lane*>(data());
  }
  const Lane* lanes() const requires(laned&& std::is_same_v<value_type, double>) {
    return reinterpret_cast<const Lane*>(data());
  }

  const Table& table;
};

class World {
 public:
  // `kind`: of columns that are divided into chunks. Sparse if a process holds only some of many chunks.
  explicit World(Buffer::Kind kind = Buffer::Kind::dense) : kind_(kind) {}
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  // An entity type divided into chunks gets the number of rows (or slots) of every chunk; others just a total.
  template <class Entity>
  void add_table(const std::vector<std::int32_t>& rows_of_chunk);
  template <class Entity>
  void add_table(std::size_t rows);
  template <IsComponent C>
  void add();
  template <IsResource R, class... Args>
  R& emplace(Args&&... args);

  // For sparse worlds: the chunks whose rows will be written; also applies to columns added later.
  void hold(const std::vector<bool>& own_chunks);

  template <class Entity>
  Table& table();
  template <class Entity>
  bool has_table() const {
    return tables_.contains(type_key<Entity>());
  }
  template <IsComponent C>
  Column<C>& column();
  template <IsComponent C>
  const Column<C>& column() const {
    return const_cast<World*>(this)->column<C>();
  }
  template <IsComponent C>
  bool has() const {
    return columns_.contains(type_key<C>());
  }
  template <IsResource R>
  R& resource();
  template <IsResource R>
  const R& resource() const {
    return const_cast<World*>(this)->resource<R>();
  }
  template <IsResource R>
  bool has() const {
    return resources_.contains(type_key<R>());
  }

  // Null if no column has this key.
  const ColumnBase* find(TypeKey key) const {
    const auto found = columns_.find(key);
    return found == columns_.end() ? nullptr : found->second.get();
  }

  // Gives every column of the entity type new rows; see ColumnBase::rebuild. Throws logic_error if rows would be
  // reordered.
  template <class Entity>
  void rebuild(const std::vector<std::int32_t>& sources);

  // In the order in which they were added, without scratch columns.
  const std::vector<const ColumnBase*>& columns() const { return ordered_; }
  // Takes over the rows of a column from a checkpoint. An entity type not divided into chunks gets that many rows;
  // all its columns must follow. Throws BadState if they do not fit.
  void set_column(const ColumnBase& column, std::span<const std::byte> rows);
  // Space for this many rows of a column, to be written; its entity type then has this many rows.
  std::span<std::byte> room_for(const ColumnBase& column, std::size_t rows);
  // Frees the memory of the column until it gets new rows. For entity types divided into chunks: only while it is sparse.
  void drop_column(const ColumnBase& column);
  struct SavedResource {
    std::string name;
    std::function<std::vector<std::byte>()> state;
    std::function<void(std::span<const std::byte>)> set_state;
  };
  // Those that are not fixed, in the order in which they were added.
  const std::vector<SavedResource>& saved_resources() const { return saved_resources_; }
  int chunks() const { return chunks_; }
  // Allocates, for every worker, one chunk of these transient columns and of scratch.
  void allocate_transient(const std::vector<TypeKey>& components, int workers);

 private:
  Table& insert_table(TypeKey key, Table table);
  std::pair<Table*, ColumnBase*> own(const ColumnBase& column);
  void expect_own(ColumnBase& column) const;
  static void require_increasing(const std::vector<std::int32_t>& sources);

  std::map<TypeKey, std::unique_ptr<Table>> tables_;
  std::map<TypeKey, std::unique_ptr<ColumnBase>> columns_;
  std::map<TypeKey, std::shared_ptr<void>> resources_;
  std::vector<const ColumnBase*> ordered_;
  std::vector<SavedResource> saved_resources_;
  int chunks_ = 0;
  std::vector<bool> own_chunks_;
  Buffer::Kind kind_;
};

template <class Entity>
void World::add_table(const std::vector<std::int32_t>& rows_of_chunk) {
  Table table{Entity::name, Entity::laned, 0, {0}, {}};
  for (const std::int32_t rows : rows_of_chunk)
    table.chunk_begin.push_back(table.chunk_begin.back() + rows);
  table.rows = static_cast<std::size_t>(table.chunk_begin.back());
  insert_table(type_key<Entity>(), std::move(table));
}

template <class Entity>
void World::add_table(std::size_t rows) {
  insert_table(type_key<Entity>(), Table{Entity::name, Entity::laned, rows, {}, {}});
}

template <IsComponent C>
void World::add() {
  if (has<C>()) return;
  Table& owner = table<typename C::Entity>();
  auto column = std::make_unique<Column<C>>(owner);
  if constexpr (C::scratch) {
    column->allocate_transient(owner.rows_of_largest_chunk(), 1);
    columns_.emplace(type_key<C>(), std::move(column));
    return;
  }
  column->allocate(owner.rows, owner.chunk_begin.empty() ? Buffer::Kind::dense : kind_);
  expect_own(*column);
  owner.columns.push_back(column.get());
  ordered_.push_back(column.get());
  columns_.emplace(type_key<C>(), std::move(column));
}

template <IsResource R, class... Args>
R& World::emplace(Args&&... args) {
  static_assert(
      IsFixed<R> != HasState<R>,
      "a resource says how a checkpoint keeps it: `static constexpr bool fixed = true` "
      "where it never changes, else a member template state(); see engine/state_bytes.hpp");
  auto made = std::make_shared<R>(std::forward<Args>(args)...);
  R& result = *made;
  if constexpr (HasState<R>)
    if (!has<R>())
      saved_resources_.push_back(
          {R::resource_name, [this] { return state_of(resource<R>()); },
           [this](std::span<const std::byte> bytes) { pulvis::set_state(resource<R>(), bytes); }});
  resources_[type_key<R>()] = std::move(made);
  return result;
}

template <class Entity>
Table& World::table() {
  const auto found = tables_.find(type_key<Entity>());
  if (found == tables_.end())
    throw std::logic_error(std::string("the world has no table '") + Entity::name + "'");
  return *found->second;
}

template <IsComponent C>
Column<C>& World::column() {
  const auto found = columns_.find(type_key<C>());
  if (found == columns_.end())
    throw std::logic_error(std::string("the world has no column '") + C::info.name + "' at '" +
                           C::Entity::name + "'");
  return static_cast<Column<C>&>(*found->second);
}

template <IsResource R>
R& World::resource() {
  const auto found = resources_.find(type_key<R>());
  if (found == resources_.end())
    throw std::logic_error(std::string("the world has no resource '") + R::resource_name + "'");
  return *static_cast<R*>(found->second.get());
}

template <class Entity>
void World::rebuild(const std::vector<std::int32_t>& sources) {
  Table& owner = table<Entity>();
  require_increasing(sources);
  for (ColumnBase* column : owner.columns) column->rebuild(sources);
  owner.rows = sources.size();
}

}  // namespace pulvis
