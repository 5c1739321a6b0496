// A file that changes from one whole state to the next, whatever kills the program in between.
//
// What is written behind the last commit's end goes straight to the file: nothing that counts refers to it
// yet. What would change bytes before that end is kept in memory, and reads see it. commit() brings it
// to the disk as <file>.journal first and puts it into its places then. A journal that is found whole is
// put into its places again when the file is opened; one that is not belongs to a commit that never was.
//
// Somebody who reads the file without its journal finds a whole state at any moment, too, if its writer keeps to
// a rule: of the bytes that count since the last commit only those of one page change, the lowest that does,
// which is put into its place last (one write, which no kill can cut); or bytes within another page that mean
// the same before and after.
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
  enum class Open { existing, empty };  // empty: made, or emptied
  JournaledFile(const std::filesystem::path& path, Open how);

  void read(std::uint64_t at, std::span<std::byte> bytes) const;  // zeros behind the end
  void write(std::uint64_t at, std::span<const std::byte> bytes);
  void resize(std::uint64_t size) { size_ = size; }
  std::uint64_t size() const { return size_; }

  void commit();
  // What was written since the last commit is forgotten.
  void close();

  int descriptor() const { return file_.get(); }
  // For HDF5, which takes the address of a descriptor.
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
