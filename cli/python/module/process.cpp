#include "cli/python/module/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <set>
#include <string>
#include <system_error>

#include "cli/python/module/python_run.hpp"
#include "engine/files/file_descriptor.hpp"

namespace pulvis::python {
namespace {

// Accessed with the GIL.
std::multiset<std::filesystem::path>& held_folders() {
  static std::multiset<std::filesystem::path> folders;
  return folders;
}

bool is_in(const std::filesystem::path& folder, const std::string& file) {
  const std::string& whole = folder.native();
  return file.starts_with(whole) && (file.size() == whole.size() || file[whole.size()] == '/');
}

// Files that are only read stay: they may be the script's own.
bool is_ours(int number, const std::string& file) {
  for (const std::filesystem::path& folder : held_folders())
    if (is_in(folder, file))
      return file == folder.native() || (fcntl(number, F_GETFL) & O_ACCMODE) != O_RDONLY;
  return false;
}

}  // namespace

void OwnProcess::require_here() const {
  if (is_here()) return;
  throw NotNow(
      fmt::format("this {0} belongs to process {1}; process {2} is a fork of it and shares its "
                  "files; allowed: the {0} in the process that made it, another one here",
                  what_, pid_, getpid()));
}

void OwnProcess::hold(const std::filesystem::path& folder) {
  release();
  folder_ = std::filesystem::canonical(folder);
  held_folders().insert(folder_);
}

void OwnProcess::release() {
  if (folder_.empty()) return;
  if (const auto found = held_folders().find(folder_); found != held_folders().end())
    held_folders().erase(found);
  folder_.clear();
}

// Their numbers stay open, on /dev/null: libraries may still write buffered lines to them at the end of the process.
void let_go_of_held_files() {
  if (held_folders().empty()) return;
  const FileDescriptor nowhere(::open("/dev/null", O_RDWR | O_CLOEXEC));
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", none)) {
    const int number = std::stoi(entry.path().filename().string());
    const std::string file = std::filesystem::read_symlink(entry.path(), none).string();
    if (number != nowhere.get() && is_ours(number, file)) dup3(nowhere.get(), number, O_CLOEXEC);
  }
  held_folders().clear();
}

}  // namespace pulvis::python
