#include "engine/files/input_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "engine/files/file_descriptor.hpp"

namespace pulvis {
namespace {

const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "is a folder";
  if (S_ISFIFO(mode)) return "is a named pipe";
  if (S_ISSOCK(mode)) return "is a socket";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "is a device";
  return "is not a regular file";
}

// Without waiting for a writer if it is a pipe.
FileDescriptor opened(const std::filesystem::path& path) {
  FileDescriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (!file && (errno == ENOENT || errno == ENOTDIR)) throw UnfitInput("there is no such file");
  struct stat status {};
  const bool known = file ? fstat(file.get(), &status) == 0 : stat(path.c_str(), &status) == 0;
  if (known && !S_ISREG(status.st_mode)) throw UnfitInput(kind_of(status.st_mode));
  if (!file || !known) throw UnfitInput(std::string("cannot be read: ") + std::strerror(errno));
  return file;
}

std::string size_text(std::size_t bytes) {
  constexpr std::size_t mebibyte = std::size_t{1} << 20U;
  return bytes < mebibyte ? fmt::format("{} bytes", bytes)
                          : fmt::format("{} MiB", bytes / mebibyte);
}

}  // namespace

void require_regular_file(const std::filesystem::path& path) { opened(path); }

// Sizes reported by the file system are not trusted: some files in /proc report none and never end.
std::string text_of_input(const std::filesystem::path& path, std::size_t max_bytes) {
  const FileDescriptor file = opened(path);
  std::string text;
  for (std::size_t filled = 0;;) {
    text.resize(filled + std::max<std::size_t>(filled, 1U << 16U));
    const ssize_t got = read(file.get(), text.data() + filled, text.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw UnfitInput(std::string("cannot be read: ") + std::strerror(errno));
    filled += static_cast<std::size_t>(got);
    if (filled > max_bytes) throw UnfitInput("is larger than " + size_text(max_bytes));
    if (got > 0) continue;
    text.resize(filled);
    return text;
  }
}

}  // namespace pulvis
