#include "engine/files/run_folder.hpp"

#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "engine/files/own_files.hpp"

namespace pulvis {
namespace {

namespace fs = std::filesystem;

// The folders that create_directories would have to create, innermost first.
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
  for (const auto& folder : folders) fs::remove(folder, ignored);  // only removes empty folders
}

// Permissions, read-only mounts and quotas: only a trial write can tell. Uses an unused file name.
std::error_code try_to_write(const fs::path& folder) {
  std::string probe = (folder / ".pulvis-probe-XXXXXX").string();
  const FileDescriptor file(mkstemp(probe.data()));
  if (!file) return {errno, std::generic_category()};
  std::error_code ignored;
  fs::remove(probe, ignored);
  return {};
}

// Files of a run that must not be deleted without asking.
bool is_result(const std::string& name) {
  for (const char* const own : {"run.h5", "run.xdmf", "run.vtkhdf", "tools.vtkhdf", "history.csv",
                                "summary.json", "report.html", "scene.toml"})
    if (name == own) return true;
  return name.starts_with("state-") && name.ends_with(".h5");
}

bool belongs_to_a_run(const std::string& name) {
  if (is_result(name) || name == "run.h5.new" || name == "run.h5.journal") return true;
  const bool state = name.starts_with("checkpoint-") || name.starts_with("state-");
  return state && (name.ends_with(".h5") || name.ends_with(".h5.new"));
}

std::vector<fs::path> files_of_a_run(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (belongs_to_a_run(entry.path().filename().string())) found.push_back(entry.path());
  std::ranges::sort(found);
  return found;
}

// Checkpoints and partial files alone are not a result that anybody could miss.
std::string result_in(const fs::path& folder) {
  std::error_code ignored;
  if (fs::exists(folder / "run.h5", ignored)) return "run.h5";
  for (const fs::path& file : files_of_a_run(folder))
    if (is_result(file.filename().string())) return file.filename().string();
  return "";
}

void remove_old_run(const fs::path& folder) {
  for (const fs::path& file : files_of_a_run(folder)) remove_own(file, role::run);
  remove_own_below(folder / "pictures", role::figure);
}

FileDescriptor opened_folder(const fs::path& folder) {
  return FileDescriptor(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
}

// A file system without locks grants all.
bool is_granted(const FileDescriptor& folder, int kind) {
  return flock(folder.get(), kind | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, const char* taken) : folder_(opened_folder(folder)) {
  if (!folder_) throw OutputError(folder, "open the run's folder", std::strerror(errno));
  // Another process that only asks holds a lock for microseconds.
  for (int tries = 0; !is_granted(folder_, LOCK_EX); ++tries) {
    if (tries == 10) throw RunFolderTaken(folder, "use the folder", taken);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

bool is_locked(const fs::path& folder) {
  const FileDescriptor asking = opened_folder(folder);
  return asking && !is_granted(asking, LOCK_SH);
}

void require_own_files(const fs::path& folder) {
  require_own_list_in(folder);
  for (const fs::path& file : files_of_a_run(folder)) require_own_or_none(file, role::run);
}

void require_own_results(const fs::path& folder) {
  require_own_list_in(folder);
  for (const char* const name :
       {"run.xdmf", "run.vtkhdf", "tools.vtkhdf", "history.csv", "summary.json", "report.html"})
    require_own_or_none(folder / name, role::run);
}

void require_not_read(const fs::path& folder, const fs::path& read) {
  for (const fs::path& file : files_of_a_run(folder)) require_another(read, file);
}

void make_results_folder(const fs::path& given) {
  const fs::path folder = fs::absolute(given / "").parent_path().lexically_normal();
  std::error_code error;
  const auto missing = missing_folders(folder);
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder)) error = std::make_error_code(std::errc::not_a_directory);
  if (!error) error = try_to_write(folder);
  if (!error) return;
  take_away(missing);
  throw OutputError(given, "make the run's folder", error.message());
}

FolderLock open_run_folder(const fs::path& given, bool overwrite) {
  const fs::path folder = fs::absolute(given / "").parent_path().lexically_normal();
  require_own_files(folder);
  const std::string result = result_in(folder);
  if (!result.empty() && !overwrite)
    throw RunFolderTaken(
        given, "start a run here",
        "the folder already holds one (" + result + "); allowed: another folder, or --overwrite");
  make_results_folder(given);
  FolderLock lock(folder);
  remove_old_run(folder);
  return lock;
}

}  // namespace pulvis
