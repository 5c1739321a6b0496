// A file that changes atomically from one consistent state to the next, even if the program is killed.
//
// Data beyond the end of the last commit is written straight to the file: no committed data refers to it
// yet. Changes to bytes before that end are kept in memory, and reads see them. commit() first writes them
// to disk as <file>.journal and then to their places in the file. When the file is opened, a complete journal
// is replayed; an incomplete one belongs to a commit that never happened and is ignored.
//
// Readers of the file without its journal also find a consistent state at any moment, if its writer follows
// one rule: of the bytes committed before, only those in one page change, the lowest changed page,
// which is written last (by one write, which a kill cannot interrupt); or bytes within another page whose
// meaning is the same before and after.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "engine/files/file_descriptor.hpp"

namespace pulvis {

// All failures are std::system_error.
class JournaledFile {
 public:
  enum class Open { existing, empty };  // empty: created, or truncated
  JournaledFile(const std::filesystem::path& path, Open how);

  void read(std::uint64_t at, std::span<std::byte> bytes) const;  // zeros beyond the end
  void write(std::uint64_t at, std::span<const std::byte> bytes);
  void resize(std::uint64_t size) { size_ = size; }
  std::uint64_t size() const { return size_; }

  void commit();
  // Discards what was written since the last commit.
  void close();

  int descriptor() const { return file_.get(); }
  // For HDF5, which needs the address of a descriptor.
  int* descriptor_address() { return &number_; }

 private:
  static constexpr std::size_t page_bytes = 4096;
  using Page = std::array<std::byte, page_bytes>;

  std::filesystem::path journal_path() const { return path_.string() + ".journal"; }
  Page& page(std::uint64_t index);
  void write_journal() const;
  void recover();
  bool is_on_disk(std::uint64_t index, const Page& page) const;
  void put_pages_in_place(std::uint64_t end);
  void put_in_place(std::uint64_t index, const Page& page, std::uint64_t end) const;

  std::filesystem::path path_;
  FileDescriptor file_;
  int number_ = -1;
  std::uint64_t size_ = 0, committed_ = 0;
  std::map<std::uint64_t, Page> changed_;  // pages before committed_, by number
};

}  // namespace pulvis
