// LD_PRELOAD: ends the process by SIGKILL just before its Nth write into a file whose name ends with one of the
// given endings, so that every place inside a commit can be aimed at.
//
//   DIE_AT_WRITE=N           the Nth of those writes is not made any more; 0 or unset: none
//   DIE_AT_WRITE_TO=a,b      endings; without it "run.h5,run.h5.journal"
//   DIE_AT_WRITE_COUNT=file  at the end: how many writes there were
//
// Linux does not cut a write within a page of the file when it kills: a longer one is split there first, and
// each piece counts.
#include <dlfcn.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

constexpr std::size_t page_bytes = 4096;
std::atomic<long> writes{0};

long last_write() {
  const char* const text = std::getenv("DIE_AT_WRITE");
  return text == nullptr ? 0 : std::atol(text);
}

bool ends_with_one_of(const std::string& name, const std::string& endings) {
  for (std::size_t from = 0; from <= endings.size();) {
    const std::size_t comma = std::min(endings.find(',', from), endings.size());
    if (name.ends_with(endings.substr(from, comma - from))) return true;
    from = comma + 1;
  }
  return false;
}

bool is_watched(int file) {
  char name[4096];
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const ssize_t size = readlink(link.c_str(), name, sizeof name);
  if (size <= 0) return false;
  const char* const endings = std::getenv("DIE_AT_WRITE_TO");
  return ends_with_one_of(std::string(name, static_cast<std::size_t>(size)),
                          endings == nullptr ? "run.h5,run.h5.journal" : endings);
}

void count_one() {
  static const long last = last_write();
  if (++writes == last) kill(getpid(), SIGKILL);
}

using Pwrite = ssize_t (*)(int, const void*, std::size_t, off_t);
using Ftruncate = int (*)(int, off_t);

template <class Function>
Function next_of(const char* name) {
  void* const found = dlsym(RTLD_NEXT, name);
  Function function = nullptr;
  std::memcpy(&function, &found, sizeof function);
  return function;
}

ssize_t write_in_pieces(int file, const void* bytes, std::size_t size, off_t at) {
  static const Pwrite real = next_of<Pwrite>("pwrite64");
  if (!is_watched(file)) return real(file, bytes, size, at);
  std::size_t done = 0;
  while (done < size) {
    const std::size_t in_page = page_bytes - (static_cast<std::size_t>(at) + done) % page_bytes;
    count_one();
    const ssize_t put = real(file, static_cast<const char*>(bytes) + done,
                             std::min(in_page, size - done), at + static_cast<off_t>(done));
    if (put <= 0) return done > 0 ? static_cast<ssize_t>(done) : put;
    done += static_cast<std::size_t>(put);
  }
  return static_cast<ssize_t>(done);
}

struct Told {
  ~Told() {
    const char* const path = std::getenv("DIE_AT_WRITE_COUNT");
    std::FILE* const file = path == nullptr ? nullptr : std::fopen(path, "w");
    if (file == nullptr) return;
    std::fprintf(file, "%ld\n", writes.load());
    std::fclose(file);
  }
} told;

}  // namespace

extern "C" {
ssize_t pwrite(int file, const void* bytes, std::size_t size, off_t at) {
  return write_in_pieces(file, bytes, size, at);
}
ssize_t pwrite64(int file, const void* bytes, std::size_t size, off_t at) {
  return write_in_pieces(file, bytes, size, at);
}
int ftruncate(int file, off_t size) {
  if (is_watched(file)) count_one();
  static const Ftruncate real = next_of<Ftruncate>("ftruncate64");
  return real(file, size);
}
int ftruncate64(int file, off_t size) { return ftruncate(file, size); }
}
