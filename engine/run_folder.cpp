#include "engine/run_folder.hpp"

#include <sys/file.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>
#include <vector>

namespace pulvis {
namespace {

namespace fs = std::filesystem;

// The folders that create_directories would have to make, the innermost first.
std::vector<fs::path> missing_folders(const fs::path& folder) {
  std::vector<fs::path> missing;
  std::error_code ignored;
  for (fs::path at = folder; !at.empty() && !fs::exists(at, ignored); at = at.parent_path()) {
    missing.push_back(at);
  }
  return missing;
}

void take_away(const std::vector<fs::path>& folders) {
  std::error_code ignored;
  for (const auto& folder : folders) fs::remove(folder, ignored);  // only an empty one goes
}

// Permissions, read-only mounts and quotas differ: only writing a file tells.
std::error_code try_to_write(const fs::path& folder) {
  const fs::path probe = folder / ".pulvis-probe";
  std::FILE* const file = std::fopen(probe.c_str(), "wb");
  if (file == nullptr) return {errno, std::generic_category()};
  std::fclose(file);
  std::error_code ignored;
  fs::remove(probe, ignored);
  return {};
}

bool belongs_to_a_run(const std::string& name) {
  for (const char* const own : {"run.h5", "run.h5.new", "run.h5.journal", "run.xdmf", "history.csv",
                                "summary.json", "report.html", "pictures"}) {
    if (name == own) return true;
  }
  return name.starts_with("checkpoint-") && (name.ends_with(".h5") || name.ends_with(".h5.new"));
}

void remove_old_run(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (!belongs_to_a_run(entry.path().filename().string())) continue;
    fs::remove_all(entry.path(), error);
    if (error) throw OutputError(entry.path(), "remove the old run's file", error.message());
  }
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, const char* taken)
    : folder_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (!folder_) throw OutputError(folder, "open the run's folder", std::strerror(errno));
  if (flock(folder_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw RunFolderTaken(folder, "use the folder", taken);
}

FolderLock open_run_folder(const fs::path& given, bool overwrite) {
  const fs::path folder = fs::absolute(given / "").parent_path().lexically_normal();
  std::error_code error;
  if (fs::exists(folder / "run.h5", error) && !overwrite) {
    throw RunFolderTaken(given, "start a run here", "the folder already holds one (run.h5)");
  }
  const auto missing = missing_folders(folder);
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder)) error = std::make_error_code(std::errc::not_a_directory);
  if (!error) error = try_to_write(folder);
  if (error) {
    take_away(missing);
    throw OutputError(given, "make the run's folder", error.message());
  }
  FolderLock lock(folder);
  if (overwrite) remove_old_run(folder);
  return lock;
}

}  // namespace pulvis
