#include "engine/world.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

#include "engine/entry.hpp"

namespace pulvis {
namespace {

constexpr std::align_val_t cache_line{64};
constexpr std::size_t huge_page = std::size_t{2} << 20, min_in_huge_pages = huge_page / 4;

std::size_t up_to_huge_page(std::size_t bytes) {
  return (bytes + huge_page - 1) / huge_page * huge_page;
}

// Address space aligned to a huge page: the unaligned part in front is unmapped.
std::byte* map_huge_pages(std::size_t bytes, int flags) {
  void* pages = ::mmap(nullptr, bytes + huge_page, PROT_READ | PROT_WRITE,
                       MAP_PRIVATE | MAP_ANONYMOUS | flags, -1, 0);
  if (pages == MAP_FAILED) throw std::bad_alloc();
  auto* first = static_cast<std::byte*>(pages);
  const std::size_t before = up_to_huge_page(reinterpret_cast<std::uintptr_t>(first)) -
                             reinterpret_cast<std::uintptr_t>(first);
  if (before > 0) ::munmap(first, before);
  if (before < huge_page) ::munmap(first + before + bytes, huge_page - before);
  return first + before;
}

}  // namespace

void FreeBuffer::operator()(std::byte* p) const {
  if (mapped > 0)
    ::munmap(p, mapped);
  else
    ::operator delete[](p, cache_line);
}

// A little more than requested, so that an empty table still has a valid address.
Buffer::Buffer(std::size_t bytes, Kind kind) : bytes_(bytes) {
  const bool sparse = kind == Kind::sparse && bytes > 0;
  if (sparse || bytes >= min_in_huge_pages) {
    const std::size_t whole = up_to_huge_page(bytes + 1);
    std::byte* pages = map_huge_pages(whole, sparse ? MAP_NORESERVE : 0);
    // Large columns are traversed from end to end: fewer pages, fewer TLB misses. Only a hint, so failure is not an error.
    ::madvise(pages, whole, sparse ? MADV_NOHUGEPAGE : MADV_HUGEPAGE);
    data_ = decltype(data_)(pages, FreeBuffer{whole});
    return;
  }
  const auto line = static_cast<std::size_t>(cache_line);
  const std::size_t rounded = (bytes + line) / line * line;
  data_ =
      decltype(data_)(static_cast<std::byte*>(::operator new[](rounded, cache_line)), FreeBuffer{});
  std::memset(data_.get(), 0, rounded);
}

void Buffer::resize(std::size_t bytes) {
  const std::size_t mapped = data_.get_deleter().mapped, whole = up_to_huge_page(bytes + 1);
  if (mapped == 0 || bytes < min_in_huge_pages) {
    Buffer next(bytes);
    std::copy_n(data(), std::min(bytes, bytes_), next.data());
    *this = std::move(next);
    return;
  }
  std::byte* pages = data();
  if (whole < mapped) ::munmap(pages + whole, mapped - whole);
  if (whole > mapped) {  // its pages are moved to an address with enough room
    std::byte* room = map_huge_pages(whole, 0);
    if (::mremap(pages, mapped, whole, MREMAP_MAYMOVE | MREMAP_FIXED, room) == MAP_FAILED) {
      ::munmap(room, whole);
      throw std::bad_alloc();
    }
    pages = room;
  }
  data_.release();
  data_ = decltype(data_)(pages, FreeBuffer{whole});
  bytes_ = bytes;
}

// Rows keep their order: those that move towards the front are moved from the front on, the others from the back on, so
// that no row overwrites one that has yet to move.
void ColumnBase::rebuild(const std::vector<std::int32_t>& sources) {
  const std::size_t bytes = sources.size() * row_bytes;
  const auto at = [this](std::int64_t row) {
    return buffer_.data() + static_cast<std::size_t>(row) * row_bytes;
  };
  if (bytes > buffer_.bytes()) buffer_.resize(bytes);
  const auto rows = static_cast<std::int64_t>(sources.size());
  for (std::int64_t row = 0; row < rows; ++row)
    if (entry(sources, row) > row) std::copy_n(at(entry(sources, row)), row_bytes, at(row));
  for (std::int64_t row = rows - 1; row >= 0; --row) {
    const std::int32_t source = entry(sources, row);
    if (source < 0)
      std::fill_n(at(row), row_bytes, std::byte{});
    else if (source < row)
      std::copy_n(at(source), row_bytes, at(row));
  }
  if (bytes < buffer_.bytes()) buffer_.resize(bytes);
}

void ColumnBase::drop(std::size_t first_row, std::size_t rows) {
  std::byte* first = buffer_.data() + first_row * row_bytes;
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const auto begin = (reinterpret_cast<std::uintptr_t>(first) + page - 1) / page * page;
  const auto end = reinterpret_cast<std::uintptr_t>(first + rows * row_bytes) / page * page;
  if (begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_DONTNEED);
}

void ColumnBase::expect(const std::vector<std::pair<std::size_t, std::size_t>>& runs) {
  ::madvise(data(), up_to_huge_page(bytes()), MADV_NOHUGEPAGE);
  for (const auto& [first, end] : runs) {
    if ((end - first) * row_bytes < min_in_huge_pages) continue;
    const std::size_t begin = first * row_bytes / huge_page * huge_page;
    ::madvise(data() + begin, up_to_huge_page(end * row_bytes) - begin, MADV_HUGEPAGE);
  }
}

void ColumnBase::allocate_transient(std::size_t rows_of_worker, int workers) {
  bytes_of_worker_ = (rows_of_worker * row_bytes + 63) / 64 * 64;
  transient_ = Buffer(bytes_of_worker_ * static_cast<std::size_t>(workers));
}

std::size_t Table::rows_of_largest_chunk() const {
  std::int32_t most = 0;
  for (std::size_t c = 0; c + 1 < chunk_begin.size(); ++c)
    most = std::max(most, chunk_begin[c + 1] - chunk_begin[c]);
  return static_cast<std::size_t>(most);
}

void World::allocate_transient(const std::vector<TypeKey>& components, int workers) {
  for (const auto& [key, column] : columns_)
    if (column->scratch || std::ranges::find(components, key) != components.end())
      column->allocate_transient(column->owner().rows_of_largest_chunk(), workers);
}

void World::require_increasing(const std::vector<std::int32_t>& sources) {
  std::int32_t last = -1;
  for (const std::int32_t source : sources) {
    if (source < 0) continue;
    if (source <= last)
      throw std::logic_error("rows must keep their order when they are made anew");
    last = source;
  }
}

void World::hold(const std::vector<bool>& own_chunks) {
  own_chunks_ = own_chunks;
  for (const auto& [key, column] : columns_) expect_own(*column);
}

// Contiguous runs of chunks: their rows in the column.
void World::expect_own(ColumnBase& column) const {
  const std::vector<std::int32_t>& begin = column.owner().chunk_begin;
  if (kind_ != Buffer::Kind::sparse || begin.empty() || column.bytes() == 0) return;
  std::vector<std::pair<std::size_t, std::size_t>> runs;
  for (std::size_t chunk = 0; chunk < own_chunks_.size(); ++chunk) {
    if (!own_chunks_[chunk]) continue;
    const auto first = static_cast<std::size_t>(begin[chunk]),
               end = static_cast<std::size_t>(begin[chunk + 1]);
    if (chunk > 0 && own_chunks_[chunk - 1])
      runs.back().second = end;
    else
      runs.emplace_back(first, end);
  }
  column.expect(runs);
}

std::pair<Table*, ColumnBase*> World::own(const ColumnBase& column) {
  const auto owner = std::ranges::find_if(tables_, [&](const auto& table) {
    return std::ranges::find(table.second->columns, &column) != table.second->columns.end();
  });
  if (owner == tables_.end()) throw std::logic_error("the column is not the world's");
  Table& table = *owner->second;
  return {&table, *std::ranges::find(table.columns, &column)};
}

std::span<std::byte> World::room_for(const ColumnBase& column, std::size_t rows) {
  const auto [table, own_column] = own(column);
  if (!table->chunk_begin.empty() && rows != table->rows)
    throw BadState("the rows of " + column.entity + "/" + column.info.name +
                   " do not fit the scene");
  const std::size_t bytes = rows * column.row_bytes;
  if (column.bytes() != bytes) own_column->allocate(rows, Buffer::Kind::dense);
  table->rows = rows;
  return {own_column->data(), bytes};
}

void World::set_column(const ColumnBase& column, std::span<const std::byte> rows) {
  if (rows.size() % column.row_bytes != 0)
    throw BadState("the rows of " + column.entity + "/" + column.info.name +
                   " do not fit the scene");
  std::ranges::copy(rows, room_for(column, rows.size() / column.row_bytes).data());
}

void World::drop_column(const ColumnBase& column) {
  const auto [table, own_column] = own(column);
  if (table->chunk_begin.empty())
    own_column->allocate(0, Buffer::Kind::dense);
  else
    own_column->drop(0, table->rows);
}

Table& World::insert_table(TypeKey key, Table table) {
  if (!table.chunk_begin.empty()) {
    const int chunks = static_cast<int>(table.chunk_begin.size()) - 1;
    if (chunks_ != 0 && chunks != chunks_)
      throw std::logic_error("table '" + table.entity +
                             "' is divided into another number of chunks");
    chunks_ = chunks;
  }
  auto [entity, inserted] = tables_.emplace(key, std::make_unique<Table>(std::move(table)));
  if (!inserted) throw std::logic_error("table '" + entity->second->entity + "' was added twice");
  return *entity->second;
}

}  // namespace pulvis
