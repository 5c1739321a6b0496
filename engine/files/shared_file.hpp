// A file that several processes write, each its own bytes. One of them has made room for these
// (hdf5::File::make_room), and refers to them only after all have flushed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/files/file_descriptor.hpp"

namespace pulvis {

// Room for rows in a file.
struct FileRoom {
  std::string file;
  std::uint64_t begin = 0;  // byte, from the start of the file

  template <class Bytes>
  void state(Bytes& bytes) {
    bytes(file, begin);
  }
};

// Whether processes on several machines may write one file in this folder: on NFS and the like, each of them caches whole
// pages, and overwrites what another has written into the same page.
bool has_one_view(const std::filesystem::path& folder);

// All failures are OutputError. After one, every call fails: a flush that succeeded later would hide it.
class SharedFile {
 public:
  explicit SharedFile(std::filesystem::path file);

  const std::filesystem::path& path() const { return path_; }
  // Bytes that follow those of the call before are written together.
  void write(std::uint64_t at, std::span<const std::byte> bytes);
  // Also to disk.
  void flush();

 private:
  void pass_on();
  template <class Action>
  void attempt(const char* operation, const Action& action);

  std::filesystem::path path_;
  FileDescriptor file_;
  std::vector<std::byte> waiting_;
  std::uint64_t waiting_at_ = 0;
  std::string failure_;
};

}  // namespace pulvis
